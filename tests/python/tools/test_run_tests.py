"""./wr test: the tasks of a whole run, and the time of the first run."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import TextIO

import pytest

from tools import run_tests
from tools.documents import TIMES
from tools.task_graph import Graph, Outcome, Task
from tools.tasks import (
    DOCUMENTS,
    PAGES,
    PYTHON_TESTS,
    RESULT_TASKS,
    TESTS_SANITIZE,
    python_task,
)
from traceability.reading.results import read_json
from traceability.reading.task_record import FIRMWARE_FAULTS, RECORD


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns a project whose tasks do nothing."""

    def graph_of(*names: str) -> Graph:
        return Graph(tmp_path, [Task(name, lambda _log: None, always=True) for name in names])

    results = [*RESULT_TASKS, TESTS_SANITIZE]
    results += map(python_task, PYTHON_TESTS)
    monkeypatch.setattr(run_tests, "graph", lambda _root: graph_of(*results))
    monkeypatch.setattr(run_tests, "pages_graph", lambda _root: graph_of(DOCUMENTS, PAGES))
    monkeypatch.setattr(run_tests, "lint_tasks", lambda _root: [])
    monkeypatch.setattr(run_tests, "report", lambda _findings, _failed: 0)
    return tmp_path


def measured(root: Path) -> set[str]:
    return set(read_json(root / TIMES) or {})


def test_the_first_whole_run_with_lint_is_measured(root: Path) -> None:
    run_tests.test(root, long=False, lint=True)
    assert measured(root) == {"build.ci_s"}


def test_a_later_run_is_not_measured(root: Path) -> None:
    (root / RECORD).parent.mkdir(parents=True)
    (root / RECORD).write_text("{}", encoding="utf-8")
    run_tests.test(root, long=False, lint=True)
    assert measured(root) == set()


def test_a_run_without_lint_is_not_measured(root: Path) -> None:
    run_tests.test(root, long=False, lint=False)
    assert measured(root) == set()


def test_the_pages_are_made_while_tests_of_the_tools_still_run(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started = threading.Event()

    def wait_for_pages(_log: TextIO) -> Outcome:
        return Outcome("", failed=not started.wait(timeout=10))

    def make_pages(_log: TextIO) -> None:
        started.set()

    results = [Task(name, lambda _log: None, always=True) for name in RESULT_TASKS]
    tools = [Task(python_task(name), lambda _log: None, always=True) for name in PYTHON_TESTS]
    last = Task(TESTS_SANITIZE, wait_for_pages, always=True)
    pages = [Task(DOCUMENTS, make_pages, always=True), Task(PAGES, lambda _log: None, always=True)]
    failed: list[str] = []

    def report(_findings: object, tasks: list[str]) -> int:
        failed.extend(tasks)
        return 0

    monkeypatch.setattr(run_tests, "graph", lambda _root: Graph(root, [*results, *tools, last]))
    monkeypatch.setattr(run_tests, "pages_graph", lambda _root: Graph(root, pages))
    monkeypatch.setattr(run_tests, "report", report)
    run_tests.test(root, long=False, lint=False)
    assert failed == []


def test_the_pages_are_made_after_the_results_that_they_show(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    order: list[str] = []

    def recorded(name: str, *after: str) -> Task:
        return Task(name, lambda _log: order.append(name), after=after, always=True)

    names = [*RESULT_TASKS, TESTS_SANITIZE, *map(python_task, PYTHON_TESTS)]
    monkeypatch.setattr(run_tests, "graph", lambda _root: Graph(root, [*map(recorded, names)]))
    pages = [recorded(DOCUMENTS), recorded(PAGES, DOCUMENTS)]
    monkeypatch.setattr(run_tests, "pages_graph", lambda _root: Graph(root, pages))
    run_tests.test(root, long=False, lint=False)
    shown = [order.index(name) for name in (*RESULT_TASKS, FIRMWARE_FAULTS)]
    assert max(shown) < order.index(DOCUMENTS) < order.index(PAGES)
