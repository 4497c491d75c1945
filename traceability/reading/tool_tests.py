"""The results of the Python tests, which test the tools, the client and the pages."""

from __future__ import annotations

import ast
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

from traceability.reading.results import RESULTS
from traceability.reading.task_record import is_fresh
from traceability.schema import Counts
from traceability.sources import TESTS_OF_TOOLS

AFTER_PAGES = "site"  # tests of the built pages; the pages cannot contain their own results
LONG = "worked_examples"  # folder in which each test is long
LONG_MARK = "pytest.mark.long"  # mark of the tests that run only with ./wr test --long
# In a result file, attribute of each test that failed at first, and then ran once more.
REPEATED = "repeated"


def python_task(folder: str) -> str:
    """Returns the name of the task that runs the tests of a folder."""
    return f"tests (tools, {folder})"


def results_of(folder: str) -> Path:
    return RESULTS / f"pytest_{folder}.xml"


def junit_counts(results: Path) -> Counts:
    passed = failed = skipped = 0
    for case in ET.parse(results).iter("testcase"):
        if _failed(case):
            failed += 1
        elif case.find("skipped") is not None:
            skipped += 1
        else:
            passed += 1
    return Counts(passed, failed, skipped)


def failed_tests(results: Path) -> list[str]:
    """Returns the names of the failed tests, in the form that pytest and ./wr debug use."""
    return [name_of(case) for case in ET.parse(results).iter("testcase") if _failed(case)]


def _failed(case: ET.Element) -> bool:
    return case.find("failure") is not None or case.find("error") is not None


def name_of(case: ET.Element) -> str:
    return f"{case.get('classname', '').replace('.', '/')}.py::{case.get('name')}"


def repeated_tests(results: Path) -> list[str]:
    """Returns the names of the tests that failed at first, and whose second result counts."""
    return [name_of(case) for case in ET.parse(results).iter("testcase") if case.get(REPEATED)]


def long_tests(root: Path) -> dict[str, int]:
    """Returns the number of test functions with a long test, for each file that has such
    functions."""
    files = sorted((root / TESTS_OF_TOOLS).glob("*/test_*.py"))
    codes = {str(file.relative_to(root)): file.read_text(encoding="utf-8") for file in files}
    counts = {file: sum(_long(code)) for file, code in codes.items() if LONG_MARK in code}
    return {file: count for file, count in counts.items() if count}


def _long(code: str) -> Iterator[bool]:
    """Yields a value for each test function of a file: true if the function has a long test."""
    tree = ast.parse(code)
    assigned = [ast.unparse(node) for node in tree.body if isinstance(node, ast.Assign)]
    whole = any(text.startswith("pytestmark = ") and LONG_MARK in text for text in assigned)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
            yield whole or any(LONG_MARK in ast.unparse(each) for each in node.decorator_list)


def read_tool_tests(root: Path) -> dict[str, Counts | None]:
    """Returns the numbers of passed, failed and skipped tests for each folder of tests. The value
    is None if the tests did not run on the present files. The result leaves out the folders
    ``AFTER_PAGES`` and ``LONG``."""
    folders = sorted({path.parent.name for path in (root / TESTS_OF_TOOLS).glob("*/test_*.py")})
    return {
        folder: junit_counts(path)
        if path.exists() and is_fresh(root, python_task(folder))
        else None
        for folder in folders
        if folder not in (AFTER_PAGES, LONG)
        for path in [root / results_of(folder)]
    }
