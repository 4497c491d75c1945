"""Converts the font of the pages to files that Java can read. PlantUML and the browser then use the
same font. PlantUML needs this font to compute the size of the texts in a diagram."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

FONTS = Path(__file__).parents[1] / "theme" / "static" / "fonts"
FAMILY = "Inter"
# Formats for the module struct: header and directory entry of a WOFF 1.0 file, then header and
# directory entry of an OpenType file.
WOFF_HEADER, WOFF_ENTRY, WOFF_HEADER_SIZE = ">4s4sIH", ">4sIIII", 44
HEADER, ENTRY = ">4sHHHH", ">4sIII"


def write_fonts(folder: Path) -> None:
    """Writes the fonts as OpenType files."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in FONTS.glob("*.woff"):
        (folder / path.name).with_suffix(".ttf").write_bytes(opentype(path.read_bytes()))


def opentype(woff: bytes) -> bytes:
    """Converts the content of a WOFF file to an OpenType font. The tables of the font do
    not change, but they are not compressed."""
    _, flavour, _, count = struct.unpack_from(WOFF_HEADER, woff)
    log = count.bit_length() - 1
    header = struct.pack(HEADER, flavour, count, 16 << log, log, 16 * count - (16 << log))
    start = len(header) + count * struct.calcsize(ENTRY)
    directory, tables = b"", b""
    for number in range(count):
        place = WOFF_HEADER_SIZE + number * struct.calcsize(WOFF_ENTRY)
        tag, offset, packed, length, check_sum = struct.unpack_from(WOFF_ENTRY, woff, place)
        table = woff[offset : offset + packed]
        table = zlib.decompress(table) if packed < length else table
        directory += struct.pack(ENTRY, tag, check_sum, start + len(tables), length)
        tables += table + b"\0" * (-length % 4)
    return header + directory + tables
