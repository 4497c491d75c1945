"""Message definitions of ROS 2 for the frames of the PC protocol."""

from __future__ import annotations

from collections.abc import Iterator

from weeding_robot_client.layout import BY_QUANTITY, FRAMES, Field, Layout, value_name

INTEGERS = {
    "u8": "uint8",
    "i8": "int8",
    "u16": "uint16",
    "i16": "int16",
    "u32": "uint32",
    "i32": "int32",
    "char8": "string",
}
MISSING = "NaN: missing or stale"


def messages() -> dict[str, str]:
    """Returns the definition of each frame that has fields. The key is the name of its file."""
    return {f"{frame.name}.msg": message(frame) for frame in FRAMES.frames.values() if frame.fields}


def message(frame: Layout) -> str:
    """Returns the definition of a message.

    Enumerations are numbers with constants. A value that may be missing is a float64.
    """
    missing = {name for field in frame.fields for name in field.valid}
    lines = [f"# {frame.name}: {frame.use}. Made from design/frames.toml."]
    shown: set[str] = set()
    for one in frame.fields:
        if one.values and one.values.name not in shown:
            shown.add(one.values.name)
            lines += _constants(one)
        if one.bits:
            lines += [f"bool {bit.name}  # {bit.meaning}" for bit in one.bits]
        elif not one.valid:
            lines.append(f"{_type(one, missing)} {value_name(one)}{_text(one, missing)}")
    return "\n".join(lines) + "\n"


def _type(one: Field, missing: set[str]) -> str:
    real = one.name in missing or one.scale != 1 or one.unit == BY_QUANTITY
    return "float64" if real else INTEGERS[one.type]


def _constants(one: Field) -> Iterator[str]:
    assert one.values
    for entry in one.values.entries:
        name = f"{one.values.name} {entry.name}".upper().replace(" ", "_").replace("-", "_")
        yield f"{INTEGERS[one.type]} {name}={entry.number}"


def _text(one: Field, missing: set[str]) -> str:
    note = f"; {MISSING}" if one.name in missing else ""
    unit = f" [{one.unit}]" if one.unit else ""
    return f"  # {one.meaning}{unit}{note}"
