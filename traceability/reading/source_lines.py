"""Reads text files line by line. Each line has its place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from traceability.schema import Place
from traceability.sources import files_below


def lines_below(
    root: Path, names: Iterable[str], suffixes: tuple[str, ...]
) -> Iterator[tuple[Place, str]]:
    """Yields all lines of the files below the given folders. The files come in the order of
    files_below()."""
    for path in files_below(root, names, suffixes):
        file = str(path.relative_to(root))
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            yield Place(file, number), line
