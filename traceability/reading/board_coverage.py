"""The lines of the design that were executed on the virtual K64.

The drivers are built only for the K64, so the coverage of this machine cannot include them. A test
on the virtual K64 sets one bit for each half-word that it executed. The first bits belong to the
lower RAM, which contains the program. The other bits belong to the flash. The debug data of the
image contain the source line of each instruction.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

from traceability.reading.traces import SOURCES
from traceability.schema import VIRTUAL_K64
from traceability.sources import DESIGN

ELF = SOURCES[VIRTUAL_K64].executable
FOLDERS = tuple(f"{name}/" for name in DESIGN)
FILE = re.compile(r"^(\S+):(?:\[\++\])?$")
ROW = re.compile(r"^\S+\s+(\d+|-)\s+0x([0-9a-f]+)")

LOWER_RAM, RAM_SIZE = 0x1FFF0000, 0x10000  # size of SRAM_L in bytes (K64 manual, table 4-1)
# file, line, first address, and the address after the last address
Stretch = tuple[str, int, int, int]


def read_stretches(root: Path) -> list[Stretch]:
    """Returns the code of the image in address ranges. Each range belongs to a single source line.
    Returns nothing without an image.
    """
    listing = subprocess.run(
        ["arm-none-eabi-objdump", "--dwarf=decodedline", root / ELF],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return list(stretches(listing.stdout.splitlines())) if listing.returncode == 0 else []


def lines_executed(ranges: Iterable[Stretch], executed: bytes) -> dict[str, dict[int, bool]]:
    """Returns for each file and line whether an instruction of the line was executed.

    The last bit belongs to the last half-word that was executed.
    """
    files: dict[str, dict[int, bool]] = {}
    last = 8 * len(executed)
    for file, line, first, end in ranges:
        lines = files.setdefault(file, {})
        halves = range(_half(first), min(_half(first) + (end - first) // 2, last))
        hit = any(executed[half // 8] >> half % 8 & 1 for half in halves)
        lines[line] = lines.get(line, False) or hit
    return files


def _half(address: int) -> int:
    """Returns the number of the bit that belongs to an address."""
    place = address - LOWER_RAM if address >= LOWER_RAM else RAM_SIZE + address
    return place // 2


def stretches(listing: Iterable[str]) -> Iterator[Stretch]:
    """Yields the linked code of the design in address ranges. Each range belongs to a single source
    line."""
    file = ""
    before: tuple[str, int, int] | None = None
    dropped = False
    for text in listing:
        if match := FILE.match(text):
            file = match[1]
        elif match := ROW.match(text):
            number, address = match[1], int(match[2], 16)
            if before is None:
                dropped = address == 0  # Code that the linker removed has no address.
            elif address > before[2] and not dropped and before[0].startswith(FOLDERS):
                yield (*before, address)
            before = None if number == "-" else (file, int(number), address)
