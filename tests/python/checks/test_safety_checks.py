"""The tests of the checks hazard-* with wrong limits, test results and names. The folder
tests/drift has no seeded faults for these cases."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.python.model.small_case import make_model, write_case
from traceability.checks import safety_checks
from traceability.checks.safety_checks import LIMIT
from traceability.model.design_model import Model
from traceability.model.safety_case import safety_of
from traceability.reading.declared import Declared
from traceability.reading.toml_reader import Entries
from traceability.schema import HOST, Constant, Finding, Place

BRAKING = "at 50 expect braking 1 within {} ms\n"
FOLDER = 'auto k = "sim/scenario/safety";\nTEST_P(Safety, FR1_Stops) {\n  play(GetParam());\n}\n'


def check(root: Path, model: Model) -> list[Finding]:
    declared = Declared(entries=Entries(root), safety=model.safety)
    line_in = declared.entries.line_in
    facts: Any = SimpleNamespace(root=root, declared=declared, line_in=line_in)
    return list(safety_checks.check(replace(model, safety=safety_of(model, facts)), facts))


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (("base =", "base ="), ""),
        (("time = 0.35", "time = 0.32"), ""),
        (
            ("time = 0.35", "time = 0.31"),
            "the time of SG-1 is 0.31 s, but the value of its formula is 0.353 s",
        ),
        (
            ("time = 0.35", "time = 0.36"),
            "the time of SG-1 is 0.36 s, but the value of its formula is 0.353 s",
        ),
        (("0.3 / 0.85", "way / speed"), "the formula of SG-1 has no value: way / speed"),
        (("reaction = 0.2", "reaction = 0.35"), ""),
        (
            ("reaction = 0.2", "reaction = 0.351"),
            "the firmware needs 0.351 s for SG-1, but the goal allows 0.35 s",
        ),
        (("reaction = 0.2", 'reaction = 0.2\nparts = "2 * Times::kCycle"'), ""),
        (("reaction = 0.2", 'reaction = 0.22\nparts = "2 * Times::kCycle"'), ""),
        (
            ("reaction = 0.2", 'reaction = 0.3\nparts = "2 * Times::kCycle"'),
            "the reaction time of SG-1 is 0.3 s, but its formula gives 200 ms",
        ),
        (
            ("reaction = 0.2", 'reaction = 0.19\nparts = "2 * Times::kCycle"'),
            "the reaction time of SG-1 is 0.19 s, but its formula gives 200 ms",
        ),
        (
            ("reaction = 0.2", 'reaction = 0.2\nparts = "2 * Times::kGone"'),
            "the formula 'parts' of SG-1 has no value: 2 * Times::kGone",
        ),
        (('id = "HZ-1"', 'id = "H1"'), "H1 is not an id of a hazard"),
        (('["brake"]', '["brake", "fly"]'), "SG-1 names fly, which is not declared"),
        (
            ('["lost"]\nanswer', '["lost", "slope"]\nanswer'),
            "HZ-1 names slope, which is not declared",
        ),
        (('scenarios = ["lost"]\nanswer', "answer"), "the scenario lost is listed in no hazard"),
    ],
)
def test_a_change_of_the_case_is_found(tmp_path: Path, change: tuple[str, str], text: str) -> None:
    write_case(tmp_path, change)
    cycle = Constant(100, "ms", Place("src/Times.hpp", 1))
    model = replace(make_model(tmp_path), constants={"Times::kCycle": cycle})
    found = [one.text for one in check(tmp_path, model)]
    assert found == ([text] if text else [])


@pytest.mark.parametrize(
    ("velocity", "limit", "texts"),
    [
        ("0.85", 3000, []),
        (
            "0.3",
            3000,
            ["SG-1 declares a velocity of 0.3 m/s, but the greatest ordered velocity is 0.85 m/s"],
        ),
        ("0.8", 0, ["the formula of SG-1 does not contain its velocity of 0.8 m/s"]),
        (
            "0.85",
            3100,
            ["SG-1 declares a velocity of 0.85 m/s, but the greatest ordered velocity is 0.88 m/s"],
        ),
    ],
)
def test_the_velocity_of_a_goal_is_the_greatest_ordered_velocity(
    tmp_path: Path, velocity: str, limit: int, texts: list[str]
) -> None:
    write_case(tmp_path, ("reaction = 0.2", f"velocity = {velocity}\nreaction = 0.2"))
    (tmp_path / "sim/plant").mkdir(parents=True)
    (tmp_path / "sim/plant/DriveTrain.hpp").write_text(
        "  static constexpr double kRatio = 10.0;\n"
        "  static constexpr double kRadius = 0.272;  ///< [m]\n"
    )
    place = Place("src/services/SystemConstants.hpp", 1)
    constants = {LIMIT: Constant(limit, "0.1 rpm", place)} if limit else {}
    model = replace(make_model(tmp_path), constants=constants)
    assert [one.text for one in check(tmp_path, model)] == texts


def test_a_requirement_names_a_goal_that_exists(tmp_path: Path) -> None:
    write_case(tmp_path)
    model = make_model(tmp_path)
    model.requirements["FR-1"] = replace(model.requirements["FR-1"], goals=["SG-1", "SG-7"])
    texts = [one.text for one in check(tmp_path, model)]
    assert texts == ["FR-1 names the goal SG-7, which does not exist"]


def test_a_project_without_a_case_has_no_findings(tmp_path: Path) -> None:
    assert check(tmp_path, make_model(tmp_path)) == []


@pytest.mark.parametrize(
    ("scenario", "texts"),
    [
        (f"# Lost.\n# goal SG-1\n{BRAKING.format(350)}", []),
        (
            f"# Lost.\n# goal SG-1\n{BRAKING.format(351)}",
            ["the scenario lost accepts 0.351 s, but SG-1 allows 0.35 s"],
        ),
        (
            "# Lost.\n# goal SG-8\n",
            ["the scenario lost names the goal SG-8, which does not exist"],
        ),
    ],
)
def test_a_scenario_fits_its_goal(tmp_path: Path, scenario: str, texts: list[str]) -> None:
    write_case(tmp_path)
    (tmp_path / "sim/scenario/safety/lost.scenario").write_text(scenario)
    assert [one.text for one in check(tmp_path, make_model(tmp_path))] == texts


def test_a_scenario_and_its_hazard_have_a_goal_in_common(tmp_path: Path) -> None:
    write_case(tmp_path, ('["SG-1"]\nassumptions', "[]\nassumptions"))
    assert [one.text for one in check(tmp_path, make_model(tmp_path))] == [
        "SG-1 has no hazard",
        "HZ-1 lists the scenario lost, but the hazard and the scenario have no goal in common",
    ]


@pytest.mark.parametrize(
    ("result", "fresh", "texts"),
    [
        ("passed", True, []),
        ("failed", True, ["the scenario lost failed in Safety.FR1_Stops"]),
        ("skipped", True, ["the scenario lost did not pass in Safety.FR1_Stops"]),
        ("failed", False, []),
    ],
)
def test_a_scenario_passes_in_this_run(
    tmp_path: Path, result: str, fresh: bool, texts: list[str]
) -> None:
    write_case(tmp_path)
    model = make_model(tmp_path, result, fresh=fresh)
    assert [one.text for one in check(tmp_path, model)] == texts


@pytest.mark.parametrize(
    ("test", "played", "found"),
    [
        ("TEST(Safety, FR1_Stops) {\n}\n", [], True),
        (FOLDER, [], False),  # Without recordings, the test is a test of all scenarios.
        (FOLDER, ["Files_Safety.FR1_Stops_lost"], False),
        (FOLDER, ["Files_Safety.FR1_Stops_found"], True),
    ],
)
def test_a_test_plays_each_scenario(
    tmp_path: Path, test: str, played: list[str], found: bool
) -> None:
    write_case(tmp_path)
    (tmp_path / "tests/SafetyTest.cpp").write_text(test)
    model = make_model(tmp_path)
    results = model.tests["Safety.FR1_Stops"].results
    results[HOST] = replace(results[HOST], recordings=played)
    texts = [one.text for one in check(tmp_path, model)]
    assert texts == ["the scenario lost is played in no test"] * found
