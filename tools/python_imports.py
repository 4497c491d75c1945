"""The files on which a Python test depends. The test imports some of them, directly or indirectly.
The other files are listed in the mark ``reads`` of the test."""

from __future__ import annotations

import ast
import functools
import re
from collections.abc import Collection, Iterable
from pathlib import Path

from traceability.reading.graphs import reached_from
from traceability.sources import TESTS_OF_TOOLS

IMPORT = re.compile(
    r"^\s*(?:from\s+([\w.]+)\s+import\s+(\([^)]*\)|.+)|import\s+([\w.]+))", re.MULTILINE
)
IMPORTED_FROM = ("", "site", "client")  # folders from which tests import, as in pyproject.toml
# This file imports the module of a command when the command runs.
COMMANDS = "tools/cli.py"
RUNS_TOOLS = "pytest.mark.runs_tools"
# The model and the drawings need these files. A test needs no mark for them.
READ_BY_ALL = ("traceability/doxygen/Doxyfile", "site/theme/static/fonts")
PROJECT = "."  # in a mark "reads": all files that the checks and the pages read
READS = "reads"  # mark of a test file, with the files and folders that its tests read


def files_of(root: Path, folder: str) -> list[Path]:
    """Returns the test files of a folder of tests/python."""
    return sorted((root / TESTS_OF_TOOLS / folder).glob("test_*.py"))


def imported_by(root: Path, test: Path) -> set[str]:
    """Returns the Python files of the project that a test file or its conftest.py imports, directly
    or indirectly. The result contains the test file and conftest.py, too."""
    around = [*(root / TESTS_OF_TOOLS).glob("conftest.py"), *test.parent.glob("conftest.py")]
    found = reached_from([test, *around], functools.partial(_imports, root))
    return {str(file.relative_to(root)) for file in found}


@functools.cache
def read_by(test: Path) -> tuple[str, ...]:
    """Returns the files and folders in the marks ``reads`` of a test file."""
    return tuple(
        str(ast.literal_eval(path))
        for node in ast.walk(ast.parse(test.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr == READS
        for path in node.args
    )


def runs_all_tools(test: Path, imported: Collection[str]) -> bool:
    """Returns true if the tests of a file execute commands of ./wr. A command may import any file
    of the tools. ``imported`` contains the files that the test file imports."""
    return COMMANDS in imported or RUNS_TOOLS in test.read_text(encoding="utf-8")


def inputs_of(root: Path, folder: str) -> set[str]:
    """Returns the files and folders that are imported or read by the tests of a folder."""
    return {
        path
        for test in files_of(root, folder)
        for path in (*imported_by(root, test), *read_by(test))
    }


def covers(named: Iterable[str], path: str) -> bool:
    """Returns whether a path is one of the named files, or is in a named folder."""
    return any(one in (PROJECT, path) or path.startswith(f"{one}/") for one in named)


def importing_tests(root: Path, paths: Collection[str]) -> dict[str, str]:
    """Returns the test files that a change of ``paths`` can affect, each with one path as the
    reason. If ``paths`` contains the test file, this path is the test file itself. Otherwise, the
    test file imports a file of ``paths``, and the path is this imported file."""
    found = {}
    for test in sorted((root / TESTS_OF_TOOLS).glob("*/test_*.py")):
        own = str(test.relative_to(root))
        used = imported_by(root, test).intersection(paths)
        if reached := sorted(used, key=lambda path: path != own):
            found[own] = reached[0]
    return found


@functools.cache
def _imports(root: Path, file: Path) -> tuple[Path, ...]:
    names: set[str] = set()
    for source, imported, module in IMPORT.findall(file.read_text(encoding="utf-8")):
        inner = [word.split()[0] for word in imported.strip("()").split(",") if word.strip()]
        names.update((source or module, *(f"{source}.{name}" for name in inner)))
    found = (one for name in sorted(names) for one in _files(root, name))
    return tuple(dict.fromkeys(found))


@functools.cache
def _files(root: Path, module: str) -> tuple[Path, ...]:
    """Returns the file of a module, and the ``__init__.py`` of each package that contains the
    module."""
    parts = module.split(".")
    ways = [
        Path(place, *parts[:count]) for place in IMPORTED_FROM for count in range(1, len(parts) + 1)
    ]
    files = [root / one for way in ways for one in (way.with_suffix(".py"), way / "__init__.py")]
    return tuple(file for file in files if file.is_file())
