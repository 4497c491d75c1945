"""The list of the evidence that a build lacks."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from tests.python.model.small_case import make_model, report_of, write_case
from traceability.model.design_model import Model
from traceability.model.not_shown import not_shown
from traceability.reading.published import Published
from traceability.schema import BuildEvidence, LintRun


def texts(root: Path, **values: Any) -> list[str]:
    write_case(root)
    model: Model = replace(make_model(root), **values)
    return [one.text for one in not_shown(model, report_of(model))]


def build(lint: LintRun | None) -> BuildEvidence:
    return BuildEvidence("abc", [], "Linux", 4, {}, {}, [], lint)


def test_a_static_analysis_that_was_not_run_is_listed(tmp_path: Path) -> None:
    missing = "The static analysis (./wr lint) was not run in this build."
    part = "These steps of the static analysis (./wr lint) were not run in this build: clang-tidy."
    steps = {"ruff": "passed", "clang-tidy": "not run"}
    assert missing in texts(tmp_path, build=build(None))
    assert part in texts(tmp_path, build=build(LintRun("abc", steps)))
    complete = texts(tmp_path, build=build(LintRun("abc", {"clang-tidy": "passed"})))
    assert not [text for text in complete if "static analysis" in text]


def test_long_and_repeated_tests_are_listed(tmp_path: Path) -> None:
    ran = replace(build(None), long_tests={"a": 2, "b": 1}, repeated=["test_it.py::test_it"])
    found = texts(tmp_path, build=ran)
    assert [text for text in found if "part of this build: 3 test functions in 2 files." in text]
    assert "1 test of the client failed at first. Only the second result counts." in found


def test_failed_python_tests_are_listed_by_name(tmp_path: Path) -> None:
    failed = replace(build(None), failed=["tests/python/model/test_it.py::test_it"])
    (text,) = (one for one in texts(tmp_path, build=failed) if "Python test" in one)
    assert "1 Python test of the tools" in text
    assert "failed: tests/python/model/test_it.py::test_it." in text


def test_lines_of_the_drivers_that_no_test_executed_are_listed(tmp_path: Path) -> None:
    lines = {"src/k64/a.cpp": {1: True, 2: False}, "src/k64/b.cpp": {1: True}}
    missing = "No test executed 1 of the 3 lines of the drivers of the K64."
    assert [text for text in texts(tmp_path, board_lines=lines) if missing in text]
    executed = texts(tmp_path, board_lines={"src/k64/a.cpp": {1: True}})
    assert not [text for text in executed if "drivers of the K64" in text]


def test_silent_faults_of_the_last_campaign_are_listed(tmp_path: Path) -> None:
    record = Published("", "aab5f7d322", "2026", {"cases": 100, "outcomes": {"silent": 3}})
    found = texts(tmp_path, campaigns={"faults": record})
    (text,) = (one for one in found if "campaign" in one)
    assert "at commit aab5f7d, 3 of 100 faults caused wrong outputs" in text
