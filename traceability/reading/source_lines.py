"""Reads text files line by line. Each line has its place."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path

from traceability.schema import Place
from traceability.sources import files_below, text_of


def texts_below(
    root: Path, names: Iterable[str], suffixes: tuple[str, ...]
) -> Iterator[tuple[str, str]]:
    """Yields the path relative to ``root`` and the text of each file below the given folders. The
    files have the order of files_below()."""
    for path in files_below(root, names, suffixes):
        yield str(path.relative_to(root)), path.read_text(encoding="utf-8")


def lines_below(
    root: Path, names: Iterable[str], suffixes: tuple[str, ...]
) -> Iterator[tuple[Place, str]]:
    """Yields all lines of the files below the given folders."""
    for file, text in texts_below(root, names, suffixes):
        for number, line in enumerate(text.splitlines(), 1):
            yield Place(file, number), line


def place_at(file: str, text: str, position: int) -> Place:
    """Returns the place of a position in the text of a file."""
    return Place(file, text.count("\n", 0, position) + 1)


def headings(page: Path) -> Iterator[str]:
    """Yields the headings of a hand-written page."""
    for above, line in pairwise(text_of(page).splitlines()):
        if above.strip() and len(line) > 2 and set(line) <= set("=-~#*^"):
            yield above.strip()


def place_of(root: Path, line: str) -> Place | None:
    """Returns the place of the first line of a file that contains a text as a whole word. ``line``
    is the file and the text, such as ``sim/plant/DriveTrain.hpp: kRadius``. Returns None if there
    is no such line."""
    file, _, text = line.partition(": ")
    word = re.compile(rf"(?<!\w){re.escape(text)}(?!\w)")
    lines = lines_below(root, [file], ()) if text and (root / file).is_file() else ()
    return next((place for place, content in lines if word.search(content)), None)
