"""Flash and RAM of each part of the firmware image for the K64."""

from __future__ import annotations

import re
import subprocess
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from tools.forbidden_parts import forbidden
from tools.image import FIELD
from tools.steps import FailureError
from traceability.reading.bench_record import LIBRARY, frames_of
from traceability.reading.bench_record import owner as module_of
from traceability.reading.products import (
    DEFAULT,
    PRODUCTS,
    RESULTS,
    image_of,
    module_names,
    modules_in,
    recorded_image_of,
)
from traceability.reading.results import TOTALS
from traceability.whole_file import write_json

ELF = image_of(DEFAULT, ".elf")
SIZES = Path("build/results/size_k64.json")
# The parts of the firmware image that are not modules.
VECTORS, CONFIGURATION = "vectors", "flash configuration field"
STACK, PADDING = "stack", "padding and unnamed constants"
PARTS = (VECTORS, CONFIGURATION, LIBRARY, STACK, PADDING)

SRAM = 0x1FFF0000  # RAM begins at this address.
HEADER = re.compile(r"^\s*\d+\s+(\S+)\s+([0-9a-f]+)\s+([0-9a-f]+)\s+([0-9a-f]+)\s")
# An object: its address, its size, its name, and its source file if the compiler recorded the file.
OBJECT = re.compile(
    r"^([0-9a-f]+) ([0-9a-f]+) [bdrvBDRV] (\S+)(?:\t.*?(\w+)\.[ch]pp:\d+)?$", re.MULTILINE
)
CLASS_TABLE = re.compile(r"^_ZTVN2wr(\d+)(\w+)$")


@dataclass
class Size:
    """The size of a part of a firmware image [bytes]."""

    flash: int = 0
    ram: int = 0


@dataclass(frozen=True)
class Section:
    """A section of a firmware image that uses memory."""

    name: str
    size: int
    address: int
    load: int  # position in the binary file
    in_flash: bool
    in_ram: bool
    code: bool

    def holds(self, address: int) -> bool:
        return self.address <= address < self.address + self.size


def image_sizes(elf: Path, recorded: Path | None = None) -> dict[str, Size]:
    """Returns the size of each part of a firmware image. The sum of the flash sizes is the value
    that arm-none-eabi-size reports.

    An instruction belongs to the module of its source line, even if the instruction was inlined
    elsewhere. An object belongs to the module that defines it. The modules of the objects are read
    from the ``recorded`` image, because link-time optimisation removes this information from the
    other image."""
    sizes: dict[str, Size] = defaultdict(Size)
    all_objects = list(objects(elf, recorded or elf))
    for section in sections(elf):
        rest = section.size
        if whole := owner(section):
            add(sizes[whole], section, section.size)
            continue
        inside = ((part, size) for address, part, size in all_objects if section.holds(address))
        for part, size in instructions(elf, section) if section.code else inside:
            add(sizes[part], section, size)
            rest -= size
        if rest:
            add(sizes[STACK if "stack" in section.name else PADDING], section, rest)
    return dict(sizes)


def instructions(elf: Path, section: Section) -> Iterator[tuple[str, int]]:
    """Yields the module and the size of each half-word of code."""
    halves = range(section.address, section.address + section.size - 1, 2)
    for frames in frames_of(elf, halves).values():
        yield module_of(frames)[0], 2


def objects(elf: Path, recorded: Path) -> Iterator[tuple[int, str, int]]:
    """Yields the address, the module and the size of each object. A virtual method table belongs to
    its class. For all the other objects, the module is read from the ``recorded`` image."""
    listed = output("arm-none-eabi-nm", "--print-size", "--line-numbers", recorded)
    modules = {name: module for _, _, name, module in OBJECT.findall(listed) if module}
    for address, size, name, _ in OBJECT.findall(output("arm-none-eabi-nm", "--print-size", elf)):
        plain = name.partition(".lto_priv")[0]
        table = CLASS_TABLE.match(plain)
        part = table[2][: int(table[1])] if table else modules.get(plain, PADDING)
        yield int(address, 16), part, int(size, 16)


def add(part: Size, section: Section, size: int) -> None:
    part.flash += size if section.in_flash else 0
    part.ram += size if section.in_ram else 0


def owner(section: Section) -> str:
    """Returns the part to which a whole section belongs. The result is empty if the section belongs
    to several parts."""
    if not section.in_flash:
        return ""
    return {0: VECTORS, FIELD: CONFIGURATION}.get(section.address, "")


def sections(elf: Path) -> list[Section]:
    """Returns the sections that use memory. A section that is copied into RAM also uses flash."""
    lines = output("arm-none-eabi-objdump", "-h", elf).splitlines()
    parts = []
    for line, flags in pairwise(lines):
        match = HEADER.match(line)
        if match and "ALLOC" in flags:
            size, address, load = (int(number, 16) for number in match.groups()[1:])
            in_flash, in_ram = "CONTENTS" in flags, address >= SRAM
            code = "CODE" in flags
            parts.append(Section(match[1], size, address, load, in_flash, in_ram, code))
    return parts


def place_in_binary(elf: Path, address: int) -> int:
    """Returns the position of a byte in the binary file. ``address`` is the address of this byte at
    run time."""
    for section in sections(elf):
        if section.in_flash and section.holds(address):
            return section.load + address - section.address
    raise FailureError(f"{elf.name} contains no data for {address:#x}")


def output(*words: str | Path) -> str:
    try:
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout
    except FileNotFoundError as error:
        raise FailureError(f"{words[0]} is not installed; install it with ./wr setup") from error
    except subprocess.CalledProcessError as error:
        raise FailureError(error.stderr.strip()) from error


def total(sizes: dict[str, Size]) -> Size:
    return Size(
        sum(size.flash for size in sizes.values()), sum(size.ram for size in sizes.values())
    )


def whole_of(elf: Path) -> Size:
    """Returns the flash and RAM of a firmware image [bytes]."""
    whole = Size()
    for section in sections(elf):
        add(whole, section, section.size)
    return whole


def sizes_of(root: Path, product: str) -> dict[str, Size]:
    recorded = root / recorded_image_of(product, ".elf")
    return image_sizes(root / image_of(product, ".elf"), recorded)


def write_products(root: Path) -> dict[str, Size]:
    """Measures the firmware images of all products. Writes the flash, the RAM, the stack, the
    forbidden parts and the modules of each image."""
    wholes, records = {}, {}
    modules = module_names(root)
    for product in PRODUCTS:
        elf = root / image_of(product, ".elf")
        whole = wholes[product] = whole_of(elf)
        records[product] = {
            "flash": whole.flash,
            "ram": whole.ram,
            "stack": next(
                (section.size for section in sections(elf) if "stack" in section.name), 0
            ),
            "forbidden": sorted(forbidden(elf)),
            "modules": modules_in(root / recorded_image_of(product, ".elf"), modules),
        }
    write_json(root / RESULTS, records)
    return wholes


def write_sizes(root: Path) -> dict[str, Size]:
    """Measures the firmware image of the robot, and writes its sizes for the model and the
    metrics."""
    sizes = sizes_of(root, DEFAULT)
    whole = total(sizes)
    write_json(root / SIZES, {name: vars(size) for name, size in sorted(sizes.items())})
    write_json(root / TOTALS, {"flash": whole.flash, "ram": whole.ram})
    return sizes
