"""Reads text files line by line. Each line has its place."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path

from traceability.schema import Place
from traceability.sources import DESIGN, files_below, text_of

# The texts of the project that people read: pages, comments, requirements, texts of design/ and the
# files that describe builds, tests and runs.
READ = (
    *("requirements", "design", "docs", *DESIGN, "sim", "tests", "client", "tools", "site"),
    *("traceability", "changes", "ports", "setup", "CMakeLists.txt", ".ci", ".github", ".vscode"),
    *("README.md", "CONTRIBUTING.md", "CHANGELOG.md"),
)
SUFFIXES = (
    *(".dox", ".hpp", ".cpp", ".h", ".S", ".py", ".toml", ".rst", ".md", ".html", ".scenario"),
    *(".txt", ".cmake", ".ld", ".json", ".yml"),
)
# The tests of the tools and the seeded faults contain names that do not exist. The other files are
# generated, and other findings report wrong names in them.
NOT_READ = ("tests/python/", "tests/drift/", "tests/records/", "requirements/baseline.toml")


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


def text_lines(root: Path) -> Iterator[tuple[Place, str]]:
    """Yields the lines of all texts that people read, with their places."""
    for place, line in lines_below(root, READ, SUFFIXES):
        if not place.file.startswith(NOT_READ):
            yield place, line


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
