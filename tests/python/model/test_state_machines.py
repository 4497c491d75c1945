"""The transitions of state machines, as they are found in recorded calls."""

from __future__ import annotations

import pytest

from traceability.model.state_machines import Change, MachineCode, Seen, Watcher
from traceability.schema import Place

PLACE = Place("src/lamp/Lamp.cpp", 1)
# A lamp with a button. When the button is pressed, the lamp is switched on or off. After some time,
# the lamp is switched off automatically. The state Off inherits the operation "wait".
CODE = MachineCode(
    holders={"Lamp": "Lamp::changeState"},
    operations=["press", "wait"],
    runs={
        "Off": {"press": "Off::press", "wait": "LampState::wait"},
        "On": {"press": "On::press", "wait": "On::wait"},
    },
    changes=[
        Change("Off", "press", "On", PLACE, (), False),
        Change("On", "press", "Off", PLACE, ("On::leave",), False),
        Change("On", "wait", "Off", PLACE, ("On::leave",), True),
    ],
    initial={"Off"},
)
ON = "Lamp::tick Off::press Lamp::changeState / / /"
OFF = "Lamp::tick On::wait On::leave Lamp::changeState / / / /"
SWITCHED_ON = Seen("Off", "press", "On")
SWITCHED_OFF = Seen("On", "wait", "Off", ("On::leave",))
STAYS_OFF = Seen("Off", "press", "Off")


def watched(calls: str) -> list[Seen]:
    """Returns the transitions in recorded calls. In the text of the calls, each name begins a call,
    and each ``/`` ends the innermost call."""
    events: list[tuple[str, bool]] = []
    stack: list[str] = []
    for word in calls.split():
        if word == "/":
            events.append((stack.pop(), False))
        else:
            stack.append(word)
            events.append((word, True))
    watcher = Watcher(CODE, {"press", "wait"}, {"LampState", "Off", "On", "Blinking"})
    assert all(watcher.concerns(method) for method, _ in events)
    return watcher.watch(iter(events))


def test_an_operation_stays_unless_it_always_changes_the_state() -> None:
    stays = {(state, one): CODE.stays(state, one) for state in CODE.runs for one in CODE.operations}
    assert stays == {
        ("Off", "press"): False,
        ("Off", "wait"): True,
        ("On", "press"): False,
        ("On", "wait"): True,
    }


@pytest.mark.parametrize(
    ("calls", "seen"),
    [
        (ON, []),  # The recording ends immediately after the change.
        (f"{ON} Lamp::tick On::wait / /", [SWITCHED_ON, Seen("On", "wait", "On")]),
        (f"{OFF} Lamp::tick Off::press / /", [SWITCHED_OFF, STAYS_OFF]),
        # The operations of the states are not called by a lamp.
        ("Off::press Lamp::changeState / / On::wait /", []),
        (f"{ON} Lamp::tick Blinking::wait / /", []),
        # The call of the constructor creates a second lamp. After this, the first lamp is not
        # called. Therefore the last change of the first lamp is not reported.
        (
            f"{ON} Lamp::Lamp / Lamp::tick Off::press / /",
            [STAYS_OFF],
        ),
    ],
)
def test_a_change_is_seen_when_the_next_call_shows_the_state(calls: str, seen: list[Seen]) -> None:
    assert watched(calls) == seen
