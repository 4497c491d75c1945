"""Coverage of all tests together, counted by gcovr from the counters of gcc.

A line in several functions, such as a line of a template, counts once.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TextIO

from tools.cmake_build import jobs
from tools.steps import FailureError, run
from traceability.reading.coverage import OTHER_PROGRAMS
from traceability.reading.results import (
    COVERAGE,
    COVERAGE_LINES,
    RUNS,
    count_totals,
)
from traceability.schema import HOST
from traceability.sources import DESIGN

GCOVR = Path(sys.executable).with_name("gcovr")


def count_coverage(root: Path, log: TextIO) -> str:
    """Writes the totals, and the lines of each file."""
    words: list[str | Path] = [GCOVR, "--root", root, "-j", jobs(), "--merge-lines"]
    words += ["--exclude-directory", OTHER_PROGRAMS]
    for name in DESIGN:
        words += ["--filter", f"{re.escape(str(root / name))}/"]
    words += ["--json-summary", root / COVERAGE, "--json", root / COVERAGE_LINES]
    build = root / "build" / RUNS[HOST]
    remove_stale_notes(root, build, log)
    run(log, [*words, build])
    totals = count_totals(root)
    if totals is None:
        raise FailureError("gcovr found no line of the design")
    return f"{totals['line_percent']} % of the lines, {totals['branch_percent']} % of the branches"


def remove_stale_notes(root: Path, build: Path, log: TextIO) -> None:
    """Removes the counters of sources that exist no longer: gcovr fails with them."""
    for kind in ("gcno", "gcda"):
        for file in sorted(build.rglob(f"*.cpp.{kind}")):
            if not any(source.exists() for source in _sources(root, build, file)):
                log.write(f"{file} has no source any more: removed\n")
                file.unlink()


def _sources(root: Path, build: Path, file: Path) -> list[Path]:
    """The possible places of the source that CMake compiled: in the project, generated, or
    somewhere else."""
    parts = file.relative_to(build).with_suffix("").parts
    if "CMakeFiles" not in parts:
        return [file]
    place = parts.index("CMakeFiles")
    rest = [".." if part == "__" else part for part in parts[place + 2 :]]
    below = Path(*parts[:place], *rest)
    return [root / below, build / below, Path("/", *rest)]
