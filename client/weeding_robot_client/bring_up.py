"""Guides a person from the bare board to the first turning wheel, and records the results."""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from datetime import datetime
from functools import partial
from pathlib import Path

from serial.tools import list_ports

from weeding_robot_client.exit_codes import DONE, FAILED, MISSING, USAGE
from weeding_robot_client.link import Link
from weeding_robot_client.messages import WHEELS, Quantity, Report
from weeding_robot_client.monitor import firmware
from weeding_robot_client.operators import (
    Control,
    Operator,
    OperatorError,
    Person,
    SimulatedOperator,
)
from weeding_robot_client.options import DEFAULT_LINK, open_link
from weeding_robot_client.orders import Orders, acknowledge, arm, connect, not_connected
from weeding_robot_client.reasons import cause, inhibited, latched
from weeding_robot_client.script import Wish

ROOT = Path(__file__).resolve().parents[2]
DEFAULT_FOLDER = ROOT / "build" / "bring-up"
DEFAULT_CONTROL = ROOT / "build" / "sim-control"
IMAGES = ROOT / "build" / "k64"
DESCRIPTION = f"""\
Guides you step by step through the checks of a new robot: port, connection, firmware image, reset
cause, inputs, end stops, remote control, emergency stop. Then the program turns the steering a few
degrees to the left and to the right, and turns one wheel at a time with 1 V. It detects a reversed
steering, swapped motor leads and swapped Hall wires. It tests the stop while a wheel turns. Each
step shows the action and the expected result. If a step waits for you, press 's' and Enter to skip
this step. The robot must run a product with the safety functions. Connect no motor before you
start. No motor turns until the step for the emergency stop has passed and you have confirmed that
the wheels are off the ground. Ctrl-C stops the robot. The program writes the result to a record
with the present date, in JSON and in Markdown.

Exit code {FAILED}: a step failed or was skipped."""

PROBE_VENDOR = 0x0D28  # USB vendor of the debug probe, which provides the board's serial port
SUPPLY_VOLTS = (21.0, 29.0)
REST_AMPERES = 0.5
ANGLE_DEGREES = 33.0
ANGLE_SPREAD_DEGREES = 1.0
STICK_RPM = 3.0
STICK_DEGREES = 2.0
OBSERVE_S = 2.0
FAIL_SAFE_S = 0.3  # longest time until the stop, after the transmitter is switched off
CYCLE_S = 0.1  # longest time from a stop to its report
STEERING_DEGREES = 5.0  # angle of the turn to each side
MOST_DEGREES = 32.0  # greatest angle that the robot accepts in an order
STEERING_ERROR_DEGREES = 0.5  # greatest difference between the ordered and the reached angle
STEERING_S = 5.0  # longest time of a turn; a turn over the whole range lasts 3.3 s
AGAINST_DEGREES = 0.3  # a smaller change of the angle can be noise
WHEEL_VOLTS = 1.0
WHEEL_S = 1.0
COUNTS_LEAST = 3  # smallest number of Hall edges that shows a motion
CURRENT_LEAST_AMPERES = 0.15  # below this current, noise determines the sign
STOP_WITHIN_S = 1.0
REST_RPM = 3.0
GOOD_RESETS = ("power on", "reset pin", "debugger", "software", "unknown cause")


_UNSEEN = (
    "the Hall sensors count, but you did not see this wheel turn",
    "Check that motor and Hall cable belong to the same wheel.",
)
# The value is the finding and the next action, or None if nothing is wrong. The first part of the
# key is true if the Hall count rises. The second part is true if the wheel turned forwards, and
# None if it did not turn.
POLARITY: dict[tuple[bool, bool | None], tuple[str, str] | None] = {
    (True, True): None,
    (True, False): (
        "the motor leads and the Hall wires are swapped",
        "Swap the two motor leads and the two Hall wires of this wheel.",
    ),
    (False, True): ("the Hall wires are swapped", "Swap the two Hall wires of this wheel."),
    (False, False): ("the motor leads are swapped", "Swap the two motor leads of this wheel."),
    (True, None): _UNSEEN,
    (False, None): _UNSEEN,
}


