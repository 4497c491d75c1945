"""The files on which Python tests depend, and the tests that run again after a change."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

import pytest

from tests.python.project_files import write_files
from tools import python_tests
from tools.python_imports import inputs_of
from tools.python_tests import (
    affected_tests,
    merge_results,
    run_pytest,
    update_pytest,
)
from tools.tasks import PYTHON_TESTS, graph
from traceability.reading.results import RESULTS
from traceability.reading.tool_tests import python_task, repeated_tests, results_of

pytestmark = pytest.mark.reads(".")  # graph() reads the files that changed since the last run

ROOT = Path(__file__).parents[3]


def test_a_test_depends_on_the_files_that_it_imports_directly_or_not(tmp_path: Path) -> None:
    imported = "from traceability.reading.one import (\n    first,\n)\n"
    files = {
        "tests/python/reading/test_one.py": imported,
        "tests/python/model/test_two.py": "import traceability.other\n",
        "traceability/reading/one.py": "def first():\n    from traceability import inner\n",
        "traceability/inner.py": "import portal.page as page\n",
        "traceability/other.py": "import os\n",
        "site/portal/page.py": "",
    }
    write_files(tmp_path, files)
    assert inputs_of(tmp_path, "reading") == {
        "site/portal/page.py",
        "tests/python/reading/test_one.py",
        "traceability/inner.py",
        "traceability/reading/one.py",
    }


def test_a_change_of_a_page_does_not_repeat_the_tests_of_the_readers() -> None:
    tasks = {task.name: task for task in graph(ROOT).tasks}
    inputs = {folder: set(tasks[python_task(folder)].inputs) for folder in PYTHON_TESTS}
    assert "site/portal/pages.py" in inputs["portal"]
    assert "site/portal/pages.py" not in inputs["reading"]


def test_helpers_of_another_folder_are_inputs() -> None:
    """The tests of the checks import small_case.py from the tests of the model. Therefore
    small_case.py is an input of the tests of the checks."""
    assert "tests/python/model/small_case.py" in inputs_of(ROOT, "checks")


# ---- a change of some files ----------------------------------------------------


def small_project(root: Path) -> None:
    files = {
        "tests/python/tools/test_one.py": "from tools import one\n",
        "tests/python/tools/test_program.py": "pytestmark = pytest.mark.runs_tools\n",
        "tests/python/tools/test_command.py": "from tools import cli\n",
        "tests/python/tools/test_other.py": "import re\n",
        "tests/python/tools/test_reader.py": 'pytestmark = pytest.mark.reads("sim", "a.toml")\n',
        "tests/python/model/test_one.py": "from tools import one\n",
        **dict.fromkeys(("tools/one.py", "tools/two.py", "tools/cli.py"), ""),
    }
    write_files(root, files)


def affected(root: Path, *changed: str) -> set[str] | None:
    found = affected_tests(root, "tools", changed)
    return None if found is None else {Path(name).stem for name in found}


def test_a_changed_tool_affects_tests_that_import_it_or_run_the_tools_as_programs(
    tmp_path: Path,
) -> None:
    small_project(tmp_path)
    assert affected(tmp_path, "tools/one.py") == {"test_one", "test_program", "test_command"}
    assert affected(tmp_path, "tools/two.py") == {"test_program", "test_command"}


def test_a_changed_test_affects_only_itself(tmp_path: Path) -> None:
    small_project(tmp_path)
    assert affected(tmp_path, "tests/python/tools/test_other.py") == {"test_other"}


@pytest.mark.parametrize("file", ["sim/frame_table.py", "sim/plant/Plant.hpp", "a.toml"])
def test_a_change_of_a_file_that_tests_read_affects_these_tests(tmp_path: Path, file: str) -> None:
    small_project(tmp_path)
    assert affected(tmp_path, file) == {"test_reader"}
    assert affected(tmp_path, file, "tests/python/tools/test_one.py") == {"test_reader", "test_one"}


def test_a_test_that_reads_the_whole_project_has_the_inputs_of_the_pages() -> None:
    tasks = {task.name: task for task in graph(ROOT).tasks}
    assert {"src", "docs", "site", "setup"} <= set(tasks[python_task("tools")].inputs)
    assert "." not in tasks[python_task("tools")].inputs


@pytest.mark.parametrize("other", ["design/uses.toml", "pyproject.toml", "a.toml.txt"])
def test_each_other_file_affects_all_tests(tmp_path: Path, other: str) -> None:
    small_project(tmp_path)
    assert affected(tmp_path, "tools/one.py", other) is None


def write_results(root: Path, *cases: tuple[str, str, bool]) -> Path:
    """Writes a result file. Each case consists of the test file, the name of the test, and a flag
    that is true if the test passed."""
    suite = ET.Element("testsuite")
    for file, name, passed in cases:
        case = ET.SubElement(suite, "testcase", classname=f"tests.python.tools.{file}", name=name)
        if not passed:
            ET.SubElement(case, "failure")
    path = root / RESULTS / "pytest_tools.xml"
    path.parent.mkdir(parents=True, exist_ok=True)
    whole = ET.Element("testsuites")
    whole.append(suite)
    ET.ElementTree(whole).write(path)
    return path


def cases_of(results: Path) -> set[tuple[str, str, bool]]:
    return {
        (case.get("classname", "").split(".")[-1], case.get("name", ""), len(case) == 0)
        for case in ET.parse(results).iter("testcase")
    }


def test_results_of_unaffected_tests_remain(tmp_path: Path) -> None:
    small_project(tmp_path)
    old = [("test_one", "a", True), ("test_one", "removed", True), ("test_other", "b", True)]
    before = ET.parse(write_results(tmp_path, *old, ("test_deleted", "c", True))).getroot()
    results = write_results(tmp_path, ("test_one", "a", False))
    merge_results(tmp_path, before, results, ["tests/python/tools/test_one.py"])
    assert cases_of(results) == {("test_one", "a", False), ("test_other", "b", True)}


def test_failed_tests_run_again_after_each_change(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small_project(tmp_path)
    write_results(tmp_path, ("test_one", "a", True), ("test_other", "b", False))
    ran: list[str] = []

    def run(_log: TextIO, words: Sequence[str | Path]) -> None:
        ran.extend(Path(word).stem for word in words if Path(word).suffix == ".py")
        write_results(tmp_path, *((name, "b", True) for name in ran))

    monkeypatch.setattr(python_tests, "run", run)
    changed = frozenset(["tests/python/tools/test_program.py"])
    with (tmp_path / "log").open("w") as log:
        outcome = update_pytest(tmp_path, "tools", log, changed)
    assert ran == ["test_other", "test_program"]
    assert (outcome.values["passed"], outcome.failed) == (3, False)


def test_only_the_failed_tests_of_the_client_run_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs: list[list[str]] = []

    def run(_log: TextIO, words: Sequence[str | Path]) -> None:
        runs.append([str(word) for word in words])
        cases = [("test_one", "a", True), ("test_two", "b[c d]", len(runs) == 2)]
        write_results(tmp_path, *cases[len(runs) - 1 :]).rename(
            tmp_path / RESULTS / "pytest_client.xml"
        )

    monkeypatch.setattr(python_tests, "run", run)
    with (tmp_path / "log").open("w") as log:
        outcome = run_pytest(tmp_path, "client", log)
    named = [[word for word in words if "/tests/python/" in word] for words in runs]
    assert named == [
        [f"{tmp_path}/tests/python/client"],
        [f"{tmp_path}/tests/python/tools/test_two.py::b[c d]"],
    ]
    assert not outcome.failed
    second = repeated_tests(tmp_path / results_of("client"))
    assert second == ["tests/python/tools/test_two.py::b[c d]"]
