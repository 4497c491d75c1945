"""Runs the tests of one folder of tests/python."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import TextIO

from tools.cmake_build import Counts, jobs, junit_counts, outcome_of
from tools.steps import FailureError, run
from tools.task_graph import Outcome
from traceability.reading.results import RESULTS

# Tests that mostly wait for a robot in real time: more of them than processors run in parallel.
WAITING = "client"
WAITING_JOBS = "8"


def workers(folder: str) -> list[str | Path]:
    """Options of pytest: the number of parallel tests, and the tests that must run in one
    process."""
    if folder == WAITING:
        return ["-n", WAITING_JOBS, "--dist", "load"]
    return ["-n", jobs(), "--dist", "loadfile"]


def run_pytest(root: Path, folder: str, log: TextIO, *options: str) -> Outcome:
    """Runs the tests. Failed tests are an outcome; a run without results is an error."""
    results = root / RESULTS / f"pytest_{folder}.xml"
    results.parent.mkdir(parents=True, exist_ok=True)
    words: list[str | Path] = [root / ".venv/bin/python", "-m", "pytest", "-q", "-ra"]
    words += workers(folder)
    words += [f"--rootdir={root}", "-c", root / "pyproject.toml", f"--junitxml={results}"]
    words += [*options, root / "tests/python" / folder]
    counts = counted(log, words, results)
    # A busy machine may be too slow for these tests: those that failed run again, one by one.
    if counts.failed and folder == WAITING:
        again = counted(log, [*words, "--lf", "-n", "0"], results)
        counts = replace(again, passed=counts.passed + again.passed, skipped=counts.skipped)
    log.writelines(f"to debug it: ./wr debug {name}\n" for name in failed_tests(results))
    return outcome_of(counts)


def failed_tests(results: Path) -> list[str]:
    """The names of the failed tests, in the form of pytest and ./wr debug."""
    return [
        f"{case.get('classname', '').replace('.', '/')}.py::{case.get('name')}"
        for case in ET.parse(results).iter("testcase")
        if case.find("failure") is not None or case.find("error") is not None
    ]


def reported_numbers(results: Path) -> dict[str, float]:
    """The numbers that tests report as their properties."""
    found = ET.parse(results).iter("property")
    return {one.get("name", ""): float(one.get("value", "0")) for one in found}


def counted(log: TextIO, words: list[str | Path], results: Path) -> Counts:
    try:
        run(log, words)
    except FailureError:
        if not results.exists():
            raise
    return junit_counts(results)
