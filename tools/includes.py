"""Finds the files of the project that are included in source files."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache, partial
from pathlib import Path

from traceability.reading.graphs import reached_from
from traceability.sources import DESIGN

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
FOLDERS = (*DESIGN, "tests", ".")  # folders below which the compiler looks for an included file


def included(root: Path, files: Iterable[Path]) -> set[Path]:
    """Returns the given files, and all files of the project that are included in them, directly or
    indirectly."""
    return set(reached_from(files, partial(direct, root)))


@cache
def direct(root: Path, file: Path) -> tuple[Path, ...]:
    folders = (file.parent, *(root / name for name in FOLDERS))
    found = (
        next((folder / name for folder in folders if (folder / name).exists()), None)
        for name in INCLUDE.findall(file.read_text(errors="replace"))
    )
    return tuple(path for path in found if path is not None)