STEERING_ADVICE = (
    "Press the emergency stop, and turn the front wheels to the left by hand. If the reported "
    "angle rises, exchange the two leads of one winding of the steering motor. If the angle falls, "
    "correct the angle sensor. Then start the bring-up again."
)


class SkipError(RuntimeError):
    """The operator skips a step."""


class FailError(RuntimeError):
    """A failed step, with the observation and the next action."""

    def __init__(self, seen: str, advice: str = "") -> None:
        super().__init__(seen)
        self.seen = seen
        self.advice = advice


@dataclass
class Outcome:
    """Record of one step."""

    step: str
    expected: str
    verdict: str = "not done"
    seen: str = ""
    advice: str = ""
    at: str = ""


@dataclass
class Record:
    """Record of a bring-up."""

    started: str
    link: str
    firmware: str = "unknown"
    simulated: bool = False
    steps: list[Outcome] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        return bool(self.steps) and all(step.verdict == "pass" for step in self.steps)

    def write(self, folder: Path) -> Path:
        """Writes the record as JSON and as Markdown. Returns the path of the Markdown file."""
        folder.mkdir(parents=True, exist_ok=True)
        stem = folder / self.started.replace(":", "-")
        content = {**asdict(self), "passed": self.passed}
        stem.with_suffix(".json").write_text(json.dumps(content, indent=1) + "\n", "utf-8")
        page = stem.with_suffix(".md")
        page.write_text(self._markdown(), "utf-8")
        return page

    def _markdown(self) -> str:
        lines = [
            f"# Bring-up of {self.started}",
            "",
            f"* Port: {self.link}" + (" (simulated robot)" if self.simulated else ""),
            f"* Robot: {self.firmware}",
            f"* Result: {'all steps passed' if self.passed else 'at least one step did NOT pass'}",
            "",
            "| step | expected | seen | result | next action |",
            "|---|---|---|---|---|",
        ]
        for step in self.steps:
            cells = (step.step, step.expected, step.seen, step.verdict, step.advice)
            lines.append("| " + " | ".join(cell.replace("|", "/") for cell in cells) + " |")
        return "\n".join(lines) + "\n"


@dataclass(frozen=True)
class Step:
    """A step. Its check returns the observation, or raises FailError or SkipError."""

    name: str
    expected: str
    check: Callable[[], str]
    needs: tuple[str, ...] = ("connection",)


