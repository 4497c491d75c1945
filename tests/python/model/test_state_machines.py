"""State machines: what the code can change, and what recorded calls show."""

from __future__ import annotations

import pytest

from tests.python.model.lamp_tree import facts_of, write_lamp
from traceability.model.state_machines import MachineCode, Seen, Watcher, read_machine
from traceability.reading.source_facts import Facts


@pytest.fixture(scope="module")
def facts(tmp_path_factory: pytest.TempPathFactory) -> Facts:
    return facts_of(write_lamp(tmp_path_factory.mktemp("lamp")))


@pytest.fixture(scope="module")
def code(facts: Facts) -> MachineCode:
    return read_machine(facts.declared.machines["lamp-states"], facts)


def test_changes_are_followed_to_the_object_that_the_composition_gave(code: MachineCode) -> None:
    changes = {(c.source, c.operation, c.target): (c.path, c.sometimes) for c in code.changes}
    assert changes == {
        ("Off", "press", "On"): ((), False),
        ("On", "press", "Off"): (("On::leave",), False),
        ("On", "wait", "Off"): (("On::leave",), True),
    }
    assert code.initial == {"Off"}
    assert code.holders == {"Lamp": "Lamp::changeState"}


def test_an_operation_that_a_state_inherits_stays(code: MachineCode) -> None:
    assert code.runs["Off"]["wait"] == "LampState::wait"
    assert code.stays("Off", "wait")
    assert code.stays("On", "wait")
    assert not code.stays("On", "press")


# ---- what recorded calls show ------------------------------------------------


def watched(code: MachineCode, calls: str) -> list[Seen]:
    """Each word is a call that is entered; ``/`` leaves the last one."""
    events: list[tuple[str, bool]] = []
    stack: list[str] = []
    for word in calls.split():
        if word == "/":
            events.append((stack.pop(), False))
        else:
            stack.append(word)
            events.append((word, True))
    watcher = Watcher(code, {"press", "wait"}, {"LampState", "Off", "On", "Blinking"})
    assert all(watcher.concerns(method) for method, _ in events)
    return watcher.watch(iter(events))


ON = "Lamp::tick Off::press Lamp::changeState / / /"


def test_a_change_is_seen_when_the_next_call_tells_the_state(code: MachineCode) -> None:
    assert watched(code, ON) == []
    then = watched(code, f"{ON} Lamp::tick On::wait / /")
    assert then == [Seen("Off", "press", "On"), Seen("On", "wait", "On")]


def test_the_way_to_a_change_is_kept(code: MachineCode) -> None:
    off = "Lamp::tick On::wait On::leave Lamp::changeState / / / / Lamp::tick Off::press / /"
    assert watched(code, off)[0] == Seen("On", "wait", "Off", ("On::leave",))


def test_a_state_that_is_called_by_itself_shows_nothing(code: MachineCode) -> None:
    assert watched(code, "Off::press Lamp::changeState / / On::wait /") == []


def test_another_state_or_another_lamp_ends_what_is_known(code: MachineCode) -> None:
    assert watched(code, f"{ON} Lamp::tick Blinking::wait / /") == []
    other = watched(code, f"{ON} Lamp::Lamp / Lamp::tick Off::press / /")
    assert Seen("Off", "press", "On") not in other
