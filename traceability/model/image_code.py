"""Reads the machine code of the firmware image. All proofs use the same result. Therefore the
machine code is read only once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from traceability.reading.call_graph import Function, names_of_addresses, read_graph
from traceability.reading.loop_bounds import Place
from traceability.reading.machine_code import Code, places, read_code
from traceability.reading.products import DEFAULT, image_of
from traceability.reading.results import read_image


@dataclass(frozen=True)
class Program:
    """The instructions of a firmware image, and the source lines of each instruction."""

    codes: Mapping[str, Code]
    # address of an instruction -> its source line; if the code of this line was inlined, also the
    # source lines of the calls
    places: Mapping[int, list[Place]]
    # The compiler can merge equal functions: name of a merged function -> its key in ``codes``
    shared: Mapping[str, str]


def read_program(elf: Path) -> Program:
    codes = read_code(elf)
    addresses = [one.address for code in codes.values() for one in code.instructions()]
    shared = {
        name: home
        for names in names_of_addresses(elf)
        for home in names
        if home in codes
        for name in names
    }
    return Program(codes, places(elf, addresses), shared)


@dataclass(frozen=True)
class ImageCode:
    """The functions of a firmware image. ``graph`` contains their calls and their stack frames.
    ``program`` contains their instructions."""

    elf: Path
    graph: dict[str, Function]
    program: Program


def read_image_code(root: Path) -> ImageCode | None:
    """Returns the code of the firmware image. Returns None if the image was not built from the
    present sources."""
    elf = root / image_of(DEFAULT, ".elf")
    if read_image(root) is None or not elf.exists():
        return None
    built = elf.resolve()
    return ImageCode(elf, read_graph(built.parents[2], built), read_program(elf))
