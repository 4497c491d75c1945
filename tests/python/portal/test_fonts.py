"""The files with the font of the pages. PlantUML measures the labels of diagrams with this font."""

from __future__ import annotations

import struct
import subprocess
from pathlib import Path

from portal.fonts import FONTS, opentype, write_fonts


def test_a_font_keeps_its_tables_and_their_check_sums() -> None:
    for path in FONTS.glob("*.woff"):
        font = opentype(path.read_bytes())
        (count,) = struct.unpack_from(">H", font, 4)
        assert count > 8
        for number in range(count):
            tag, expected, offset, length = struct.unpack_from(">4sIII", font, 12 + 16 * number)
            table = bytearray(font[offset : offset + length] + b"\0" * (-length % 4))
            if tag == b"head":
                table[8:12] = bytes(4)  # The check sum is computed with 0 in these bytes.
            assert sum(struct.unpack(f">{len(table) // 4}I", table)) % 2**32 == expected, tag


def test_each_style_of_the_font_is_written(tmp_path: Path) -> None:
    write_fonts(tmp_path)
    command = ["fc-scan", "--format", "%{fullname}\n", *map(str, tmp_path.glob("*.ttf"))]
    names = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")
    assert {"Inter Regular", "Inter Bold", "Inter Italic"} <= set(names)
