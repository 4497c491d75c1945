"""The results of Python tests are used only while the tested files are unchanged."""

from __future__ import annotations

from pathlib import Path

from tests.python.project_files import write_files
from tests.python.reading.task_records import record_task
from traceability.reading.tool_tests import (
    long_tests,
    python_task,
    read_tool_tests,
    results_of,
)
from traceability.schema import Counts

CASES = "<testsuites><testsuite><testcase/><testcase><failure/></testcase></testsuite></testsuites>"


def test_results_are_valid_only_for_the_present_files(tmp_path: Path) -> None:
    """The tests of the pages run after the pages are built. Therefore the pages cannot show the
    results of these tests."""
    for folder in ("model", "reading", "site"):
        files = {f"tests/python/{folder}/test_it.py": "", str(results_of(folder)): CASES}
        write_files(tmp_path, files)
    record_task(tmp_path, python_task("model"), "tests/python/model")
    record_task(tmp_path, python_task("site"), "tests/python/site")
    assert read_tool_tests(tmp_path) == {"model": Counts(1, 1, 0), "reading": None}
    write_files(tmp_path, {"tests/python/model/test_it.py": "changed"})
    assert read_tool_tests(tmp_path) == {"model": None, "reading": None}


def test_long_tests_are_counted_by_their_marks(tmp_path: Path) -> None:
    marked = "@pytest.mark.long\ndef test_a(): ...\ndef test_b(): ...\n"
    part = "@pytest.mark.parametrize('n', [pytest.param(1, marks=pytest.mark.long)])\n"
    whole = "pytestmark = [pytest.mark.runs_tools, pytest.mark.long]\n"
    texts = {"a": marked, "b": part + marked, "c": whole + marked, "d": ""}
    write_files(tmp_path, {f"tests/python/tools/test_{k}.py": text for k, text in texts.items()})
    names = ["tests/python/tools/test_a.py", "tests/python/tools/test_b.py"]
    assert long_tests(tmp_path) == {**dict.fromkeys(names, 1), "tests/python/tools/test_c.py": 2}
