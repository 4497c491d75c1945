"""Runs the tests of a folder of tests/python."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TextIO

from tools.cmake_build import jobs, outcome_of
from tools.python_imports import covers, files_of, imported_by, read_by, runs_all_tools
from tools.steps import FailureError, run
from tools.task_graph import Outcome
from traceability.reading.tool_tests import REPEATED, failed_tests, junit_counts, results_of
from traceability.schema import Counts
from traceability.sources import TESTS_OF_TOOLS
from traceability.whole_file import write_whole

PYTHON = ("tests/python/", "tools/", "traceability/", "site/portal/", "client/")
LONG = "long"  # mark of the tests that run only with ./wr test --long
NOT_LONG = f"not {LONG}"
# The tests of this folder mostly wait for a robot in real time. Therefore, the number of tests that
# run in parallel does not depend on the number of processors.
WAITING = "client"
WAITING_JOBS = "8"


def workers(folder: str) -> list[str | Path]:
    """Returns options of pytest. They set the number of parallel processes, and the distribution of
    the tests among these processes."""
    if folder == WAITING:
        return ["-n", WAITING_JOBS, "--dist", "load"]
    return ["-n", jobs(), "--dist", "loadfile"]


def run_pytest(root: Path, folder: str, log: TextIO, marks: str = NOT_LONG) -> Outcome:
    """Runs each test of a folder if its marks match the given expression. Failed tests are an
    outcome, but a run without results is an error."""
    return outcome_of(counted(root, folder, log, [root / TESTS_OF_TOOLS / folder], marks))


def run_long(root: Path, log: TextIO) -> Outcome:
    """Runs the long tests of all folders."""
    return outcome_of(counted(root, LONG, log, [root / TESTS_OF_TOOLS], LONG))


def update_pytest(root: Path, folder: str, log: TextIO, changed: frozenset[str]) -> Outcome:
    """Runs only the test files that a change of the files in ``changed`` can affect, and the test
    files with failed tests. The results of the other test files remain. If all tests of the folder
    may read a changed file, runs all tests of the folder."""
    results = root / results_of(folder)
    before = ET.parse(results).getroot()
    affected = affected_tests(root, folder, changed)
    if affected is None:
        results.unlink()
        return run_pytest(root, folder, log)
    affected |= {name.partition("::")[0] for name in failed_tests(results)}
    files = sorted(name for name in affected if (root / name).exists())
    log.write(f"{len(files)} test files are affected: {' '.join(files)}\n")
    results.unlink()
    if files:
        counted(root, folder, log, [root / name for name in files])
    merge_results(root, before, results, files)
    return outcome_of(junit_counts(results))


def affected_tests(root: Path, folder: str, changed: Collection[str]) -> set[str] | None:
    """Returns the test files of a folder that a change of the files in ``changed`` can affect.

    Returns None if a changed file is not a Python file of the project and is not listed in a mark
    ``reads``. All tests of the folder may read such a file."""
    python = {name for name in changed if name.endswith(".py") and name.startswith(PYTHON)}
    of_tools = any(not name.startswith(f"{TESTS_OF_TOOLS}/") for name in python)
    found: set[str] = set()
    explained = set(python)
    for test in files_of(root, folder):
        imported, read = imported_by(root, test), read_by(test)
        used = {name for name in changed if name in imported or covers(read, name)}
        explained |= used
        if used or (of_tools and runs_all_tools(test, imported)):
            found.add(str(test.relative_to(root)))
    return found if explained == set(changed) else None


def merge_results(
    root: Path, before: ET.Element, results: Path, repeated: Collection[str] = (), mark: str = ""
) -> None:
    """Adds earlier results to a result file. Three kinds of earlier results are left out: results
    of tests that ran again, of repeated test files, and of test files that no longer exist. If
    ``mark`` is not empty, the present results get this attribute."""
    now = list(ET.parse(results).iter("testcase")) if results.exists() else []
    for case in now if mark else ():
        case.set(mark, "true")
    again = {(case.get("classname"), case.get("name")) for case in now}
    suite = next(before.iter("testsuite"))
    for case in list(suite.iter("testcase")):
        file = f"{case.get('classname', '').replace('.', '/')}.py"
        named = (case.get("classname"), case.get("name"))
        if named in again or file in repeated or not (root / file).exists():
            suite.remove(case)
    suite.extend(now)
    write_whole(results, ET.tostring(before, encoding="unicode"))


def counted(
    root: Path, folder: str, log: TextIO, tests: Sequence[str | Path], marks: str = NOT_LONG
) -> Counts:
    """Runs each given test if its marks match the expression. Returns the numbers of passed, failed
    and skipped tests."""
    results = root / results_of(folder)
    results.parent.mkdir(parents=True, exist_ok=True)
    words: list[str | Path] = [root / ".venv/bin/python", "-m", "pytest", "-q", "-ra"]
    words += ["-m", marks, *workers(folder)]
    words += [f"--rootdir={root}", "-c", root / "pyproject.toml", f"--junitxml={results}"]
    attempt_tests(log, [*words, *tests], results)
    # The tests that wait for a robot may fail because the computer is busy. The failed tests
    # of this folder therefore run again, one after the other.
    if folder == WAITING and (failed := failed_tests(results)):
        first = ET.parse(results).getroot()
        attempt_tests(log, [*words, "-n", "0", *(f"{root}/{name}" for name in failed)], results)
        merge_results(root, first, results, mark=REPEATED)
    log.writelines(f"to debug this test: ./wr debug {name}\n" for name in failed_tests(results))
    return junit_counts(results)


def reported_numbers(results: Path) -> dict[str, float]:
    """Returns the numbers in the properties of the tests."""
    found = ET.parse(results).iter("property")
    return {one.get("name", ""): float(one.get("value", "0")) for one in found}


def attempt_tests(log: TextIO, words: Sequence[str | Path], results: Path) -> None:
    """Runs pytest. If pytest fails and has written no results, raises the error."""
    try:
        run(log, words)
    except FailureError:
        if not results.exists():
            raise
