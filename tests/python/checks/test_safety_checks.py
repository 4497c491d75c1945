"""hazard-*: a complete safety case has no findings, and each gap has one at its place."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.python.model.small_case import make_model, write_case
from traceability.checks import safety_checks
from traceability.model.design_model import Model
from traceability.model.safety_case import safety_of
from traceability.reading.declared import Declared
from traceability.reading.toml_reader import Entries
from traceability.schema import HOST, Finding


def check(root: Path, model: Model) -> list[Finding]:
    declared = Declared(entries=Entries(root), safety=model.safety)
    facts: Any = SimpleNamespace(root=root, declared=declared)
    return safety_checks.check(replace(model, safety=safety_of(model, facts)), facts)


def found(root: Path, *changes: tuple[str, str]) -> list[tuple[str, str, str]]:
    """Check, text and line of the findings of a case with changes."""
    write_case(root, *changes)
    findings = check(root, make_model(root))
    return [(one.check, one.text, line_of(root, one)) for one in findings]


def line_of(root: Path, finding: Finding) -> str:
    path = root / finding.place.file
    return path.read_text().splitlines()[finding.place.line - 1] if path.exists() else ""


def test_a_complete_case_has_no_findings(tmp_path: Path) -> None:
    assert found(tmp_path) == []


def test_a_project_without_a_case_has_no_findings(tmp_path: Path) -> None:
    assert check(tmp_path, make_model(tmp_path)) == []


def test_a_goal_that_is_not_declared(tmp_path: Path) -> None:
    assert found(tmp_path, ('goals = ["SG-1"]', 'goals = ["SG-1", "SG-9"]')) == [
        ("hazard-name", "HZ-1 names SG-9, which is not declared", 'goals = ["SG-1", "SG-9"]')
    ]


def test_a_safe_state_that_is_not_declared(tmp_path: Path) -> None:
    assert found(tmp_path, ('["brake"]', '["brake", "fly"]')) == [
        ("hazard-name", "SG-1 names fly, which is not declared", 'safe_states = ["brake", "fly"]')
    ]


def test_an_id_has_its_form(tmp_path: Path) -> None:
    assert found(tmp_path, ('id = "HZ-1"', 'id = "H1"')) == [
        ("hazard-name", "H1 is no id of a hazard", 'id = "H1"')
    ]


def test_a_hazard_that_nothing_covers(tmp_path: Path) -> None:
    texts = [
        text
        for kind, text, _ in found(
            tmp_path,
            ('goals = ["SG-1"]', "goals = []"),
            ('assumptions = ["AU-1"]', "assumptions = []"),
        )
        if kind == "hazard-covered"
    ]
    assert texts == ["HZ-1 has no safety goal and no assumption of use"]


@pytest.mark.parametrize("wrong", [('"S2"\nexp', '"S4"\nexp'), ('"E3"', '"E9"'), ('"C3"', '"C"')])
def test_a_risk_that_has_no_level(tmp_path: Path, wrong: tuple[str, str]) -> None:
    kinds = {(kind, line) for kind, _, line in found(tmp_path, wrong)}
    assert ("hazard-covered", 'id = "HZ-1"') in kinds


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (('safe_states = ["brake"]', "safe_states = []"), "safe state"),
        (('requirements = ["FR-1"]', "requirements = []"), "requirement"),
        (('goals = ["SG-1"]', "goals = []"), "hazard"),
    ],
)
def test_a_goal_that_is_not_complete(tmp_path: Path, change: tuple[str, str], part: str) -> None:
    assert ("hazard-goal", f"SG-1 has no {part}", 'id = "SG-1"') in found(tmp_path, change)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (("time = 0.35", "time = 0.36"), "SG-1 has 0.36 s, and its formula gives 0.353 s"),
        (("time = 0.35", "time = 0.31"), "SG-1 has 0.31 s, and its formula gives 0.353 s"),
        (("0.3 / 0.85", "way / speed"), "the formula of SG-1 has no value: way / speed"),
        (
            ("reaction = 0.2", "reaction = 0.351"),
            "the firmware needs 0.351 s for SG-1, which allows 0.35 s",
        ),
    ],
)
def test_a_time_that_does_not_fit(tmp_path: Path, change: tuple[str, str], text: str) -> None:
    assert found(tmp_path, change) == [("hazard-time", text, 'id = "SG-1"')]


@pytest.mark.parametrize(
    "change",
    [
        ("time = 0.35", "time = 0.32"),
        ("reaction = 0.2", "reaction = 0.35"),
    ],
)
def test_a_time_at_its_bound_fits(tmp_path: Path, change: tuple[str, str]) -> None:
    assert found(tmp_path, change) == []


@pytest.mark.parametrize(
    ("bound", "exceptions", "texts"),
    [
        (350, "", []),
        (351, "", ["the scenario lost accepts 0.351 s, and SG-1 allows 0.35 s"]),
        (351, 'exceptions = ["At night."]', []),
    ],
)
def test_a_scenario_accepts_the_time_of_its_goal(
    tmp_path: Path, bound: int, exceptions: str, texts: list[str]
) -> None:
    write_case(tmp_path, ('scenarios = ["lost"]', f'scenarios = ["lost"]\n{exceptions}'))
    file = tmp_path / "sim/scenario/safety/lost.scenario"
    line = f"at 50 expect braking 1 within {bound} ms"
    file.write_text(file.read_text() + f"# expect x within 900 ms\n{line}\n")
    findings = check(tmp_path, make_model(tmp_path))
    assert [(one.text, line_of(tmp_path, one)) for one in findings] == [(t, line) for t in texts]


def test_a_requirement_that_its_goal_does_not_list(tmp_path: Path) -> None:
    write_case(tmp_path, ('["FR-1"]', '["FR-2"]'))
    texts = [one.text for one in check(tmp_path, make_model(tmp_path))]
    assert texts == [
        "FR-1 serves SG-1, which does not list it",
        "SG-1 lists FR-2, which does not exist",
    ]


def test_a_requirement_that_does_not_name_its_goal(tmp_path: Path) -> None:
    write_case(tmp_path)
    model = make_model(tmp_path)
    model.requirements["FR-1"] = replace(model.requirements["FR-1"], goals=[])
    (finding,) = check(tmp_path, model)
    assert finding.text == "SG-1 lists FR-1, which does not name it"
    assert line_of(tmp_path, finding) == 'requirements = ["FR-1"]'


def test_a_requirement_that_names_a_goal_that_there_is_not(tmp_path: Path) -> None:
    write_case(tmp_path)
    model = make_model(tmp_path)
    model.requirements["FR-1"].goals.append("SG-7")
    (finding,) = check(tmp_path, model)
    assert (finding.check, finding.text) == (
        "hazard-requirement",
        "FR-1 names SG-7, and there is no such goal",
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("# Lost.\nseed 1\n", "the scenario lost names no goal"),
        ("# Lost.\n# goal SG-8\n", "the scenario lost names SG-8, and there is no such goal"),
    ],
)
def test_a_scenario_that_names_no_goal(tmp_path: Path, text: str, says: str) -> None:
    write_case(tmp_path)
    (tmp_path / "sim/scenario/safety/lost.scenario").write_text(text)
    texts = [one.text for one in check(tmp_path, make_model(tmp_path))]
    assert texts == [says, "SG-1 lists the scenario lost, which does not name it"]


def test_a_scenario_that_its_goal_does_not_list(tmp_path: Path) -> None:
    write_case(tmp_path, ('scenarios = ["lost"]', 'scenarios = ["gone"]'))
    texts = [one.text for one in check(tmp_path, make_model(tmp_path))]
    assert texts == [
        "the scenario lost is about SG-1, which does not list it",
        "SG-1 lists the scenario gone, which is not in sim/scenario/safety",
    ]


def test_a_scenario_that_no_test_plays(tmp_path: Path) -> None:
    write_case(tmp_path)
    (tmp_path / "tests/SafetyTest.cpp").write_text("TEST(Safety, FR1_Stops) {\n}\n")
    texts = [one.text for one in check(tmp_path, make_model(tmp_path))]
    assert texts == ["no test plays the scenario lost"]


@pytest.mark.parametrize(
    ("played", "says"),
    [
        ([], []),  # it has not run: it may play each of them
        (["Files_Safety.FR1_Stops_lost"], []),
        (["Files_Safety.FR1_Stops_found"], ["no test plays the scenario lost"]),
    ],
)
def test_a_test_of_the_whole_folder_plays_what_its_run_says(
    tmp_path: Path, played: list[str], says: list[str]
) -> None:
    write_case(tmp_path)
    text = 'auto k = "sim/scenario/safety";\nTEST_P(Safety, FR1_Stops) {\n  play(GetParam());\n}\n'
    (tmp_path / "tests/SafetyTest.cpp").write_text(text)
    model = make_model(tmp_path)
    model.tests["Safety.FR1_Stops"].results[HOST] = replace(
        model.tests["Safety.FR1_Stops"].results[HOST], recordings=played
    )
    assert [one.text for one in check(tmp_path, model)] == says


@pytest.mark.parametrize(
    ("result", "says"),
    [
        ("failed", ["the scenario lost failed in Safety.FR1_Stops"]),
        ("skipped", ["the scenario lost did not pass in Safety.FR1_Stops"]),
        ("passed", []),
    ],
)
def test_a_scenario_passes_in_this_run(tmp_path: Path, result: str, says: list[str]) -> None:
    write_case(tmp_path)
    findings = check(tmp_path, make_model(tmp_path, result))
    assert [one.text for one in findings] == says


@pytest.mark.parametrize("result", ["passed", "failed", None])
def test_results_of_other_sources_are_not_compared(tmp_path: Path, result: str | None) -> None:
    write_case(tmp_path)
    assert check(tmp_path, make_model(tmp_path, result, fresh=False)) == []


def test_an_assumption_that_covers_no_hazard(tmp_path: Path) -> None:
    assert found(tmp_path, ('assumptions = ["AU-1"]', "assumptions = []")) == [
        ("hazard-assumption", "AU-1 covers no hazard", 'id = "AU-1"')
    ]


@pytest.mark.parametrize(("priority", "count"), [("high", 0), ("medium", 1), ("low", 1)])
def test_a_requirement_is_as_important_as_its_goal(
    tmp_path: Path, priority: str, count: int
) -> None:
    write_case(tmp_path)
    model = make_model(tmp_path)
    model.requirements["FR-1"] = replace(model.requirements["FR-1"], priority=priority)
    assert [one.check for one in check(tmp_path, model)] == ["hazard-priority"] * count
