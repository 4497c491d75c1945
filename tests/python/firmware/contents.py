"""The contents of a firmware image: its vectors, its symbols and its sections."""

from __future__ import annotations

import re
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[3]
BUILD = ROOT / "build" / "k64"
COMPILER = "arm-none-eabi-g++"
CORE = ("-mcpu=cortex-m4", "-mthumb")

SRAM_LOWER = 0x1FFF0000
BORDER = 0x20000000  # end of SRAM_L and begin of SRAM_U
VECTORS = 16 + 86
CODE = 0x410


@dataclass(frozen=True)
class Symbol:
    """A symbol of a program. A missing address and a missing size have the value 0."""

    name: str
    address: int = 0
    size: int = 0


def output(*words: str | Path) -> str:
    done = subprocess.run(words, check=True, capture_output=True, text=True, timeout=60)
    return done.stdout


def symbols(program: Path) -> list[Symbol]:
    """Returns all symbols, including undefined symbols."""
    found = []
    for line in output("arm-none-eabi-nm", "--format=posix", program).splitlines():
        name, _kind, *numbers = line.split()
        address, size = ([int(number, 16) for number in numbers] + [0, 0])[:2]
        found.append(Symbol(name, address, size))
    return found


def sections(program: Path) -> dict[str, tuple[int, int]]:
    """Returns the address and the size of each section."""
    pattern = r"^ *\[ *\d+\] (\S+) +\S+ +([0-9a-f]{8}) [0-9a-f]+ ([0-9a-f]+) "
    text = output("arm-none-eabi-readelf", "--sections", "--wide", program)
    return {
        name: (int(address, 16), int(size, 16))
        for name, address, size in re.findall(pattern, text, re.MULTILINE)
    }


def across_border(program: Path) -> list[str]:
    """Returns the sections and objects of a program that are partly below and partly above the
    border between SRAM_L and SRAM_U."""
    places = [(name, *place) for name, place in sections(program).items()]
    places += [(one.name, one.address, one.size) for one in symbols(program)]
    return [name for name, address, size in places if address < BORDER < address + size]


def vector_problems(image: bytes) -> list[str]:
    """Returns the faults in the vectors of a firmware image."""
    stack, *handlers = struct.unpack_from(f"<{VECTORS}I", image)
    problems = []
    if not SRAM_LOWER < stack <= BORDER or stack % 8:
        problems.append(f"the stack pointer is 0x{stack:X}")
    for number, handler in enumerate(handlers, 1):
        if handler % 2 == 0:
            problems.append(f"vector {number} is 0x{handler:X}, not an address of Thumb code")
        elif not (CODE < handler < len(image) or SRAM_LOWER < handler < BORDER):
            problems.append(f"vector {number} is 0x{handler:X}, outside the code")
    return problems
