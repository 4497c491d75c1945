"""Reads the frames of the PC protocol from ``design/frames.toml``.

The client, the simulator, the portal and the build of the firmware use this module.
"""

from __future__ import annotations

import struct
import tomllib
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

TABLE = Path(__file__).resolve().parents[2] / "design" / "frames.toml"
WHEEL_COUNT = 4
CODES = {
    "u8": "B",
    "i8": "b",
    "u16": "H",
    "i16": "h",
    "u32": "I",
    "i32": "i",
    "char8": "8s",
}
# For each unit, the last part of the names of its values. An example is velocity0_rpm.
ENDS = {
    "degree": "_degrees",
    "rpm": "_rpm",
    "V": "_volts",
    "A": "_amperes",
    "ms": "_ms",
    "count": "_counts",
}
BY_QUANTITY = "quantity"  # the unit of a set-point depends on its quantity


class LayoutError(ValueError):
    """The table of frames cannot be used, or values do not match a frame."""


@dataclass(frozen=True)
class Entry:
    """A value of an enumeration."""

    number: int
    name: str
    shown: str
    firmware: str  # enumerator or constant of the firmware
    meaning: str = ""
    detail: str = ""
    check: str = ""  # first checks of a technician
    unit: str = ""
    scale: float = 1
    limit: int | None = None


@dataclass(frozen=True)
class Enumeration:
    """The numbers that a field can have, with their names."""

    name: str
    page: str  # label of the section that explains the values
    detail: str  # heading of the column with the details of the values
    entries: tuple[Entry, ...]

    def find(self, number: int) -> Entry | None:
        return next((entry for entry in self.entries if entry.number == number), None)

    def shown(self, number: int) -> str:
        """Returns the text for a number. For an undefined number, returns the name of the
        enumeration and the number."""
        entry = self.find(number)
        return entry.shown if entry else f"{self.name} {number}"


@dataclass(frozen=True)
class Bit:
    name: str
    number: int
    meaning: str


@dataclass(frozen=True)
class Field:
    """A field of a frame, with its offset in the payload."""

    name: str
    type: str
    offset: int
    meaning: str
    wheel: int | None = None
    unit: str = ""
    scale: float = 1
    limit: int | None = None
    values: Enumeration | None = None
    none: int | None = None
    bits: tuple[Bit, ...] = ()
    bits_of: Enumeration | None = None
    valid: tuple[str, ...] = ()
    counter: bool = False
    check: str = ""  # first checks of a technician when a counter rises

    @property
    def size(self) -> int:
        return struct.calcsize(f"<{CODES[self.type]}")

    def number(self, **bits: bool) -> int:
        """Returns the number that the field contains when these bits are set."""
        numbers = {bit.name: bit.number for bit in self.bits}
        return sum(is_set << numbers[name] for name, is_set in bits.items())

    @property
    def counts(self) -> bool:
        """Returns whether the field counts events of the link or of the cycle.

        Returns False for a field that counts events of a wheel.
        """
        return self.counter and self.wheel is None

    @property
    def stem(self) -> str:
        """Returns the name of the field without the number of its wheel."""
        return self.name if self.wheel is None else self.name.removesuffix(str(self.wheel))


@dataclass(frozen=True)
class Layout:
    """The payload fields of a frame type, in the order in which they are sent."""

    name: str
    kind: int
    sender: str
    use: str
    fields: tuple[Field, ...] = field(repr=False)

    @cached_property
    def form(self) -> struct.Struct:
        return struct.Struct("<" + "".join(CODES[one.type] for one in self.fields))

    @property
    def size(self) -> int:
        return self.form.size

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(one.name for one in self.fields)

    @property
    def value_names(self) -> tuple[str, ...]:
        """Returns the names of the values that decode() returns."""
        return tuple(self.decode(bytes(self.size)))

    def pack(self, **values: int) -> bytes:
        """Returns the payload with these values. Every field needs a value."""
        if set(values) != set(self.names):
            raise LayoutError(f"fields {sorted(set(values) ^ set(self.names))} do not match")
        return self.form.pack(*(values[name] for name in self.names))

    def unpack(self, payload: bytes) -> dict[str, int]:
        """Returns the numbers of a payload. Ignores the bytes after the known fields."""
        return dict(zip(self.names, self.form.unpack_from(payload), strict=True))

    def decode(self, payload: bytes) -> dict[str, Any]:
        """Returns the values of a payload, in their units and with the texts of enumerations.

        A field of bits has one value for each bit. The value of an invalid field is None.
        """
        numbers = self.unpack(payload)
        missing = {
            name
            for mask in self.fields
            for bit, name in enumerate(mask.valid)
            if not numbers[mask.name] >> bit & 1
        }
        values: dict[str, Any] = {}
        for one in self.fields:
            number = numbers[one.name]
            if one.bits:
                values |= {bit.name: bool(number >> bit.number & 1) for bit in one.bits}
            elif not one.valid:
                value = None if one.name in missing else self._value(one, number, numbers)
                values[value_name(one)] = value
        return values

    def _value(self, one: Field, number: int, numbers: Mapping[str, int]) -> Any:
        if number == one.none:
            return None
        if one.values:
            entry = one.values.find(number)
            return entry.shown if entry else f"{one.stem.replace('_', ' ')} {number}"
        if one.bits_of:
            return tuple(one.bits_of.shown(bit) for bit in range(8) if number >> bit & 1)
        if one.unit == BY_QUANTITY:
            scale = scale_of(self.of(f"{BY_QUANTITY}{one.wheel}"), numbers)
            return scaled(number, scale)
        return text_of(number) if one.type == "char8" else scaled(number, one.scale)

    def of(self, name: str) -> Field:
        return next(one for one in self.fields if one.name == name)


