"""A small safety case with one hazard, one goal, one requirement, one scenario and one
assumption."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from tests.python.project_files import write_files
from traceability.model.design_model import Model
from traceability.model.report import Report, Verdict
from traceability.model.safety_case import safety_verdicts
from traceability.reading.declared import Declared
from traceability.reading.declared_safety import read_safety_case
from traceability.reading.toml_reader import Entries
from traceability.schema import HOST, BindingResult, Place, Requirement, Test

CASE = """\
base = "0123456"
data_sheets = ["Part X"]

[item]
says = "A robot."
conditions = ["On the flat."]
limits = ["An example."]

[risk]
source = "from memory"
levels = ["QM", "a", "b", "c", "d", "e"]
S2 = ["QM QM QM QM", "QM QM QM a", "QM QM a b", "QM a b c", "QM b c d"]

[risk.words]
S2 = "severe"

[risk.priority]
b = "medium"
c = "high"

[[safe_state]]
id = "brake"
says = "The motors are short-circuited."
safe = "On the flat."
not_safe = "On a slope."

[[assumption]]
id = "AU-1"
title = "Emergency stop"
text = "It removes the power."
by = "machine builder"
confirm = "Press it."

[[goal]]
id = "SG-1"
title = "Stop"
text = "A stop acts."
safe_states = ["brake"]
time = 0.35
formula = "0.3 / 0.85"
because = "0.3 m at 0.85 m/s."
reaction = 0.2
reacts = "Two cycles."

[[hazard]]
id = "HZ-1"
title = "No stop"
situation = "Somebody orders a stop."
harm = "A foot is crushed."
severity = "S2"
exposure = "E3"
avoidance = "C3"
goals = ["SG-1"]
assumptions = ["AU-1"]
scenarios = ["lost"]
answer = "A stop acts in every mode."

[[correction]]
paths = ["src/sensing/"]
why = "A filter was wrong."
"""
SCENARIO = """\
# The radio is lost.
# goal SG-1
seed 1
at 50 expect braking 1 within 300 ms
at 100 end
"""
TEST = '/// @brief It stops.\nTEST(Safety, FR1_Stops) {\n  playScenario("lost");\n}\n'


def write_case(root: Path, *changes: tuple[str, str]) -> None:
    """Writes the files of the safety case. Each change replaces a text in ``CASE``."""
    text = CASE
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    files = {
        "design/safety_case.toml": text,
        "sim/scenario/safety/lost.scenario": SCENARIO,
        "tests/SafetyTest.cpp": TEST,
    }
    write_files(root, files)


def make_model(root: Path, result: str | None = "passed", *, fresh: bool = True) -> Model:
    """Returns a model with the safety case, and with a test that plays the scenario ``lost``."""
    entries = Entries(root)
    declared = Declared(entries=entries, safety=read_safety_case(root, entries))
    run = BindingResult(result, 1.0, stale=not fresh)
    return Model(
        "0123456789", "0.1", "hash", {HOST: "hash" if fresh else "old"},
        requirements={
            "FR-1": Requirement(
                "FR-1", "A stop shall act.", "Stop", Place("requirements/stop.dox", 5),
                rationale="It must.", source="goal: SG-1", priority="high", level="system",
                products=["all"], method="test", goals=["SG-1"], verified_by=["Safety.FR1_Stops"],
            )
        },
        tests={
            "Safety.FR1_Stops": Test(
                "Safety.FR1_Stops", "Safety", "FR1_Stops", "It stops.",
                Place("tests/SafetyTest.cpp", 2), ["FR-1"], {HOST: run},
            )
        },
        safety=declared.safety,
    )  # fmt: skip


def report_of(model: Model, states: Mapping[str, str] | None = None) -> Report:
    """Returns the report of a model. ``states`` contains the states of the requirements. If
    ``states`` does not contain FR-1, this requirement is verified."""
    verdicts = {
        name: Verdict(state) for name, state in {"FR-1": "verified", **(states or {})}.items()
    }
    scenarios, goals = safety_verdicts(model, verdicts)
    return Report(requirements=verdicts, goals=goals, scenarios=scenarios)
