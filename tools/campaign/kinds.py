"""The kinds of campaigns, with the work of a chunk and the summary of all cases."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.campaign import faults, fuzz, loads
from tools.campaign.chunks import Chunk

Cases = Sequence[dict[str, Any]]


@dataclass(frozen=True)
class Kind:
    """A kind of campaign. Its program prints a line of JSON for each case."""

    name: str
    unit: str  # name of a case
    size: int  # number of cases of a chunk
    usual: int  # number of cases of a campaign without the option --count
    # presets, and the targets that are built in each preset before the campaign
    targets: tuple[tuple[str, tuple[str, ...]], ...]
    files: tuple[Path, ...]  # files that a chunk needs; the first file is the program
    # function that returns the options of the program for these files
    options: Callable[[Sequence[Path]], list[str]]
    summarise: Callable[[Path, Cases], dict[str, Any]]

    def words(self, files: Sequence[Path], chunk: Chunk) -> list[str]:
        """Returns the command of a chunk."""
        seeded = ["--seed", str(chunk.seed), "--count", str(chunk.count)]
        return [str(files[0]), *self.options(files), *seeded]


def image_options(files: Sequence[Path]) -> list[str]:
    """Returns the options of a program that runs a firmware image."""
    return ["--image", str(files[1]), "--elf", str(files[2])]


KINDS = {
    kind.name: kind
    for kind in (
        Kind(
            "faults",
            "faults",
            200,
            10_000,
            (("k64", (faults.ELF.name,)), ("host", (faults.PROGRAM.name,))),
            (faults.PROGRAM, faults.IMAGE, faults.ELF),
            image_options,
            faults.summarise,
        ),
        Kind(
            "loads",
            "drives",
            20,
            1_000,
            (("k64", (faults.ELF.name,)), ("host", (loads.PROGRAM.name,))),
            (loads.PROGRAM, faults.IMAGE, faults.ELF),
            image_options,
            loads.summarise,
        ),
        Kind(
            "fuzz",
            "runs of the fuzzers",
            1,
            20,
            (("fuzz", ("fuzzers",)),),
            (fuzz.PROGRAM, *fuzz.FUZZERS),
            fuzz.options,
            fuzz.summarise,
        ),
    )
}
