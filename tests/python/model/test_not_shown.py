"""The list of the evidence that is missing in a build."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from tests.python.model.small_case import make_model, report_of, write_case
from traceability.model.design_model import Model
from traceability.model.not_shown import not_shown
from traceability.reading.published import Published
from traceability.schema import (
    HOST,
    BuildEvidence,
    Counts,
    Finding,
    LastRecord,
    LintRun,
    LoopRun,
    LoopScenario,
    Place,
    Port,
)


def texts(root: Path, **values: Any) -> list[str]:
    write_case(root)
    model: Model = replace(make_model(root), **values)
    return [one.text for one in not_shown(model, report_of(model))]


def build(lint: LintRun | None) -> BuildEvidence:
    return BuildEvidence("abc", [], "Linux", 4, {}, {}, [], lint)


def test_a_static_analysis_that_was_not_run_or_failed_is_listed(tmp_path: Path) -> None:
    missing = "The static analysis (./wr lint) was not run in this build."
    part = "These steps of the static analysis (./wr lint) were not run in this build: clang-tidy."
    steps = {"ruff": "passed", "clang-tidy": "not run"}
    assert missing in texts(tmp_path, build=build(None))
    assert part in texts(tmp_path, build=build(LintRun("abc", steps)))
    failed = "These steps of the static analysis (./wr lint) failed in this build: prose."
    assert failed in texts(tmp_path, build=build(LintRun("abc", {**steps, "prose": "failed"})))
    complete = texts(tmp_path, build=build(LintRun("abc", {"clang-tidy": "passed"})))
    assert not [text for text in complete if "static analysis" in text]


def test_long_and_repeated_tests_are_listed(tmp_path: Path) -> None:
    ran = replace(build(None), long_tests={"a": 2, "b": 1}, repeated=["test_it.py::test_it"])
    found = texts(tmp_path, build=ran)
    assert [text for text in found if "part of this build: 3 test functions in 2 files." in text]
    assert "1 test of the client failed at first. Only the second result counts." in found


def test_folders_of_python_tests_without_a_result_are_listed(tmp_path: Path) -> None:
    counts = {"client": None, "model": Counts(1, 0, 0), "tools": None}
    found = texts(tmp_path, build=replace(build(None), tool_tests=counts))
    assert [text for text in found if text.endswith("with these sources: client, tools.")]


def test_failed_python_tests_are_listed_by_name(tmp_path: Path) -> None:
    failed = replace(build(None), failed=["tests/python/model/test_it.py::test_it"])
    (text,) = (one for one in texts(tmp_path, build=failed) if "Python test" in one)
    assert "1 Python test of the tools" in text
    assert "failed: tests/python/model/test_it.py::test_it." in text


def test_results_that_this_build_lacks_are_listed(tmp_path: Path) -> None:
    loop = LoopScenario("a", "A", "", "", Place("a", 1), [], [], {HOST: LoopRun(True, "")})
    port = Port("A", "", "", "", "", {}, 0, 0, {"A.B": "failed"}, {}, {})
    missing = {
        "The faults seeded in the drivers were not tried with these sources.",
        "The times of the control cycle were not measured with these sources.",
        "For 1 of 1 scenarios of the control performance, a run with these sources is missing (on "
        "the host or on the virtual board).",
        "These ports to other devices have a failed test, or no test results with these sources: "
        "k20.",
    }
    found = texts(tmp_path, closed_loop=[loop], ports={"k20": port})
    assert missing <= set(found)


def test_lines_of_the_drivers_that_no_test_executed_are_listed(tmp_path: Path) -> None:
    lines = {"src/k64/a.cpp": {1: True, 2: False}, "src/k64/b.cpp": {1: True}}
    missing = "the tests did not execute 1 of the 3 lines of src/k64."
    assert [text for text in texts(tmp_path, board_lines=lines) if missing in text]
    executed = texts(tmp_path, board_lines={"src/k64/a.cpp": {1: True}})
    assert not [text for text in executed if "src/k64" in text]


def test_drivers_of_extensions_without_measured_lines_are_listed(tmp_path: Path) -> None:
    found = texts(tmp_path, files=["extensions/safety/k64/pool.cpp", "extensions/safety/A.cpp"])
    (text,) = (one for one in found if "of the extensions" in one)
    assert text.endswith("are not measured: extensions/safety/k64/pool.cpp.")


def test_evidence_of_single_products_and_unmeasured_coverage_are_listed(tmp_path: Path) -> None:
    found = texts(tmp_path)
    assert [text for text in found if "The section “Tested products” names" in text]
    assert [text for text in found if text.endswith("MC/DC is not measured.")]


def test_campaigns_that_were_not_repeated_are_listed(tmp_path: Path) -> None:
    counts = {"silent": 3, "late": 4, "hung": 0, "stopped": 5}
    record = Published("", "aab5f7d322", "2026", {"cases": 100, "outcomes": counts})
    found = texts(tmp_path, campaigns={"faults": record, "fuzz": record})
    faults, fuzz = (one for one in found if "./wr campaign" in one)
    assert "at commit aab5f7d. Of 100 faults, 3 caused wrong outputs" in faults
    assert "4 were detected too late" in faults
    assert "5 were not judged" in faults
    assert fuzz.endswith("Its last run was at commit aab5f7d.")


def test_goals_with_results_of_old_drives_are_listed(tmp_path: Path) -> None:
    write_case(tmp_path)
    model = make_model(tmp_path)
    name, goal = next(iter(model.safety.goals.items()))
    goals = {name: replace(goal, exceptions=["These drives last ran at commit 1."])}
    found = texts(tmp_path, safety=replace(model.safety, goals=goals))
    assert [text for text in found if f"in the known exceptions of {name}" in text]


def test_the_requirements_of_each_state_and_the_findings_are_counted(tmp_path: Path) -> None:
    write_case(tmp_path)
    model = make_model(tmp_path)
    finding = Finding(Place("a.cpp", 1), "suspect-method", "changed")
    report = replace(report_of(model, {"FR-1": "suspect", "FR-2": "failed"}), findings=[finding])
    found = {one.text: (one.page, one.query) for one in not_shown(model, report)}
    (suspect,) = (text for text in found if text.startswith("Number of suspect requirements"))
    assert suspect.endswith("since the baseline): 1.")
    assert found[suspect] == ("requirements", "state=suspect")
    assert "Number of requirements with a failed test: 1." in found
    assert found["The checks report 1 finding."] == ("checks", "")
    verified = [one.text for one in not_shown(model, report_of(model))]
    assert not [text for text in verified if text.startswith(("Number of suspect", "The checks"))]


def test_a_run_that_was_not_repeated_names_its_commit(tmp_path: Path) -> None:
    write_case(tmp_path)
    last = LastRecord("mutate", "aab5f7d322", 8, 9, False, "2026")
    model = replace(
        make_model(tmp_path), last=dict.fromkeys(("mutation", "drift", "release"), last)
    )
    found = not_shown(model, report_of(model))
    commits = {one.page: one.commit for one in found}
    assert (commits["mutation"], commits["drift"]) == ("aab5f7d322", "")
    release = "./wr release --verify was not run in this build."
    assert f"{release} Its last run was at commit aab5f7d on 2026." in [one.text for one in found]
    assert release in texts(tmp_path)
    current = {"release": replace(last, current=True)}
    assert not [text for text in texts(tmp_path, last=current) if "release" in text]


def test_hazards_that_no_scenario_plays_are_listed(tmp_path: Path) -> None:
    write_case(tmp_path, ('scenarios = ["lost"]\n', ""))
    model = make_model(tmp_path)
    found = [one.text for one in not_shown(model, report_of(model))]
    assert "Number of hazards without a fault scenario: 1 of 1 (HZ-1)." in found
    assert not [text for text in texts(tmp_path) if "without a fault scenario" in text]
