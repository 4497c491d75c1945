"""The coverage of all tests together. gcovr computes it from the counters of gcc.

A source line that is in several functions, such as a source line of a template, counts once."""

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
    read_object,
)
from traceability.schema import HOST
from traceability.sources import DESIGN

GCOVR = Path(sys.executable).with_name("gcovr")


def count_coverage(root: Path, log: TextIO) -> str:
    """Writes the totals of the coverage, and the coverage of each source line."""
    words: list[str | Path] = [GCOVR, "--root", root, "-j", jobs(), "--merge-lines"]
    words += ["--exclude-directory", OTHER_PROGRAMS]
    for name in DESIGN:
        words += ["--filter", f"{re.escape(str(root / name))}/"]
    words += ["--json-summary", root / COVERAGE, "--json", root / COVERAGE_LINES]
    build = root / "build" / RUNS[HOST]
    remove_stale_notes(root, build, log)
    run(log, [*words, build])
    totals = read_object(root / COVERAGE)
    if not totals.get("line_total"):
        raise FailureError(
            "gcovr found no line of the design; run the tests again with ./wr test host"
        )
    return f"{totals['line_percent']} % of the lines, {totals['branch_percent']} % of the branches"


def remove_stale_notes(root: Path, build: Path, log: TextIO) -> None:
    """Removes the coverage notes and counters of objects that the build no longer makes."""
    if (build / "build.ninja").exists():
        run(log, ["ninja", "-C", build, "-t", "cleandead"])
    for kind in ("gcno", "gcda"):
        for file in sorted(build.rglob(f"CMakeFiles/**/*.{kind}")):
            if not file.with_suffix(".o").exists():
                log.write(
                    f"{file.relative_to(root)} is removed, because its object no longer exists\n"
                )
                file.unlink()
