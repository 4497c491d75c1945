"""Texts for the reasons and conditions of a report, with the next action of the user."""

from __future__ import annotations

from weeding_robot_client.layout import FRAMES
from weeding_robot_client.messages import WHEELS, Report
from weeding_robot_client.script import NEUTRAL_S

CAUSES = {
    "emergency stop": "the emergency stop is pressed, or its contact is not connected",
    "steering fault": "the steering did not move as ordered, its position is missing, or both "
    "end stops are reached",
    "overcurrent": "the current of a motor was too high",
    "no motion": "a wheel has voltage, and its Hall sensors show no motion",
    "wrong direction": "the direction of a wheel does not match its voltage: motor leads or Hall "
    "wires are swapped",
    "overspeed": "a wheel was faster than allowed",
    "tracking error": "velocity and current of a wheel do not match its voltage",
    "missing measurement": "a measured value is missing",
    "Hall signals": "too many Hall edges of a wheel are implausible: check its cable",
    "reversal": "a wheel could not change its direction in time",
    "clock lost": "the clock of the microcontroller was lost, or did not start",
}
NOT_MOVING = "The robot does not move:"
# The key is the cause of a protective stop.
CHECKS = {
    entry.shown: entry.check.replace("``", "")
    for entry in FRAMES.enumerations["stop cause"].entries
}
ACTIONS = {
    "no order": "Send orders with ./wr drive or with the remote control. If your own program sends "
    "orders, look at the counters that ./wr monitor shows in a terminal.",
    "not armed": f"Send neutral orders for {NEUTRAL_S} s, then drive at once: ./wr drive does "
    "both. With the remote control: set its enable switch to 'drive', and leave the velocity stick "
    f"centred for {NEUTRAL_S} s.",
    "protective stop": "Remove the cause, then acknowledge: ./wr acknowledge, or key a in "
    "./wr drive.",
}
RELEASES = {
    "PC": "The PC ordered it. Release it: ./wr arm, or key r in ./wr drive.",
    "RC": "The remote control ordered it. Set its enable switch to 'PC' or 'drive', with "
    "the velocity stick centred.",
}


def cause(report: Report) -> str:
    """Returns the text for the cause of the protective stop, with the wheel that caused it."""
    if report.stop_wheel is None:
        wheel = ""
    elif report.stop_wheel < len(WHEELS):
        wheel = f" ({WHEELS[report.stop_wheel]} wheel)"
    else:
        wheel = f" (wheel {report.stop_wheel})"
    return CAUSES.get(report.stop_cause, report.stop_cause) + wheel


def inhibited(report: Report) -> str | None:
    """Returns the reason why the robot does not move, and the next action.

    Returns None when the robot follows orders.
    """
    if report.inhibit == "none":
        return None
    if report.inhibit == "stop":
        sources = report.stop_sources or ("a source",)
        actions = [RELEASES.get(name, f"{name} ordered it.") for name in sources]
        reason = " ".join(["a stop is in force.", *actions])
    elif report.inhibit == "protective stop":
        return f"{NOT_MOVING} {protective_stop(report)}"
    else:
        reason = f"{report.inhibit}. {ACTIONS.get(report.inhibit, '')}".rstrip()
    if latched(report):
        reason += f" Also latched: {protective_stop(report)}"
    return f"{NOT_MOVING} {reason}"


def latched(report: Report) -> bool:
    """Returns whether a protective stop is latched. ``inhibit`` may contain another reason."""
    return report.stop_cause != "none"


def protective_stop(report: Report) -> str:
    """Returns the cause of the latched protective stop, its first checks, and the next action."""
    check = CHECKS.get(report.stop_cause)
    first = f" Check first: {check}." if check else ""
    return f"protective stop, {cause(report)}.{first} {ACTIONS['protective stop']}"


def faults(report: Report) -> list[str]:
    """Returns the faults and end stops that the report shows."""
    found = [
        f"{name} wheel {words}"
        for name, wheel in zip(WHEELS, report.wheels, strict=True)
        for words, is_set in (
            ("has an overcurrent trip: its current was too high", wheel.cut_off),
            ("has no motion feedback: it has voltage but no Hall edges", wheel.blind),
        )
        if is_set
    ]
    if report.steering_state == "fault":
        found.append(
            "steering is in fault: it did not move as ordered, its position is missing, or both "
            "end stops are reached"
        )
    for side, reached in (("left", report.left_end), ("right", report.right_end)):
        if reached:
            found.append(f"steering is at its {side} end stop")
    return found


def conditions(report: Report) -> list[str]:
    """Returns the reason why the robot does not move, and then its faults."""
    reason = inhibited(report)
    return [*([reason] if reason else []), *faults(report)]
