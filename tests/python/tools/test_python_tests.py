"""The files on which the tests of a folder of tests/python depend."""

from __future__ import annotations

from pathlib import Path

from tools.python_tests import imported_files
from tools.tasks import PYTHON_TESTS, graph, python_task

ROOT = Path(__file__).parents[3]


def write(root: Path, **files: str) -> None:
    for name, text in files.items():
        path = root / f"{name.replace('__', '/')}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def test_a_test_depends_on_the_files_that_it_imports_directly_or_not(tmp_path: Path) -> None:
    write(
        tmp_path,
        tests__python__reading__test_one="from traceability.reading.one import (\n    first,\n)\n",
        tests__python__model__test_two="import traceability.other\n",
        traceability__reading__one="def first():\n    from traceability import inner\n",
        traceability__inner="import portal.page as page\n",
        traceability__other="import os\n",
        site__portal__page="",
    )
    assert imported_files(tmp_path, "reading") == [
        "site/portal/page.py",
        "tests/python/reading/test_one.py",
        "traceability/inner.py",
        "traceability/reading/one.py",
    ]


def test_a_change_of_a_page_does_not_repeat_the_tests_of_the_readers() -> None:
    tasks = {task.name: task for task in graph(ROOT).tasks}
    inputs = {folder: set(tasks[python_task(folder)].inputs) for folder in PYTHON_TESTS}
    assert "site/portal/pages.py" in inputs["portal"]
    assert "site/portal/pages.py" not in inputs["reading"]


def test_helpers_of_another_folder_are_inputs() -> None:
    """The tests of the checks import the small safety case from the tests of the model."""
    assert "tests/python/model/small_case.py" in imported_files(ROOT, "checks")
