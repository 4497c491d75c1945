"""The diagram of a state machine shows the requirements of each transition, and fits the width of a
page."""

from __future__ import annotations

from portal.diagrams import label_lines, machine_diagram
from portal.links import Links
from tests.python.portal.fixture import make_model
from traceability.schema import Place, StateMachine, Transition

PLACE = Place("design/fsm/a.toml", 1)
IN_A_ROW = "left to right direction"


def drawn(guard: str) -> str:
    step = Transition("RC", "noMessage", guard, "PC", "", PLACE, ["FR-16", "FR-17"])
    states = {"RC": "RC", "PC": "PC"}
    machine = StateMachine("a", "Modes", "reading-modes", "RC", states, [step], PLACE)
    return machine_diagram(machine, Links(make_model(), set()), stale=True).text


def test_a_label_ends_with_the_requirements_of_the_transition() -> None:
    step = Transition("RC", "newMessage", "", "RC", "read", PLACE, ["FR-15", "FR-16"])
    assert label_lines(step) == ["newMessage / read", "FR-15, FR-16"]
    assert "noMessage\\nFR-16, FR-17" in drawn("")


def test_states_with_short_labels_stand_in_a_row() -> None:
    assert IN_A_ROW in drawn("failed reads = N - 1")


def test_states_with_a_long_label_stand_one_below_the_other() -> None:
    assert IN_A_ROW not in drawn("position older than 20 ms, or inconsistent")
