"""What the tests executed altogether, counted by gcovr from what gcc itself wrote in their run.

A line that stands in several functions, as one of a template does, counts once.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TextIO

from traceability.commands.builds import jobs
from traceability.commands.steps import FailureError, run
from traceability.model.coverage import OTHER_PROGRAMS
from traceability.model.results import (
    COVERAGE,
    COVERAGE_LINES,
    COVERAGE_RUN,
    RUNS,
    read_totals,
    run_hash,
)
from traceability.model.schema import HOST
from traceability.sources import DESIGN

GCOVR = Path(sys.executable).with_name("gcovr")


def count_coverage(root: Path, log: TextIO) -> str:
    """Writes the totals, and the lines of each file, unless they are those of the last run."""
    known = read_totals(root)
    totals = known or _count(root, log)
    text = f"{totals['line_percent']} % of the lines, {totals['branch_percent']} % of the branches"
    return f"{text} (unchanged)" if known else text


def _count(root: Path, log: TextIO) -> dict[str, float]:
    stamp = root / COVERAGE_RUN
    stamp.unlink(missing_ok=True)
    words: list[str | Path] = [GCOVR, "--root", root, "-j", jobs(), "--merge-lines"]
    words += ["--exclude-directory", OTHER_PROGRAMS]
    for name in DESIGN:
        words += ["--filter", f"{re.escape(str(root / name))}/"]
    words += ["--json-summary", root / COVERAGE, "--json", root / COVERAGE_LINES]
    build = root / "build" / RUNS[HOST]
    remove_stale_notes(root, build, log)
    run(log, [*words, build])
    stamp.write_text(run_hash(root, HOST), encoding="utf-8")
    totals = read_totals(root)
    if totals is None:
        raise FailureError("gcovr found no line of the design")
    return totals


def remove_stale_notes(root: Path, build: Path, log: TextIO) -> None:
    """Removes what gcc wrote for sources that exist no longer: gcovr fails with it."""
    for kind in ("gcno", "gcda"):
        for file in sorted(build.rglob(f"*.cpp.{kind}")):
            if not any(source.exists() for source in _sources(root, build, file)):
                log.write(f"{file} has no source any more: removed\n")
                file.unlink()


def _sources(root: Path, build: Path, file: Path) -> list[Path]:
    """Where the source may be that CMake compiled: in the project, generated, or somewhere else."""
    parts = file.relative_to(build).with_suffix("").parts
    if "CMakeFiles" not in parts:
        return [file]
    place = parts.index("CMakeFiles")
    rest = [".." if part == "__" else part for part in parts[place + 2 :]]
    below = Path(*parts[:place], *rest)
    return [root / below, build / below, Path("/", *rest)]
