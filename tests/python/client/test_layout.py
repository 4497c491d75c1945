"""The client reads the table of frames, and rejects a table that contains an error."""

import zlib

import pytest

from weeding_robot_client.layout import LAYOUTS, LayoutError, read_frames

HEAD = """
[[enumeration]]
name = "colour"
firmware = "Colour"
values = [{ number = 2, name = "Red", shown = "red light" }]

[[frame]]
name = "A"
type = 0x90
sender = "MCU"
use = "is an example"
"""


def table(fields: str) -> str:
    return f"{HEAD}fields = [{fields}]"


def field(name: str, kind: str, more: str = "") -> str:
    return f'{{ name = "{name}", type = "{kind}", meaning = "", {more}}},'.replace(", }", " }")


def test_the_schema_hash_is_the_crc_32_of_names_types_and_offsets() -> None:
    read = read_frames(table(field("one", "u8") + field("each", "i16", 'each = "wheel"')))
    lines = "A one u8 0\nA each0 i16 1\nA each1 i16 3\nA each2 i16 5\nA each3 i16 7\n"
    assert read.schema == lines
    assert read.schema_hash == zlib.crc32(lines.encode())


def test_texts_do_not_change_the_schema_hash() -> None:
    plain = field("one", "u8")
    other = plain.replace('meaning = ""', 'meaning = "another", unit = "ms"')
    assert read_frames(table(plain)).schema_hash == read_frames(table(other)).schema_hash


@pytest.mark.parametrize(
    ("frame", "kind"),
    [
        ("Hello", 0x01),
        ("Confirm", 0x02),
        ("KeepAlive", 0x03),
        ("Order", 0x04),
        ("Welcome", 0x81),
        ("Report", 0x82),
    ],
)
def test_types_of_version_2(frame: str, kind: int) -> None:
    assert LAYOUTS[frame].kind == kind


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        (field("one", "u24"), "there is no type u24"),
        (field("one", "u8", 'unit = "furlong"'), "has no unit furlong"),
        (field("one", "u8") + field("one", "u8"), "occurs twice"),
        (field("one", "u8", 'valid = ["two"]'), "two"),
        (field("one", "u8", 'values = "shape"'), "shape"),
        ("not toml", "table of frames"),
    ],
)
def test_a_table_with_an_error_is_refused(fields: str, message: str) -> None:
    with pytest.raises(LayoutError, match=message):
        read_frames(table(fields))


def test_values_keep_their_places() -> None:
    fields = field("one", "u8") + field("two", "i16") + field("three", "u32")
    layout = read_frames(table(fields)).frames["A"]
    payload = layout.pack(three=4, one=1, two=-2)
    assert payload == bytes.fromhex("01feff04000000")
    assert layout.unpack(payload + b"more") == {"one": 1, "two": -2, "three": 4}


def test_a_missing_or_unknown_value_is_refused() -> None:
    layout = read_frames(table(field("one", "u8"))).frames["A"]
    with pytest.raises(LayoutError, match="one"):
        layout.pack()
    with pytest.raises(LayoutError, match="two"):
        layout.pack(one=1, two=2)


def test_values_have_units_names_bits_and_validity() -> None:
    layout = read_frames(
        table(
            field("height", "i16", 'unit = "V", scale = 0.001')
            + field("light", "u8", 'values = "colour"')
            + field("other", "u8", 'values = "colour", none = 9')
            + field(
                "marks",
                "u8",
                'bits = [{ name = "low", meaning = "" }, '
                '{ name = "slow", each = "wheel", meaning = "" }]',
            )
            + field("lights", "u8", 'bits_of = "colour"')
            + field("known", "u8", 'valid = ["height", "length"]')
            + field("length", "u8", 'unit = "count"')
        )
    ).frames["A"]
    numbers = {"height": -1500, "light": 2, "other": 9, "marks": 0b01001, "lights": 0b101}
    assert layout.decode(layout.pack(**numbers, known=1, length=3)) == {
        "height_volts": -1.5,
        "light": "red light",
        "other": None,
        **{"low": True, "slow0": False, "slow1": False, "slow2": True, "slow3": False},
        "lights": ("colour 0", "red light"),
        "length_counts": None,
    }
    numbers |= {"light": 3, "other": 2}
    values = layout.decode(layout.pack(**numbers, known=2, length=3))
    assert (values["height_volts"], values["length_counts"]) == (None, 3)
    assert (values["light"], values["other"]) == ("light 3", "red light")
