"""Reads all texts of the project that people read: pages, comments, requirements, texts of design/
and the files that describe builds, tests and runs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from traceability.reading.source_lines import lines_below
from traceability.schema import Place
from traceability.sources import DESIGN

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


def text_lines(root: Path) -> Iterator[tuple[Place, str]]:
    """Yields the lines of all texts, with their places."""
    for place, line in lines_below(root, READ, SUFFIXES):
        if not place.file.startswith(NOT_READ):
            yield place, line