class BringUp:
    """The steps of a bring-up on an open link."""

    def __init__(
        self, link: Link, operator: Operator, images: Path = IMAGES, has_rc: bool = True
    ) -> None:
        self.orders = Orders(link)
        self.link = link
        self._operator = operator
        self._images = images
        self._has_rc = has_rc
        self._wish: Wish | None = None  # without orders the robot does not arm
        self.rest = Wish()  # neutral order, later with the present steering angle

    def steps(self) -> list[Step]:
        """Returns the steps in the order in which they are executed."""
        lifted = ("connection", "emergency stop", "wheels off the ground")
        safe = (*lifted, "steering")
        wheels = [
            Step(
                f"wheel {number}, {name}",
                f"{WHEEL_VOLTS:g} V on only this wheel turns it forwards, and its Hall count rises",
                partial(self._wheel, number),
                safe,
            )
            for number, name in enumerate(WHEELS)
        ]
        rc = [
            Step(
                "remote control: enable switch at 'stop'",
                "the remote control orders a stop",
                self._enable_stop,
            ),
            Step(
                "remote control: enable switch at 'PC'",
                "the remote control orders no stop, and the robot reads the PC's orders",
                self._enable_pc,
            ),
            Step(
                "remote control: enable switch at 'drive', sticks centred",
                "the robot reads the remote control's orders: velocity 0 and steering 0",
                self._enable_drive,
            ),
            Step(
                "remote control: transmitter off",
                f"the stop is reported at most {self._fail_safe_limit():.1f} s after Enter",
                self._transmitter_off,
            ),
        ]
        first_wheel = wheels[0].name
        return [
            Step("connection", "the robot answers, and the versions match", self._connection, ()),
            Step(
                "image",
                "build/k64 contains a firmware image with the build id that the robot reports",
                self._image,
            ),
            Step(
                "reset cause",
                "the last reset was intended, and no fault was recorded",
                self._reset_cause,
            ),
            Step(
                "supply",
                f"{SUPPLY_VOLTS[0]:g} to {SUPPLY_VOLTS[1]:g} V at the motor supply",
                self._supply,
                (),
            ),
            Step(
                "analog inputs",
                f"each current within {REST_AMPERES} A of 0, steering angle steady and within "
                f"{ANGLE_DEGREES:g} degrees of 0",
                self._analog_inputs,
            ),
            *(
                Step(
                    f"{side} end stop",
                    "each end stop is reached only while it is pressed",
                    partial(self._end_stop, side),
                )
                for side in ("left", "right")
            ),
            *(rc if self._has_rc else []),
            Step(
                "emergency stop",
                "pressed: protective stop; released: still stopped; acknowledged: armed",
                self._emergency_stop,
            ),
            Step(
                "wheels off the ground",
                "the wheels can turn freely, and nobody can touch them",
                self._wheels_off_ground,
                ("connection", "emergency stop"),
            ),
            Step(
                "steering",
                f"the steering turns {STEERING_DEGREES:g} degrees to the left, "
                f"{STEERING_DEGREES:g} degrees to the right, and to the middle",
                self._steering,
                lifted,
            ),
            *wheels,
            Step(
                "stop ordered by the PC while a wheel turns",
                f"the wheel is at rest within {STOP_WITHIN_S:g} s",
                self._stop_while_turning,
                (*safe, first_wheel),
            ),
            Step(
                "emergency stop while a wheel turns",
                f"the wheel is at rest within {STOP_WITHIN_S:g} s",
                self._emergency_stop_while_turning,
                (*safe, first_wheel),
            ),
        ]

    # ---- parts of the steps --------------------------------------------------

    def idle(self) -> None:
        self.orders.service(self._wish)

    def _do(self, action: str, instruction: str) -> float:
        """Asks the operator for an action. Returns the time at which the action began."""
        self._operator.perform(action, instruction, self.idle)
        begin = time.monotonic()
        if self._operator.skips():
            raise SkipError
        return begin

    def _wait(
        self, condition: Callable[[Report], bool], missing: str, advice: str = ""
    ) -> tuple[Report, float]:
        """Waits for a report that meets the condition. Returns the report and the time of its
        arrival.

        Raises FailError when no such report arrives.
        """
        end = time.monotonic() + self._operator.patience_s
        while time.monotonic() < end:
            for report in self.orders.service(self._wish):
                if condition(report):
                    return report, time.monotonic()
            if not self.link.connected:
                raise FailError("the connection was lost", "Check cable and power.")
            if self._operator.skips():
                raise SkipError
        last = self.orders.report
        words = inhibited(last) if last else None
        raise FailError(missing + (f" (last report: {words})" if words else ""), advice)

    def _observe(self, wish: Wish | None, seconds: float) -> list[Report]:
        reports = []
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            reports += self.orders.service(wish)
        if not reports:
            raise FailError("no report was received", "Check cable and power.")
        return reports

    def _arm(self) -> None:
        reason = arm(self.orders, self.rest)
        if reason:
            raise FailError(f"not armed: {reason}")

    def _release_earlier_stop(self) -> None:
        """Acknowledges a protective stop without arming the robot. Such a stop occurs if the remote
        control arms the robot before the steering has a motor: the steering is then in fault."""
        if self.orders.report and latched(self.orders.report):
            self._keep_steering()
            self._observe(self.rest, OBSERVE_S)
            acknowledge(self.orders, self.rest)
            self._wish = None

    def _release(self) -> None:
        """Acknowledges a protective stop, and arms the robot. Orders the reported steering angle,
        because the steering may have no motor yet, or a motor that turns the wrong way."""
        self._keep_steering()
        acknowledge(self.orders, self.rest)
        self._arm()

    def _keep_steering(self) -> None:
        self.rest = Wish(steering_degrees=self._angle(MOST_DEGREES))
        self._wish = self.rest

    def _angle(self, most: float) -> float:
        """Returns the reported steering angle, limited to ``most`` on both sides."""
        report = self.orders.report
        angle = report.steering_degrees if report else None
        if angle is None:
            raise FailError("the steering angle is missing", "Check the cable of the angle sensor.")
        return min(max(angle, -most), most)

    # ---- the steps -----------------------------------------------------------

    def _connection(self) -> str:
        if connect(self.orders) is None:
            raise FailError(not_connected(self.link), "Check port, cable, power and firmware.")
        note = self.link.welcome.schema_note if self.link.welcome else None
        return firmware(self.link) + (f"; {note}" if note else "")

    def _image(self) -> str:
        assert self.link.welcome is not None
        build_id = self.link.welcome.build_id
        images = sorted(self._images.glob("weeding_robot*.bin"))
        if not images:
            raise FailError(
                f"{self._images} contains no image to compare with", "Build it: ./wr firmware"
            )
        same = [path.stem for path in images if build_id.encode() in path.read_bytes()]
        if not same:
            raise FailError(
                f"build {build_id} is in no image of {self._images}",
                "Build and flash: ./wr flash",
            )
        return f"build {build_id}, as in {', '.join(same)}"

    def _reset_cause(self) -> str:
        assert self.link.welcome is not None
        start = self.link.welcome.start
        if start.faulted or str(start) not in GOOD_RESETS:
            raise FailError(
                str(start),
                "Find the cause of this reset first. The section 'Causes of a reset, and kinds of "
                "faults' of the page 'PC protocol' lists the first checks for each cause.",
            )
        return str(start)

    def _supply(self) -> str:
        low, high = SUPPLY_VOLTS
        volts = self._operator.number("Measure the motor supply with a voltmeter. Volts", self.idle)
        if volts is None:
            raise SkipError
        if not low <= volts <= high:
            raise FailError(f"{volts:g} V", "Connect a supply of 24 V with a current limit.")
        return f"{volts:g} V"

    def _analog_inputs(self) -> str:
        reports = self._observe(self._wish, OBSERVE_S)
        for wheel, name in enumerate(WHEELS):
            currents = [report.wheels[wheel].current_amperes for report in reports]
            worst = max(currents, key=lambda value: 99.0 if value is None else abs(value))
            if worst is None or abs(worst) > REST_AMPERES:
                seen = "is missing" if worst is None else f"is {worst:.2f} A at rest"
                raise FailError(
                    f"the current of the {name} wheel {seen}",
                    "Check the cable of this current sensor and its supply.",
                )
        angles = [report.steering_degrees for report in reports]
        known = [angle for angle in angles if angle is not None]
        if len(known) < len(angles):
            raise FailError("the steering angle is missing", "Check the cable of the angle sensor.")
        if max(map(abs, known)) > ANGLE_DEGREES or max(known) - min(known) > ANGLE_SPREAD_DEGREES:
            raise FailError(
                f"the steering angle is {min(known):.1f} to {max(known):.1f} degrees",
                "Check the cable and the mounting of the angle sensor.",
            )
        return f"all currents near 0, steering angle {known[-1]:.1f} degrees"

    def _end_stop(self, side: str) -> str:
        def reached(report: Report) -> bool:
            return report.left_end if side == "left" else report.right_end

        if any(map(reached, self._observe(self._wish, OBSERVE_S / 4))):
            raise FailError(
                f"the {side} end stop is reached although nobody presses it",
                "Turn the steering to the middle. If the robot still reports the end stop, check "
                "the wire: the contact is closed at rest, and a broken wire has the same effect as "
                "a reached end stop.",
            )
        self._do(f"{side} end press", f"press the {side} end stop by hand and keep it pressed")
        self._wait(
            reached,
            f"the robot does not report the {side} end stop",
            "Check the wire and the pin of the end stop.",
        )
        self._do(f"{side} end release", f"release the {side} end stop")
        self._wait(
            lambda report: not reached(report),
            f"the robot still reports the {side} end stop",
            "Check the contact.",
        )
        return "seen pressed and released"

    def _enable_stop(self) -> str:
        self._do("enable stop", "switch the transmitter on, and set the enable switch to 'stop'")
        self._wait(
            lambda report: "RC" in report.stop_sources,
            "the remote control orders no stop",
            "Check the receiver's third channel (rc_enable) and the end points of this channel.",
        )
        return "the remote control orders a stop"

    def _enable_pc(self) -> str:
        self._wish = self.rest
        try:
            self._do("enable pc", "centre the sticks, and set the enable switch to 'PC'")
            self._wait(
                lambda report: (
                    "RC" not in report.stop_sources and report.order_read and report.source == "PC"
                ),
                "the PC's orders are not read",
                "Centre the velocity stick, and check the middle position of the enable switch.",
            )
        finally:
            self._wish = None
        return "the PC's orders are read"

    def _enable_drive(self) -> str:
        self._do("enable drive", "centre the sticks, and set the enable switch to 'drive'")
        self._wait(
            lambda report: report.order_read and report.source == "RC",
            "the remote control's orders are not read",
            "Check the first two channels of the receiver.",
        )
        reports = [report for report in self._observe(None, 1.0) if report.source == "RC"]
        velocity = max(abs(wheel.set_point.value) for r in reports for wheel in r.wheels)
        angle = max(abs(report.steering_set_point_degrees) for report in reports)
        if velocity > STICK_RPM or angle > STICK_DEGREES:
            raise FailError(
                f"with centred sticks, the remote control orders {velocity:g} rpm "
                f"and {angle:g} degrees; it must order about 0",
                "Set the trims of the transmitter to 0.",
            )
        return (
            f"with centred sticks, the remote control orders {velocity:g} rpm and {angle:g} degrees"
        )

    def _fail_safe_limit(self) -> float:
        """Returns the longest accepted time from Enter to the report of the stop. This time
        includes the reaction time of the operator, and is longer than FAIL_SAFE_S. Therefore the
        step cannot confirm that the stop begins within FAIL_SAFE_S."""
        return FAIL_SAFE_S + CYCLE_S + self._operator.reaction_s

    def _transmitter_off(self) -> str:
        if self.orders.report and "RC" in self.orders.report.stop_sources:
            raise FailError(
                "the remote control already orders a stop", "Set the enable switch to 'PC'."
            )
        begin = self._do(
            "transmitter off", "press Enter, and switch the transmitter off at the same time"
        )
        try:
            _, seen = self._wait(
                lambda report: "RC" in report.stop_sources,
                "the remote control orders no stop: the receiver still sends the last pulses",
                "Set the fail-safe of the receiver: no pulses, or the enable channel at 'stop'.",
            )
        finally:
            self._do(
                "transmitter on",
                "switch the transmitter on, centre the sticks, and set the enable switch to 'PC'",
            )
        limit = self._fail_safe_limit()
        took = seen - begin
        self._wait(
            lambda report: "RC" not in report.stop_sources, "the remote control still orders a stop"
        )
        if took > limit:
            raise FailError(
                f"the stop was reported after {took:.2f} s, later than {limit:.1f} s",
                "Set the fail-safe of the receiver to act without delay.",
            )
        return f"the stop was reported after {took:.2f} s (at most {limit:.1f} s)"

    def _emergency_stop(self) -> str:
        def stopped(report: Report) -> bool:
            return report.stop_cause == "emergency stop"

        self._release_earlier_stop()
        self._do("estop press", "press the emergency stop")
        self._wait(
            stopped,
            "the robot does not report the emergency stop",
            "Check the auxiliary contact of the emergency stop. Connect no motor before this step "
            "passes. If the product has no safety functions, flash a product that has them: "
            "./wr flash --product weeding_robot",
        )
        self._keep_steering()
        self._do("estop release", "release the emergency stop")
        still = self._observe(self._wish, OBSERVE_S)
        if not stopped(still[-1]):
            raise FailError("the protective stop ended without an acknowledgement")
        self._release()
        return "pressed: stopped; released: still stopped; acknowledged: armed"

    def _wheels_off_ground(self) -> str:
        self._do(
            "lift",
            "press the emergency stop, connect the motors of the wheels and of the steering, and "
            "lift the robot so that all wheels are off the ground",
        )
        for question in (
            "Are all four wheels off the ground, and is the robot secured?",
            "Are all persons away from the wheels, and is your hand at the emergency stop?",
            "Is the current of the supply limited to 2 A?",
        ):
            if not self._operator.confirm(question, self.idle):
                raise FailError(f"not confirmed: {question}", "Do this first.")
        self._do("estop release", "release the emergency stop")
        self._observe(self._wish, OBSERVE_S)
        self._release()
        return "confirmed; acknowledged: armed"

    def _steering(self) -> str:
        self._do(
            "watch steering",
            f"watch the front wheels: they turn {STEERING_DEGREES:g} degrees to the left, then to "
            "the right, then to the middle",
        )
        self._keep_steering()
        self._arm()
        middle = self._angle(MOST_DEGREES - STEERING_DEGREES)
        try:
            for degrees in (middle + STEERING_DEGREES, middle - STEERING_DEGREES, 0.0):
                self._turn_steering(degrees)
        except FailError:
            acknowledge(self.orders, self.rest)
            raise
        question = "Did the front wheels turn to the left, then to the right, then to the middle?"
        if not self._operator.confirm(question, self.idle):
            raise FailError(
                "the reported angle follows the orders, but the front wheels do not",
                STEERING_ADVICE,
            )
        return f"turned {STEERING_DEGREES:g} degrees to each side, then to the middle"

    def _turn_steering(self, degrees: float) -> None:
        """Orders a steering angle, and waits until the robot reports this angle."""
        before = angle = self._angle(ANGLE_DEGREES)
        self.rest = self._wish = Wish(steering_degrees=degrees)
        end = time.monotonic() + STEERING_S
        while time.monotonic() < end:
            for report in self.orders.service(self._wish):
                if report.steering_degrees is not None:
                    angle = report.steering_degrees
                if report.inhibit == "protective stop":
                    raise self._steering_fault(report, degrees - before, angle - before)
                if abs(angle - degrees) <= STEERING_ERROR_DEGREES:
                    return
            if not self.link.connected:
                raise FailError("the connection was lost", "Check cable and power.")
        raise FailError(
            f"the steering is at {angle:.1f} degrees instead of {degrees:.1f} degrees",
            "Check that no end stop is reached, and that the steering turns freely.",
        )

    @staticmethod
    def _steering_fault(report: Report, ordered: float, moved: float) -> FailError:
        if report.stop_cause != "steering fault":
            return FailError(f"protective stop: {cause(report)}", "Remove the cause.")
        side = "left" if ordered > 0 else "right"
        text = f"steering fault: ordered to the {side}, angle changed by {moved:+.1f} degrees"
        if (moved if ordered < 0 else -moved) > AGAINST_DEGREES:
            return FailError(f"{text}: the steering turns in the wrong direction", STEERING_ADVICE)
        return FailError(
            f"{text}: the steering does not follow",
            "Check the supply and the cables of the steering motor and of its driver. Check that "
            "the steering turns freely.",
        )

    def _wheel(self, number: int) -> str:
        name = WHEELS[number]
        self._do(f"watch {number}", f"watch the {name} wheel: it turns for {WHEEL_S:g} s")
        self._arm()
        before = self._observe(self.rest, 0.3)[-1]
        wish = Wish.of(Quantity.TENSION, WHEEL_VOLTS, wheels=(number,))
        reports = self._observe(wish, WHEEL_S)
        if isinstance(self._operator, SimulatedOperator):
            self._operator.watch(number)
        reports += self._observe(self.rest, 0.3)
        saw = self._operator.sees_forward(number, name, self.idle)
        motion = Motion.of(number, before, reports, saw)
        fault = motion.fault()
        if fault:
            if reports[-1].inhibit == "protective stop":
                acknowledge(self.orders)
            raise FailError(f"{motion}: {fault[0]}", fault[1])
        return f"{motion}: right"

    def _turn_first_wheel(self) -> None:
        self._arm()
        wish = Wish.of(Quantity.TENSION, WHEEL_VOLTS, wheels=(0,))
        reports = self._observe(wish, WHEEL_S)
        velocity = reports[-1].wheels[0].velocity_rpm
        self._wish = wish
        if velocity is None or velocity < REST_RPM:
            self._wish = self.rest
            raise FailError("the wheel does not turn")

    def _at_rest(self, begin: float, what: str) -> str:
        _, seen = self._wait(
            lambda report: abs(report.wheels[0].velocity_rpm or 0.0) < REST_RPM,
            f"the wheel still turns after {what}",
            "Switch the supply off.",
        )
        took = seen - begin
        if took > STOP_WITHIN_S + self._operator.reaction_s:
            raise FailError(f"at rest {took:.2f} s after {what}, which is too late")
        return f"at rest {took:.2f} s after {what}"

    def _stop_while_turning(self) -> str:
        self._turn_first_wheel()
        begin = time.monotonic()
        self._wish = Wish(stop=True)
        try:
            self._wait(lambda report: report.stop, "the robot reports no stop")
            seen = self._at_rest(begin, "the stop")
        finally:
            self._wish = self.rest
        self._arm()
        return seen

    def _emergency_stop_while_turning(self) -> str:
        self._turn_first_wheel()
        try:
            begin = self._do("estop press", "press the emergency stop while the wheel turns")
            self._wait(
                lambda report: report.stop_cause == "emergency stop",
                "the robot reports no protective stop",
            )
            seen = self._at_rest(begin, "the emergency stop")
        finally:
            self._wish = self.rest
        self._do("estop release", "release the emergency stop")
        self._observe(self._wish, 0.5)
        acknowledge(self.orders)
        self._arm()
        return seen


