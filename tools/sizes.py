"""Flash and RAM of each part of the image for the K64, from the map that the linker writes."""

from __future__ import annotations

import json
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
from traceability.reading.image_record import TOTALS
from traceability.reading.products import (
    DEFAULT,
    PRODUCTS,
    RESULTS,
    image_of,
    module_names,
    modules_in,
)

ELF = image_of(DEFAULT, ".elf")
SIZES = Path("build/results/size_k64.json")
# Parts of the image that are no module.
VECTORS, CONFIGURATION = "vectors", "flash configuration field"
LIBRARY, STACK, PADDING = "C library", "stack", "padding"
PARTS = (VECTORS, CONFIGURATION, LIBRARY, STACK, PADDING)

SECTION = re.compile(r"^(\.\S+)(?:\s+0x[0-9a-f]+\s+0x[0-9a-f]+.*)?$")
INPUT = re.compile(r"^ (?:\*fill\*|\S+)?\s+0x[0-9a-f]+\s+0x([0-9a-f]+)\s+(\S.*)$")
OBJECT = re.compile(r"((?:start_up/)?[^/()]+)\.cpp\.o(?:bj)?\)?$")
HEADER = re.compile(r"^\s*\d+\s+(\S+)\s+([0-9a-f]+)\s+([0-9a-f]+)\s")


@dataclass
class Size:
    """Bytes of a part."""

    flash: int = 0
    ram: int = 0


@dataclass(frozen=True)
class Section:
    """A section of the image that takes memory."""

    name: str
    size: int
    address: int
    in_flash: bool
    in_ram: bool


def image_sizes(elf: Path, linker_map: Path) -> dict[str, Size]:
    """Part -> size. The sum is the size that arm-none-eabi-size reports for the whole image."""
    inputs: dict[str, list[tuple[str, int]]] = defaultdict(list)
    for name, part, size in contributions(linker_map.read_text(encoding="utf-8")):
        inputs[name].append((part, size))
    sizes: dict[str, Size] = defaultdict(Size)
    for section in sections(elf):
        rest = section.size
        for part, size in inputs[section.name]:
            add(sizes[owner(section) or part], section, size)
            rest -= size
        if rest < 0:
            raise FailureError(f"{linker_map.name}: {section.name} has more in it than its size")
        if rest:
            empty = STACK if "stack" in section.name and not inputs[section.name] else PADDING
            add(sizes[owner(section) or empty], section, rest)
    return dict(sizes)


def add(part: Size, section: Section, size: int) -> None:
    part.flash += size if section.in_flash else 0
    part.ram += size if section.in_ram else 0


def owner(section: Section) -> str:
    """The part that a section is as a whole; empty when it belongs to several."""
    if not section.in_flash:
        return ""
    return {0: VECTORS, FIELD: CONFIGURATION}.get(section.address, "")


def contributions(text: str) -> Iterator[tuple[str, str, int]]:
    """Section, part and size of each piece that the linker placed."""
    _, found, memory_map = text.partition("\nLinker script and memory map\n")
    if not found:
        raise FailureError("the linker map has no memory map")
    section = ""
    for line in memory_map.splitlines():
        if match := SECTION.match(line):
            section = match[1]
        elif line.startswith("/DISCARD/"):
            section = ""
        elif section and (match := INPUT.match(line)) and (size := int(match[1], 16)):
            yield section, part_of(match[2]), size


def part_of(path: str) -> str:
    """The source that was compiled to this file; other files come with the compiler."""
    match = OBJECT.search(path)
    return match[1] if match else LIBRARY


def sections(elf: Path) -> list[Section]:
    """The sections that take memory, as arm-none-eabi-size counts them."""
    lines = output("arm-none-eabi-objdump", "-h", elf).splitlines()
    found = []
    for line, flags in pairwise(lines):
        match = HEADER.match(line)
        if match and "ALLOC" in flags:
            constant = "READONLY" in flags or "CODE" in flags
            in_flash = constant or "CONTENTS" in flags
            size, address = int(match[2], 16), int(match[3], 16)
            found.append(Section(match[1], size, address, in_flash, not constant))
    return found


def output(*words: str | Path) -> str:
    try:
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout
    except FileNotFoundError as error:
        raise FailureError(f"{words[0]} is not installed") from error
    except subprocess.CalledProcessError as error:
        raise FailureError(error.stderr.strip()) from error


def total(sizes: dict[str, Size]) -> Size:
    return Size(
        sum(size.flash for size in sizes.values()), sum(size.ram for size in sizes.values())
    )


def sizes_of(root: Path, product: str) -> dict[str, Size]:
    return image_sizes(root / image_of(product, ".elf"), root / image_of(product, ".map"))


def write_products(root: Path) -> dict[str, Size]:
    """Measures the images of all products, and writes the parts of each."""
    wholes, records = {}, {}
    known = module_names(root)
    for product in PRODUCTS:
        sizes = sizes_of(root, product)
        whole = wholes[product] = total(sizes)
        records[product] = {
            "flash": whole.flash,
            "ram": whole.ram,
            "stack": sizes[STACK].ram if STACK in sizes else 0,
            "forbidden": sorted(forbidden(root / image_of(product, ".elf"))),
            "modules": modules_in(root / image_of(product, ".elf"), known),
        }
    write_json(root / RESULTS, records)
    return wholes


def write_sizes(root: Path) -> dict[str, Size]:
    """Measures the image that was built, and leaves the sizes for the model and the metrics."""
    sizes = sizes_of(root, DEFAULT)
    whole = total(sizes)
    write_json(root / SIZES, {name: vars(size) for name, size in sorted(sizes.items())})
    write_json(root / TOTALS, {"flash": whole.flash, "ram": whole.ram})
    return sizes


def write_json(path: Path, content: object) -> None:
    text = json.dumps(content, indent=1) + "\n"
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
