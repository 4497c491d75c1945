"""State machines: what the code can change, what recorded calls show, and what is found."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.python.model.lamp_tree import facts_of, write_lamp
from traceability.checks import state_machine_checks
from traceability.model.design_model import Model
from traceability.model.state_machines import MachineCode, Seen, Watcher, read_machine
from traceability.reading.source_facts import Facts
from traceability.schema import HOST, PatternApplication, Place, Requirement


@pytest.fixture(scope="module")
def facts(tmp_path_factory: pytest.TempPathFactory) -> Facts:
    return facts_of(write_lamp(tmp_path_factory.mktemp("lamp")))


@pytest.fixture(scope="module")
def code(facts: Facts) -> MachineCode:
    return read_machine(facts.declared.machines["lamp-states"], facts)


def findings(
    root: Path, *, fresh: bool = False, seen: bool = False, verified: str = "Test.One"
) -> list[tuple[str, str]]:
    facts = facts_of(root)
    model = Model("", "", "hash", {HOST: "hash" if fresh else "old"})
    for name, method in (("FR-1", "LampState::press"), ("FR-2", "Lamp::press")):
        model.requirements[name] = Requirement(
            name, "It shall last 3 s.", "", Place("x", 1), satisfied_by=[method]
        )
    model.requirements["FR-1"] = replace(model.requirements["FR-1"], verified_by=[verified])
    model = replace(
        model,
        machines=facts.declared.machines,
        patterns={
            name: PatternApplication(name, "State", "", "", "", "LampState", Place("x", 1))
            for name in facts.declared.applications
        },
    )
    if seen:
        for step in model.machines["lamp-states"].transitions:
            step.tests.append("Test.One")
    return [(one.check, one.text) for one in state_machine_checks.check(model, facts)]


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


def test_a_machine_as_the_code_is_has_no_finding(tmp_path: Path) -> None:
    assert findings(write_lamp(tmp_path)) == []


@pytest.mark.parametrize(
    ("file", "change", "check", "text"),
    [
        (
            "Lamp_cpp",
            "void Off::press(Lamp& lamp) { lamp.changeState(on_); } -> void Off::press(Lamp&) {}",
            "fsm-code",
            "Off > On on press is declared, but Off::press does not make it",
        ),
        (
            "Lamp_cpp",
            "  if (waited_ > 2) { ->   lamp.changeState(off_);\n  if (waited_ > 2) {",
            "fsm-code",
            "On::wait changes On to Off, which lamp-states does not declare",
        ),
        (
            "Lamp_cpp",
            "void On::wait(Lamp& lamp) {\n -> static void go(Lamp& lamp, LampState& next) "
            "{ lamp.changeState(next); }\nvoid On::wait(Lamp& lamp) {\n  go(lamp, off_);\n",
            "fsm-code",
            "On::wait changes On to Off, which lamp-states does not declare",
        ),
        (
            "Lamp_cpp",
            "void On::wait(Lamp& lamp) {\n -> template <class Any> static void go(Any& lamp, "
            "LampState& to) { lamp.changeState(to); }\nvoid On::wait(Lamp& lamp) {\n"
            "  go(lamp, off_);\n",
            "fsm-code",
            "On::wait changes to a state that the composition does not tell",
        ),
        (
            "start_cpp",
            "off(on), on(off) -> off(on), on(on)",
            "fsm-code",
            "On::press changes On to On, which lamp-states does not declare",
        ),
        (
            "start_cpp",
            "lamp(off, presses) -> lamp(on, presses)",
            "fsm-code",
            "House begins with On, and the machine with Off",
        ),
        (
            "lamp_toml",
            'from = "Off"\non = "press"\nto = "On" -> from = "Off"\non = "press"\nto = "Off"',
            "fsm-code",
            "Off::press always changes the state, so Off > Off on press cannot stay",
        ),
        (
            "lamp_toml",
            'requirements = ["FR-1"] -> requirements = []',
            "fsm-declared",
            "Off > On on press serves no requirement",
        ),
        (
            "lamp_toml",
            'requirements = ["FR-1"] -> requirements = ["FR-2"]',
            "fsm-declared",
            "no method of Off or On serves FR-2, which is said to ask for Off > On on press",
        ),
        (
            "lamp_toml",
            'guard = "3 times" -> guard = "after 4 s"',
            "fsm-declared",
            "the figure '4 s' of On > Off on wait [after 4 s] stands in none of its requirements",
        ),
        (
            "lamp_toml",
            'press = "press" -> press = "push"',
            "fsm-declared",
            "the event 'press' calls LampState::push, which does not exist",
        ),
        (
            "lamp_toml",
            'On = "On"\n -> ',
            "fsm-declared",
            "lamp-states has no state for On, a Concrete State of lamp-states",
        ),
        (
            "lamp_toml",
            'from = "Off"\non = "press"\nto = "On" -> from = "On"\non = "press"\nto = "On"',
            "fsm-declared",
            "another transition of this state has the same event, and no guard tells the two apart",
        ),
    ],
)
def test_a_difference_is_found(
    tmp_path: Path, file: str, change: str, check: str, text: str
) -> None:
    assert (check, text) in findings(write_lamp(tmp_path, **{file: change}))


def test_an_application_without_a_machine_is_found(tmp_path: Path) -> None:
    root = write_lamp(tmp_path)
    (root / "design/fsm/lamp.toml").unlink()
    assert findings(root) == [
        ("fsm-declared", "the states of lamp-states have no state machine"),
    ]


def test_transitions_must_be_seen_when_results_are_fresh(tmp_path: Path) -> None:
    root = write_lamp(tmp_path)
    unseen = findings(root, fresh=True)
    assert len(unseen) == 4
    assert ("fsm-seen", "no passing test makes the transition Off > On on press") in unseen
    assert findings(root, fresh=True, seen=True) == []


def test_a_requirement_of_a_transition_has_a_test_that_makes_it(tmp_path: Path) -> None:
    found = findings(write_lamp(tmp_path), fresh=True, seen=True, verified="Test.Other")
    assert len(found) == 4
    text = "no passing test of FR-1 makes the transition Off > On on press"
    assert ("fsm-seen", text) in found


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