@dataclass(frozen=True)
class Motion:
    """The reaction of one wheel to a low forward voltage."""

    wheel: int
    counts: int
    amperes: float | None  # greatest current
    others: tuple[str, ...]  # other wheels that moved
    saw_forward: bool | None
    stop: str | None  # cause of a protective stop

    @classmethod
    def of(cls, wheel: int, before: Report, reports: list[Report], saw: bool | None) -> Motion:
        def moved(number: int) -> int:
            start, end = (r.wheels[number].position_counts for r in (before, reports[-1]))
            return 0 if start is None or end is None else end - start

        currents = [r.wheels[wheel].current_amperes for r in reports]
        known = [value for value in currents if value is not None]
        stopped = [cause(r) for r in reports if r.inhibit == "protective stop"]
        others = [
            name
            for number, name in enumerate(WHEELS)
            if number != wheel and abs(moved(number)) >= COUNTS_LEAST
        ]
        return cls(
            wheel,
            moved(wheel),
            max(known, key=abs) if known else None,
            tuple(others),
            saw,
            stopped[0] if stopped else None,
        )

    def __str__(self) -> str:
        amperes = "-" if self.amperes is None else f"{self.amperes:.2f}"
        eyes = {True: "forwards", False: "backwards", None: "not at all"}[self.saw_forward]
        text = f"Hall count {self.counts:+d}, greatest current {amperes} A, turned {eyes}"
        return text + (f", protective stop: {self.stop}" if self.stop else "")

    def fault(self) -> tuple[str, str] | None:
        """Returns the finding and the next action, or None when all values are right."""
        if abs(self.counts) < COUNTS_LEAST:
            return self._without_counts()
        polarity = POLARITY[self.counts > 0, self.saw_forward]
        if polarity:
            return polarity
        if self.amperes is not None and self.amperes < -CURRENT_LEAST_AMPERES:
            return (
                "the current has the wrong sign",
                "Turn the current sensor of this wheel around, or swap its outputs.",
            )
        if self.others:
            return (
                f"other wheels also moved: {', '.join(self.others)}",
                "Check that all wires of this driver belong to this wheel.",
            )
        return None

    def _without_counts(self) -> tuple[str, str]:
        if self.others:
            return (
                f"the wrong wheel moved: {', '.join(self.others)}",
                "The cables of these wheels are swapped: connect them as in the wiring table.",
            )
        if self.saw_forward is None:
            return (
                "no motion",
                "Check the driver supply and the motor leads. Check that the wheel turns freely.",
            )
        return (
            "the wheel turned, but its Hall sensors had no edges",
            "Check the Hall cable of this wheel and its supply.",
        )


