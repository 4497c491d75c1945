"""The check fsm-declared demands two facts for each requirement of a transition. First, a method of
the old or of the new state serves the requirement. Second, the operation of the event or a method
of the action serves the requirement."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from traceability.checks.state_machine_checks import _asked_for
from traceability.schema import Place, Requirement, StateMachine, Transition

PLACE = Place("design/fsm/lamp.toml", 1)
STEP = Transition("On", "press", "", "Off", "current off", PLACE, ["FR-1"])
MACHINE = StateMachine(
    "lamp",
    "Lamp",
    "lamp-states",
    "Off",
    {"On": "LampOn", "Off": "LampOff"},
    [STEP],
    PLACE,
    events={"press": "toggle"},
    actions={"current off": ["Lamp::switchOff"]},
)
OTHER = "but neither toggle nor the action serves this requirement"


@pytest.mark.parametrize(
    ("methods", "says"),
    [
        (["LampOn::toggle"], ""),
        (["LampOn::tick", "Lamp::switchOff"], ""),
        (["LampOn::tick", "LampOff::light"], OTHER),
        (["Lamp::switchOff"], "but no method of LampOff or LampOn serves this requirement"),
    ],
)
def test_the_operation_or_the_action_serves_the_requirement(methods: list[str], says: str) -> None:
    requirement = Requirement("FR-1", "It shall.", "Lamp", PLACE, satisfied_by=methods)
    model: Any = SimpleNamespace(requirements={"FR-1": requirement})
    facts: Any = SimpleNamespace(classes={})
    problems = [text for text, _, _ in _asked_for(STEP, MACHINE, model, facts)]
    assert len(problems) == bool(says)
    assert all(text.endswith(says) for text in problems)
