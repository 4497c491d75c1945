"""Which lines of the drivers the tests executed on the virtual K64.

The drivers are built for the K64 only, so no coverage of this machine tells of them. The tests on
the virtual K64 leave one bit for each half-word of the flash that they executed; the image knows
the line that each of its instructions was made from.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

from traceability.model.schema import VIRTUAL_K64
from traceability.model.traces import SOURCES

ELF = SOURCES[VIRTUAL_K64].executable
EXECUTED = SOURCES[VIRTUAL_K64].folder / "executed.bits"
DRIVERS = "src/k64/"
FILE = re.compile(r"^(\S+):(?:\[\++\])?$")
ROW = re.compile(r"^\S+\s+(\d+|-)\s+0x([0-9a-f]+)")

Stretch = tuple[str, int, int, int]  # file, line, first address, address after the last one


def read_board_coverage(root: Path) -> dict[str, dict[int, bool]] | None:
    """File -> line -> whether it was executed; None when nothing was recorded."""
    if not (root / EXECUTED).is_file() or not (root / ELF).is_file():
        return None
    listing = subprocess.run(
        ["arm-none-eabi-objdump", "--dwarf=decodedline", root / ELF],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    if listing.returncode != 0:
        return None
    return lines_executed(stretches(listing.stdout.splitlines()), (root / EXECUTED).read_bytes())


def lines_executed(found: Iterable[Stretch], executed: bytes) -> dict[str, dict[int, bool]]:
    """A line is executed when any instruction that was made from it is."""
    files: dict[str, dict[int, bool]] = {}
    for file, line, first, end in found:
        lines = files.setdefault(file, {})
        hit = any(executed[half // 8] >> half % 8 & 1 for half in range(first // 2, end // 2))
        lines[line] = lines.get(line, False) or hit
    return files


def stretches(listing: Iterable[str]) -> Iterator[Stretch]:
    """The code of the drivers as the linker left it, in stretches of one line of source each."""
    file = ""
    before: tuple[str, int, int] | None = None
    dropped = False
    for text in listing:
        if match := FILE.match(text):
            file = match[1]
        elif match := ROW.match(text):
            number, address = match[1], int(match[2], 16)
            if before is None:
                dropped = address == 0  # code that the linker left out keeps no address
            elif address > before[2] and not dropped and before[0].startswith(DRIVERS):
                yield (*before, address)
            before = None if number == "-" else (file, int(number), address)