def perform(bring_up: BringUp, record: Record) -> None:
    """Executes the steps. Then sends a neutral order. After an exception, sends stop orders
    instead."""
    steps = bring_up.steps()
    outcomes = [Outcome(step.name, step.expected) for step in steps]
    record.steps = outcomes
    verdicts: dict[str, str] = {}
    try:
        for number, (step, outcome) in enumerate(zip(steps, outcomes, strict=True), start=1):
            print(f"\n{number}/{len(steps)} {step.name}\n   expected: {step.expected}")
            outcome.at = now()
            missing = [name for name in step.needs if verdicts.get(name) != "pass"]
            if missing:
                outcome.verdict, outcome.seen = "skip", f"needs: {', '.join(missing)}"
            else:
                _attempt(step, outcome)
            verdicts[step.name] = outcome.verdict
            print(f"   {outcome.verdict.upper()}: {outcome.seen}")
            if outcome.advice:
                print(f"   next: {outcome.advice}")
        bring_up.orders.end(bring_up.rest)
    except BaseException:
        bring_up.orders.stop()
        raise
    finally:
        record.firmware = firmware(bring_up.link)


def _attempt(step: Step, outcome: Outcome) -> None:
    try:
        outcome.seen = step.check()
        outcome.verdict = "pass"
    except FailError as error:
        outcome.verdict, outcome.seen, outcome.advice = "fail", error.seen, error.advice
    except SkipError:
        outcome.verdict, outcome.seen = "skip", "skipped by the operator"


