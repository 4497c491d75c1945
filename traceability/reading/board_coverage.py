"""The source lines of the design that were executed on the virtual K64.

The drivers are built only for the K64. The coverage on the host therefore does not include them. A
test on the virtual K64 writes a file with one bit for each half-word of memory. A bit is 1 if the
test executed the half-word. The first bits belong to the lower RAM, which contains the program. The
other bits belong to the flash. The debug data of the firmware image show the source line of each
instruction."""

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

# address and size [byte] of SRAM_L (K64 manual, table 4-1)
LOWER_RAM, RAM_SIZE = 0x1FFF0000, 0x10000
# file, source line, first address, and the address after the last address
Stretch = tuple[str, int, int, int]


def read_stretches(root: Path) -> list[Stretch]:
    """Returns the address ranges of the code in the firmware image. Each range belongs to one
    source line. Returns an empty list if there is no image."""
    listing = subprocess.run(
        ["arm-none-eabi-objdump", "--dwarf=decodedline", root / ELF],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return list(stretches(listing.stdout.splitlines())) if listing.returncode == 0 else []


def lines_executed(ranges: Iterable[Stretch], executed: bytes) -> dict[str, dict[int, bool]]:
    """Returns a value for each source line of each file: true if an instruction of the line was
    executed.

    ``executed`` may end after the last executed half-word. Half-words without a bit were not
    executed."""
    files: dict[str, dict[int, bool]] = {}
    last = 8 * len(executed)
    for file, line, first, end in ranges:
        lines = files.setdefault(file, {})
        halves = range(_half(first), min(_half(first) + (end - first) // 2, last))
        hit = any(executed[half // 8] >> half % 8 & 1 for half in halves)
        lines[line] = lines.get(line, False) or hit
    return files


def _half(address: int) -> int:
    """Returns the number of the coverage bit for the half-word at an address."""
    place = address - LOWER_RAM if address >= LOWER_RAM else RAM_SIZE + address
    return place // 2


def stretches(listing: Iterable[str]) -> Iterator[Stretch]:
    """Yields the address ranges of the design's code in the firmware image. Each range belongs to
    one source line."""
    file = ""
    before: tuple[str, int, int] | None = None
    dropped = False
    for text in listing:
        if match := FILE.match(text):
            file = match[1]
        elif match := ROW.match(text):
            number, address = match[1], int(match[2], 16)
            if before is None:
                dropped = address == 0  # Code that the linker removed begins at the address 0.
            elif address > before[2] and not dropped and before[0].startswith(FOLDERS):
                yield (*before, address)
            before = None if number == "-" else (file, int(number), address)
