"""Layout of the payloads, read from ``design/frames.txt``: the table that the firmware uses too."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

TABLE = Path(__file__).resolve().parents[2] / "design" / "frames.txt"
CODES = {
    "u8": "B",
    "i8": "b",
    "u16": "H",
    "i16": "h",
    "u32": "I",
    "i32": "i",
    "char8": "8s",
}


class LayoutError(ValueError):
    """A table of frames that cannot be used, or values that do not fit a frame."""


@dataclass(frozen=True)
class Layout:
    """Fields of the payload of one type of frame, in their order on the line."""

    names: tuple[str, ...]
    form: struct.Struct

    @property
    def size(self) -> int:
        return self.form.size

    def pack(self, **values: int) -> bytes:
        """Returns the payload with these values; every field needs one."""
        if set(values) != set(self.names):
            raise LayoutError(f"fields {sorted(set(values) ^ set(self.names))} do not match")
        return self.form.pack(*(values[name] for name in self.names))

    def unpack(self, payload: bytes) -> dict[str, int]:
        """Returns the values of a payload; bytes after the known fields are ignored."""
        return dict(zip(self.names, self.form.unpack_from(payload), strict=True))


def read_layouts(text: str) -> dict[str, Layout]:
    """Returns the layout of each frame: lines of frame, field, type and offset, without gaps."""
    names: dict[str, list[str]] = {}
    codes: dict[str, str] = {}
    for line in text.splitlines():
        frame, name, kind, offset = line.split()
        code = codes.get(frame, "<")
        if struct.calcsize(code) != int(offset):
            raise LayoutError(f"{frame} {name}: not at offset {offset}")
        codes[frame] = code + CODES[kind]
        names.setdefault(frame, []).append(name)
    return {frame: Layout(tuple(names[frame]), struct.Struct(codes[frame])) for frame in names}


_TEXT = TABLE.read_text(encoding="ascii")
LAYOUTS: Mapping[str, Layout] = read_layouts(_TEXT)
SCHEMA_HASH = zlib.crc32(_TEXT.encode("ascii"))