def now() -> str:
    return datetime.now().astimezone().isoformat(timespec="seconds")


def find_port() -> list[Path]:
    """Returns the serial ports of all boards with a debug probe of PROBE_VENDOR. A port is
    returned with its permanent name."""
    ports = [Path(port.device) for port in list_ports.comports() if port.vid == PROBE_VENDOR]
    names = {path.resolve(): path for path in sorted(Path("/dev/serial/by-id").glob("*"))}
    return [names.get(port.resolve(), port) for port in ports]


def choose_link(link: Path | None) -> Path | None:
    """Returns the port to use.

    Prints a message and returns None when there is no port or more than one port.
    """
    if link is not None:
        return link
    ports = find_port()
    if len(ports) == 1:
        return ports[0]
    if ports:
        print("more than one board is connected; choose one:", file=sys.stderr)
        for port in ports:
            print(f"  ./wr bring-up --link {port}", file=sys.stderr)
        return None
    print("no board found: connect the USB socket that is marked SDA, or name the port with --link",
          file=sys.stderr)  # fmt: skip
    return None


def folder(text: str) -> Path:
    """Creates the folder for the record before the first step. Returns the path of the folder."""
    path = Path(text)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise argparse.ArgumentTypeError(f"cannot create {path}: {error.strerror}") from error
    return path


