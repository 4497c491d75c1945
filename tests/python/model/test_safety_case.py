"""The safety case: levels, times, links, and the verdicts of the goals in this run."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.python.model.small_case import make_model, report_of, write_case
from traceability.model.design_model import Model
from traceability.model.metrics import safety
from traceability.model.report import Verdict
from traceability.model.safety_case import plays, safety_of
from traceability.reading.declared import Declared
from traceability.reading.declared_safety import (
    level_of,
    read_safety_case,
)
from traceability.reading.formulas import value_of
from traceability.reading.toml_reader import Entries
from traceability.schema import HOST

pytestmark = pytest.mark.reads("design/safety_case.toml", "sim/scenario/safety")

ROOT = Path(__file__).resolve().parents[3]


def settled(root: Path, model: Model | None = None) -> Model:
    """Returns a copy of a model, with the links of the safety case of this model. The default model
    is the model of ``make_model``."""
    model = model or make_model(root)
    facts: Any = SimpleNamespace(root=root, declared=Declared(safety=model.safety))
    return replace(model, safety=safety_of(model, facts))


def test_a_case_is_read_with_its_links_both_ways(tmp_path: Path) -> None:
    write_case(tmp_path)
    entries = Entries(tmp_path)
    case = read_safety_case(tmp_path, entries)
    entries.others()
    assert entries.problems == []
    assert case.hazards["HZ-1"].level == "c"
    assert case.goals["SG-1"].hazards == ["HZ-1"]
    assert case.goals["SG-1"].level == "c"
    assert case.goals["SG-1"].computed == pytest.approx(0.3529, abs=1e-4)
    assert case.assumptions["AU-1"].hazards == ["HZ-1"]
    assert case.scenarios["lost"].goals == ["SG-1"]
    assert case.scenarios["lost"].title == "The radio is lost."
    assert case.scenarios["lost"].expects == {4: "at 50 expect braking 1 within 300 ms"}


def test_the_risk_graph_of_the_project_follows_the_sum_of_its_three_estimates() -> None:
    """The level depends on the three numbers of severity (S), exposure (E) and avoidance (C). As in
    the standard, the level is QM if S or C is 0, or if the sum of the three numbers is at most 5.
    Each further 1 in the sum raises the level by one."""
    case = read_safety_case(ROOT, Entries(ROOT))
    for s, e, c in product(range(4), range(5), range(4)):
        rises = s > 0 and c > 0
        wanted = case.levels[max(0, s + e + c - 5)] if rises else "QM"
        assert level_of(case, f"S{s}", f"E{e}", f"C{c}") == wanted, (s, e, c)


@pytest.mark.parametrize(
    ("formula", "value"),
    [
        ("0.3 / 0.85", 0.352941),
        ("(2 * 0.1 / (0.1 * 9.81)) ** 0.5", 0.451524),
        ("1.5 - 0.5 + 1", 2.0),
        ("1 / 0", None),
        ("open('x')", None),
        ("speed / 2", None),
        ("", None),
    ],
)
def test_a_formula_is_of_numbers_only(formula: str, value: float | None) -> None:
    assert value_of(formula, {}) == (value if value is None else pytest.approx(value, abs=1e-6))


@pytest.mark.parametrize(
    ("body", "runs", "whether"),
    [
        ('play("lost")', [], True),
        ('play("safety/lost.scenario")', [], True),
        ('play("lost_wheel")', [], False),
        ("play(GetParam())", ["All_Safety.Plays_lost"], True),
        ("play(GetParam())", ["All_Safety.Plays_0"], False),
        ("play(GetParam())", ["All_Safety.Plays_clock_lost"], False),
    ],
)
def test_a_test_plays_the_scenario_that_it_names(body: str, runs: list[str], whether: bool) -> None:
    assert plays("lost", "Plays", body, runs) is whether


def test_a_goal_is_verified_by_its_requirements_and_scenarios(tmp_path: Path) -> None:
    write_case(tmp_path)
    model = settled(tmp_path)
    assert model.safety.scenarios["lost"].tests == ["Safety.FR1_Stops"]
    report = report_of(model)
    assert report.scenarios["lost"] == "verified"
    assert report.goals["SG-1"] == Verdict("verified", [])


@pytest.mark.parametrize(
    ("result", "fresh", "scenario", "goal"),
    [
        ("failed", True, "failed", "failed"),
        ("skipped", True, "unverified", "open"),
        (None, True, "unverified", "open"),
        ("passed", False, "stale", "open"),
        ("failed", False, "stale", "open"),
        (None, False, "stale", "open"),
    ],
)
def test_a_scenario_that_did_not_pass_in_this_run_leaves_its_goal_open(
    tmp_path: Path, result: str | None, fresh: bool, scenario: str, goal: str
) -> None:
    write_case(tmp_path)
    report = report_of(settled(tmp_path, make_model(tmp_path, result, fresh=fresh)))
    assert report.scenarios["lost"] == scenario
    assert report.goals["SG-1"].state == goal


@pytest.mark.parametrize(("own", "state"), [("passed", "verified"), ("failed", "failed")])
def test_an_instance_of_a_test_decides_about_its_scenario(
    tmp_path: Path, own: str, state: str
) -> None:
    """The test has an instance for each scenario. A failed instance for another scenario does not
    change the verdict of the scenario ``lost``."""
    write_case(tmp_path)
    model = settled(tmp_path, make_model(tmp_path, "failed"))
    runs = model.tests["Safety.FR1_Stops"].results
    instances = {"All_Safety.FR1_Stops_lost": own, "All_Safety.FR1_Stops_found": "failed"}
    runs[HOST] = replace(runs[HOST], instances=instances)
    assert report_of(model).scenarios["lost"] == state


@pytest.mark.parametrize("state", ["partly", "suspect", "stale", "unverified"])
def test_a_requirement_that_is_not_verified_leaves_its_goal_open(
    tmp_path: Path, state: str
) -> None:
    write_case(tmp_path)
    goal = report_of(settled(tmp_path), {"FR-1": state}).goals["SG-1"]
    assert goal.state == "open"
    assert "FR-1" in goal.reasons[0]


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ('exceptions = ["with two faults"]', "known exception: with two faults"),
        ('open_points = ["on a slope"]', "open point: on a slope"),
    ],
)
def test_an_open_goal_has_its_reason(tmp_path: Path, line: str, reason: str) -> None:
    write_case(tmp_path, ("reaction = 0.2", f"reaction = 0.2\n{line}"))
    goal = report_of(settled(tmp_path)).goals["SG-1"]
    assert (goal.state, goal.reasons) == ("open", [reason])


def test_a_goal_that_nothing_names_is_open(tmp_path: Path) -> None:
    write_case(tmp_path)
    (tmp_path / "sim/scenario/safety/lost.scenario").write_text("# The radio is lost.\n")
    model = make_model(tmp_path)
    model.requirements["FR-1"] = replace(model.requirements["FR-1"], goals=[])
    goal = report_of(settled(tmp_path, model)).goals["SG-1"]
    reasons = ["no requirement serves this goal", "no fault scenario tests this goal"]
    assert (goal.state, goal.reasons) == ("open", reasons)


def test_what_was_not_measured_is_null(tmp_path: Path) -> None:
    write_case(tmp_path)
    model = settled(tmp_path)
    report = report_of(model)
    assert safety(model.safety, report, fresh=True) == {
        "safety.goals": 1,
        "safety.goals_verified": 1,
        "safety.fault_scenarios": 1,
        "safety.fault_scenarios_passed": 1,
        "safety.existing_lines_touched": None,  # There is no git history.
    }
    stale = safety(model.safety, report, fresh=False)
    assert stale["safety.goals_verified"] is None
    assert stale["safety.fault_scenarios_passed"] is None
