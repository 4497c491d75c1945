"""The table of frames as the client reads it."""

import zlib
from pathlib import Path

import pytest
from weeding_robot_client.layout import LAYOUTS, SCHEMA_HASH, LayoutError, read_layouts

TABLE = Path(__file__).parents[3] / "design" / "frames.txt"


def test_the_schema_hash_is_the_crc_32_of_the_table() -> None:
    assert zlib.crc32(TABLE.read_bytes()) == SCHEMA_HASH


@pytest.mark.parametrize(
    ("frame", "size"),
    [("Hello", 6), ("Welcome", 29), ("Confirm", 1), ("Order", 21), ("Report", 130)],
)
def test_sizes_of_the_payloads_of_version_2(frame: str, size: int) -> None:
    assert LAYOUTS[frame].size == size


def test_a_table_with_a_gap_is_refused() -> None:
    with pytest.raises(LayoutError, match="Hello b: not at offset 2"):
        read_layouts("Hello a u8 0\nHello b u8 2\n")


def test_values_keep_their_places() -> None:
    layout = read_layouts("A one u8 0\nA two i16 1\nA three u32 3\n")["A"]
    payload = layout.pack(three=4, one=1, two=-2)
    assert payload == bytes.fromhex("01feff04000000")
    assert layout.unpack(payload + b"more") == {"one": 1, "two": -2, "three": 4}


def test_a_missing_or_unknown_value_is_refused() -> None:
    layout = read_layouts("A one u8 0\n")["A"]
    with pytest.raises(LayoutError, match="one"):
        layout.pack()
    with pytest.raises(LayoutError, match="two"):
        layout.pack(one=1, two=2)
