"""The results of the Python tests, which test the tools, the client and the pages."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

from traceability.reading.results import RESULTS
from traceability.reading.task_record import is_fresh
from traceability.schema import Counts
from traceability.sources import TESTS_OF_TOOLS

AFTER_PAGES = "site"  # tests of the built pages; the pages cannot contain their own results
LONG = "worked_examples"  # tests that run only with ./wr test --long


def python_task(folder: str) -> str:
    """Returns the name of the task that runs the tests of a folder."""
    return f"tests (tools, {folder})"


def results_of(folder: str) -> Path:
    """Returns the path of the result file of the tests of a folder."""
    return RESULTS / f"pytest_{folder}.xml"


def junit_counts(results: Path) -> Counts:
    """Returns the counts in a result file of pytest."""
    passed = failed = skipped = 0
    for case in ET.parse(results).iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            failed += 1
        elif case.find("skipped") is not None:
            skipped += 1
        else:
            passed += 1
    return Counts(passed, failed, skipped)


def read_tool_tests(root: Path) -> dict[str, Counts | None]:
    """Returns the counts for each folder of tests. They are None if the tests did not run on the
    present files. The result leaves out the folders ``AFTER_PAGES`` and ``LONG``.
    """
    folders = sorted({path.parent.name for path in (root / TESTS_OF_TOOLS).glob("*/test_*.py")})
    return {
        folder: junit_counts(path)
        if path.exists() and is_fresh(root, python_task(folder))
        else None
        for folder in folders
        if folder not in (AFTER_PAGES, LONG)
        for path in [root / results_of(folder)]
    }
