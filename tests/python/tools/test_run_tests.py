"""./wr test: the tasks of a whole run, and the time of the first run."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tools import run_tests
from tools.task_graph import Graph, Task
from tools.tasks import (
    DOCUMENTS,
    LONG_TESTS,
    PAGES,
    PYTHON_TESTS,
    RESULT_TASKS,
    TESTS_SANITIZE,
    fresh_results,
)
from traceability.reading.results import TIMES, read_json
from traceability.reading.task_record import RECORD, SEEDED_FAULTS, TESTS_BOARD
from traceability.reading.tool_tests import python_task


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns a project whose tasks do nothing."""

    def graph_of(*names: str) -> Graph:
        return Graph(tmp_path, [Task(name, lambda _log: None, always=True) for name in names])

    results = [*RESULT_TASKS, TESTS_SANITIZE, SEEDED_FAULTS]
    results += map(python_task, PYTHON_TESTS)
    monkeypatch.setattr(run_tests, "graph", lambda _root: graph_of(*results))
    monkeypatch.setattr(
        run_tests, "pages_graph", lambda _root, **_: graph_of(DOCUMENTS, PAGES, LONG_TESTS)
    )
    monkeypatch.setattr(run_tests, "lint_tasks", lambda _root, **_: [])
    monkeypatch.setattr(run_tests, "report", lambda _root, _failed: 0)
    return tmp_path


def test_a_usual_run_names_the_old_results(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run_tests.test(root)
    shown = capsys.readouterr().out
    for name in run_tests.QUICK:
        assert re.search(rf"\] {re.escape(name)} \.\.\.", shown)
    assert PAGES not in shown
    assert f"missing: {', '.join(n for n in run_tests.WHOLE if n not in run_tests.QUICK)}" in shown
    run_tests.test_all(root, long=False, ci=False)
    capsys.readouterr()
    run_tests.test(root)
    assert "missing" not in capsys.readouterr().out


@pytest.mark.parametrize("long", [False, True])
def test_long_tests_and_seeded_faults_run_only_on_request(
    root: Path, capsys: pytest.CaptureFixture[str], *, long: bool
) -> None:
    run_tests.test_all(root, long=long, ci=False)
    shown = capsys.readouterr().out
    assert (LONG_TESTS in shown, SEEDED_FAULTS in shown) == (long, long)


def test_fresh_results_of_the_tests_are_a_reason_to_try_the_seeded_faults_again(
    tmp_path: Path,
) -> None:
    before = fresh_results(tmp_path)
    Graph(tmp_path, [Task(TESTS_BOARD, lambda _log: None)]).run([TESTS_BOARD])
    assert fresh_results(tmp_path) != before


def measured(root: Path) -> set[str]:
    return set(read_json(root / TIMES) or {})


def test_the_first_run_for_the_ci_is_measured(root: Path) -> None:
    run_tests.test_all(root, long=False, ci=True)
    assert measured(root) == {"build.ci_s"}


def test_a_later_run_is_not_measured(root: Path) -> None:
    (root / RECORD).parent.mkdir(parents=True)
    (root / RECORD).write_text("{}", encoding="utf-8")
    run_tests.test_all(root, long=False, ci=True)
    assert measured(root) == set()


def test_another_first_run_is_not_measured(root: Path) -> None:
    run_tests.test_all(root, long=False, ci=False)
    assert measured(root) == set()