def add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--link", type=Path, metavar="PATH", help="serial port (default: the port of the board)"
    )
    parser.add_argument(
        "--record",
        type=folder,
        default=DEFAULT_FOLDER,
        metavar="FOLDER",
        help="folder of the records (default: build/bring-up)",
    )
    parser.add_argument(
        "--no-rc",
        action="store_true",
        help="skip the steps of the remote control, for a product without a remote control",
    )
    parser.add_argument(
        "--simulated",
        action="store_true",
        help="act on the robot of ./wr sim, which must run in another terminal",
    )
    parser.add_argument(
        "--control",
        type=Path,
        default=DEFAULT_CONTROL,
        metavar="PATH",
        help="with --simulated: control socket of ./wr sim (default: build/sim-control)",
    )


def run(options: argparse.Namespace) -> int:
    operator: Operator
    if options.simulated:
        link_path = options.link or DEFAULT_LINK
        if link_path.exists() and Path("/dev/pts") not in link_path.resolve().parents:
            print(
                f"{link_path} is not the link of a simulator: start ./wr sim, or leave out "
                "--simulated",
                file=sys.stderr,
            )
            return USAGE
        try:
            operator = SimulatedOperator(Control(options.control))
        except OperatorError as error:
            print(error, file=sys.stderr)
            return MISSING
    elif not os.isatty(sys.stdin.fileno()):
        print("bring-up asks a person: run it in a terminal, or use --simulated", file=sys.stderr)
        return USAGE
    else:
        link_path = choose_link(options.link)
        operator = Person()
        if link_path is None:
            return MISSING
    link = open_link(link_path)
    if isinstance(link, int):
        return link
    record = Record(now(), str(link_path), simulated=options.simulated)
    with link:
        try:
            perform(BringUp(link, operator, has_rc=not options.no_rc), record)
        except OperatorError as error:
            print(f"\nended: {error}. The robot was ordered to stop.", file=sys.stderr)
        finally:
            print(f"\nrecord: {record.write(options.record)}")
    print("every step passed" if record.passed else "at least one step did not pass")
    return DONE if record.passed else FAILED