def scale_of(quantity: Field, numbers: Mapping[str, int]) -> float:
    """Returns the scale of a quantity. Returns 1 for an unknown quantity."""
    assert quantity.values
    entry = quantity.values.find(numbers[quantity.name])
    return entry.scale if entry else 1


def scaled(number: int, scale: float) -> int | float:
    """Returns the value in its unit.

    The function divides by the inverse of the scale, because the quotient is then the
    floating-point number that is nearest to the decimal value."""
    return number if scale == 1 else number / round(1 / scale)


def text_of(raw: Any) -> str:
    text: str = raw.decode("ascii", "replace")
    return text


def value_name(one: Field) -> str:
    """Returns the name of a value with its unit, for example velocity0_rpm."""
    end = ENDS.get(one.unit, "")
    return one.name if one.name.endswith(end) else one.name + end


@dataclass(frozen=True)
class FrameTable:
    """All frames, by their names."""

    enumerations: Mapping[str, Enumeration]
    frames: Mapping[str, Layout]

    @property
    def schema(self) -> str:
        """Returns the text whose CRC-32 is the schema hash. The text has a line for each field."""
        return "".join(
            f"{frame.name} {one.name} {one.type} {one.offset}\n"
            for frame in self.frames.values()
            for one in frame.fields
        )

    @property
    def schema_hash(self) -> int:
        return zlib.crc32(self.schema.encode("ascii"))


def read_frames(text: str) -> FrameTable:
    """Reads a table of frames."""
    try:
        table = tomllib.loads(text)
        enumerations = {item["name"]: _enumeration(item) for item in table.get("enumeration", [])}
        frames = {item["name"]: _layout(item, enumerations) for item in table["frame"]}
    except (KeyError, TypeError, tomllib.TOMLDecodeError) as error:
        raise LayoutError(f"table of frames: {error}") from error
    return FrameTable(enumerations, frames)


def _enumeration(item: dict[str, Any]) -> Enumeration:
    entries = tuple(
        Entry(**{"shown": one["name"], "firmware": f"{item['firmware']}::{one['name']}", **one})
        for one in item["values"]
    )
    return Enumeration(item["name"], item.get("page", ""), item.get("detail", ""), entries)


def _layout(item: dict[str, Any], enumerations: Mapping[str, Enumeration]) -> Layout:
    fields: list[Field] = []
    for one, wheel in _in_order(item["fields"]):
        offset = fields[-1].offset + fields[-1].size if fields else 0
        fields.append(_field(one, wheel, offset, enumerations))
    names = [one.name for one in fields]
    unknown = {name for one in fields for name in one.valid} - set(names)
    if len(set(names)) < len(names) or unknown:
        raise LayoutError(f"{item['name']}: a name is unknown or occurs twice: {sorted(unknown)}")
    return Layout(item["name"], item["type"], item["sender"], item["use"], tuple(fields))


def _in_order(items: list[dict[str, Any]]) -> Iterator[tuple[dict[str, Any], int | None]]:
    """Yields the fields in the order in which they are sent. A group repeats for each wheel."""
    group: list[dict[str, Any]] = []
    for one in [*items, None]:
        if one is not None and "each" in one:
            group.append(one)
            continue
        for wheel in range(WHEEL_COUNT):
            yield from ((member, wheel) for member in group)
        group = []
        if one is not None:
            yield one, None


def _field(
    one: dict[str, Any], wheel: int | None, offset: int, known: Mapping[str, Enumeration]
) -> Field:
    if one["type"] not in CODES:
        raise LayoutError(f"{one['name']}: there is no type {one['type']}")
    if one.get("unit", "") not in ("", BY_QUANTITY, *ENDS):
        known_units = ", ".join(ENDS)
        raise LayoutError(
            f"{one['name']}: ENDS in layout.py has no unit {one['unit']}: {known_units}"
        )
    return Field(
        name=one["name"] if wheel is None else f"{one['name']}{wheel}",
        type=one["type"],
        offset=offset,
        meaning=one["meaning"],
        wheel=wheel,
        unit=one.get("unit", ""),
        scale=one.get("scale", 1),
        limit=one.get("limit"),
        values=known[one["values"]] if "values" in one else None,
        none=one.get("none"),
        bits=tuple(_bits(one.get("bits", []))),
        bits_of=known[one["bits_of"]] if "bits_of" in one else None,
        valid=tuple(one.get("valid", ())),
        counter=one.get("counter", False),
        check=one.get("check", ""),
    )


def _bits(items: list[dict[str, Any]]) -> Iterator[Bit]:
    number = 0
    for one in items:
        for wheel in range(WHEEL_COUNT) if "each" in one else ("",):
            yield Bit(f"{one['name']}{wheel}", number, one["meaning"])
            number += 1


FRAMES = read_frames(TABLE.read_text(encoding="utf-8"))
LAYOUTS = FRAMES.frames
SCHEMA_HASH = FRAMES.schema_hash

if __name__ == "__main__":  # the build of the firmware runs this file as a program
    print(f"{SCHEMA_HASH:#010x}")
