"""The client and the firmware, connected by a pseudo-terminal. The firmware runs in real time. Each
test runs twice: with the firmware for the host, and with the firmware image on the virtual K64.
"""

import itertools
import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from weeding_robot_client.bring_up import BringUp, Record, perform
from weeding_robot_client.link import Link
from weeding_robot_client.messages import Order, Quantity, Report, WheelSetPoint
from weeding_robot_client.operators import Control, SimulatedOperator
from weeding_robot_client.orders import Orders, acknowledge, arm, connect
from weeding_robot_client.script import Wish

ROOT = Path(__file__).parents[3]
PROGRAMS = ROOT / "build" / "host" / "sim"
IMAGE = ROOT / "build" / "k64" / "weeding_robot.bin"
VELOCITY = WheelSetPoint(Quantity.VELOCITY, 40.0)
STILL = WheelSetPoint(Quantity.VELOCITY, 0.0)


@pytest.fixture(scope="module", params=["host", "board"])
def program(request: pytest.FixtureRequest, build: Callable[..., None]) -> list[Path | str]:
    name = f"weeding_robot_{request.param}"
    build("host", name)
    if request.param == "host":
        return [PROGRAMS / name]
    build("k64", "weeding_robot")
    return [PROGRAMS / name, "--robot", "--image", IMAGE]


@pytest.fixture
def robot(program: list[Path | str], tmp_path: Path) -> Iterator[Path]:
    """Starts a simulated robot, and yields the path of its serial port. The remote control sends no
    pulses."""
    path = tmp_path / "pc-link"
    words = [*program, "--link", path, "--control", tmp_path / "control"]
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    end = time.monotonic() + 10
    while not path.exists() and time.monotonic() < end:
        time.sleep(0.005)
    assert path.exists(), "the simulator made no symbolic link"
    yield path
    process.send_signal(signal.SIGINT)
    assert process.wait(10) == 0


@pytest.fixture
def world(robot: Path) -> Iterator[Control]:
    """Yields a connection to the control socket of the robot."""
    control = Control(robot.parent / "control")
    yield control
    control.close()


def order(number: int, stop: bool = False, wheel: WheelSetPoint = VELOCITY) -> Order:
    return Order(number, -3.0, (wheel, wheel, wheel, wheel), stop)


def armed(link: Link) -> None:
    """Arms the robot with neutral orders."""
    orders = Orders(link)
    assert connect(orders)
    assert arm(orders) is None


def drive(
    link: Link,
    reports: int,
    first: int = 1,
    stop: bool = False,
    wheel: WheelSetPoint = VELOCITY,
) -> list[Report]:
    """Sends an order immediately after each report, and returns the reports."""
    found: list[Report] = []
    for report in link.reports(5.0):
        found.append(report)
        link.send(order(first + len(found), stop, wheel))
        if len(found) == reports:
            break
    assert len(found) == reports
    return found


def test_from_power_up_with_a_silent_remote_control_the_pc_commands_within_n_and_4_cycles(
    robot: Path,
) -> None:
    with Link(robot) as link:
        reports = drive(link, 20)
        assert link.welcome is not None
        waiting_cycles = link.welcome.waiting_cycles
    assert link.welcome.cycle_period_ms == 100
    first = next(n for n, report in enumerate(reports) if report.mode == "PC")
    working = next(
        n for n, report in enumerate(reports) if report.state == "Working" and n >= first
    )
    assert first <= waiting_cycles + 4
    assert working <= waiting_cycles + 4
    driven = reports[working:]
    assert {(report.mode, report.source) for report in driven} == {("PC", "PC")}
    read = [report for report in driven if report.state == "Working" and report.order_read]
    assert len(read) >= 0.8 * len(driven)  # A busy computer sometimes sends an order too late.


def test_the_robot_tells_why_it_started_and_no_fault(
    robot: Path, program: list[Path | str]
) -> None:
    with Link(robot) as link:
        drive(link, 1)
        assert link.welcome is not None
        start = str(link.welcome.start)
    assert start == ("power on" if IMAGE in program else "unknown cause")


def test_an_order_sent_before_a_clock_pulse_is_in_the_report_of_that_cycle(robot: Path) -> None:
    """Checks each order that was sent at least 20 ms before a clock pulse. The 20 ms are measured
    with the clock of this computer, not with the clock of the robot.
    """
    received: list[tuple[float, Report]] = []
    sent: list[float] = []
    with Link(robot) as link:
        for report in link.reports(5.0):
            received.append((time.monotonic(), report))
            assert link.send(order(len(received)))
            sent.append(time.monotonic())
            if len(received) == 60:
                break
    start = min(at - report.time_ms / 1000 for at, report in received)
    judged = 0
    for number, (_, report) in enumerate(received[1:], start=1):
        in_time = sent[number - 1] < start + report.time_ms / 1000 - 0.02
        if report.state == "Working" and in_time:
            assert report.order_id == number
            assert report.order_read
            judged += 1
    assert judged >= 30


def test_set_points_come_back_as_ordered_and_the_robot_follows_them(robot: Path) -> None:
    with Link(robot) as link:
        armed(link)
        report = drive(link, 30)[-1]
    assert report.armed
    assert report.steering_set_point_degrees == -3.0
    assert [str(wheel.set_point) for wheel in report.wheels] == ["40 rpm"] * 4
    assert report.steering_degrees == pytest.approx(-3.0, abs=0.5)
    for wheel in report.wheels:
        assert wheel.velocity_rpm == pytest.approx(VELOCITY.value, abs=10)


def test_cycles_follow_each_other_every_100_ms(robot: Path) -> None:
    with Link(robot) as link:
        reports = drive(link, 20)
    for before, after in itertools.pairwise(reports):
        assert after.cycle == before.cycle + 1
    assert reports[-1].time_ms - reports[0].time_ms == pytest.approx(1900, abs=60)


def test_orders_do_not_move_a_robot_that_is_not_armed(robot: Path) -> None:
    with Link(robot) as link:
        reports = drive(link, 25)
    assert reports[-1].inhibit == "not armed"
    assert all(abs(wheel.velocity_rpm or 0.0) < 1.0 for wheel in reports[-1].wheels)


def test_a_stop_holds_and_outlives_the_connection_until_it_is_released(robot: Path) -> None:
    with Link(robot) as link:
        armed(link)
        drive(link, 5)
        stopped = drive(link, 5, first=100, stop=True)[-1]
        assert stopped.stop
        assert stopped.stop_sources == ("PC",)
        assert stopped.held
    time.sleep(1.2)
    with Link(robot) as link:
        again = next(link.reports(5.0))
        assert again.stop
        assert again.held
        moving = drive(link, 10, first=200)[-1]
        assert moving.stop, "an order that moves the robot must not release a stop"
        released = drive(link, 15, first=300, wheel=STILL)[-1]
        assert not released.stop
        assert not released.held
        assert released.armed


def test_the_emergency_stop_latches_until_it_is_acknowledged(robot: Path, world: Control) -> None:
    with Link(robot) as link:
        armed(link)
        orders = Orders(link)
        orders.hold(Wish.of(Quantity.VELOCITY, 40.0), 1.0)
        world.do("estop press")
        orders.hold(Wish.of(Quantity.VELOCITY, 40.0), 1.0)
        assert orders.report is not None
        assert (orders.report.inhibit, orders.report.stop_cause) == (
            "protective stop",
            "emergency stop",
        )
        world.do("estop release")
        orders.hold(Wish(), 1.0)
        assert orders.report.inhibit == "protective stop"
        acknowledge(orders)
        assert arm(orders) is None


def test_the_round_trip_of_an_order_is_measured(robot: Path) -> None:
    with Link(robot) as link:
        reports = drive(link, 30)
    trips = [report.round_trip_ms for report in reports if report.round_trip_ms is not None]
    assert len(trips) >= 10
    assert all(trip > 0 for trip in trips)


def brought_up(robot: Path, world: Control, images: Path) -> Record:
    record = Record("2026-01-01T00:00:00", str(robot), simulated=True)
    with Link(robot) as link:
        perform(BringUp(link, SimulatedOperator(world), images), record)
    return record


@pytest.fixture
def images(program: list[Path | str], tmp_path: Path) -> Path:
    """Returns a folder with the symbolic link weeding_robot.bin. This link leads to the program for
    the host or to the firmware image. The simulated robot runs the same file. The bring-up searches
    this file for the build id that the robot reports."""
    folder = tmp_path / "images"
    folder.mkdir()
    (folder / "weeding_robot.bin").symlink_to(program[-1])
    return folder


def test_a_whole_bring_up_passes(robot: Path, world: Control, images: Path) -> None:
    record = brought_up(robot, world, images)
    assert [(step.step, step.seen) for step in record.steps if step.verdict != "pass"] == []


@pytest.mark.parametrize(
    ("fault", "finding"),
    [
        ("leads 1", "the motor leads are swapped"),
        ("hall-swapped 1", "the Hall wires are swapped"),
        ("hall 1", "its Hall sensors had no edges"),
        ("block 1", "no motion"),
    ],
)
def test_a_bring_up_finds_a_wheel_that_is_connected_wrongly(
    robot: Path, world: Control, images: Path, fault: str, finding: str
) -> None:
    world.do(f"fault {fault}")
    record = brought_up(robot, world, images)
    failed = {step.step: step.seen for step in record.steps if step.verdict != "pass"}
    assert list(failed) == ["wheel 1, front right"]
    assert finding in failed["wheel 1, front right"]


def test_a_bring_up_finds_a_steering_that_does_not_follow(
    robot: Path, world: Control, images: Path
) -> None:
    world.do("fault stall")
    record = brought_up(robot, world, images)
    failed = {step.step: step.seen for step in record.steps if step.verdict == "fail"}
    assert list(failed) == ["steering"]
    assert "the steering does not follow" in failed["steering"]


def test_a_bring_up_finds_a_receiver_without_fail_safe(
    robot: Path, world: Control, images: Path
) -> None:
    world.do("rc failsafe hold")
    record = brought_up(robot, world, images)
    failed = [step.step for step in record.steps if step.verdict != "pass"]
    assert failed == ["remote control: transmitter off"]


def test_orders_that_end_lead_to_reconnecting_which_holds(robot: Path) -> None:
    with Link(robot) as link:
        drive(link, 15)
        states = []
        for report in link.reports(5.0):
            states.append(report.state)
            if report.state == "Reconnecting":
                break
        assert report.held
        assert link.connected
    kinds = [state for n, state in enumerate(states) if state not in states[:n]]
    assert kinds[-3:] == ["Waiting", "WaitingN", "Reconnecting"]


def test_a_second_client_takes_the_link_over_with_a_new_session(robot: Path) -> None:
    with Link(robot) as first:
        drive(first, 3)
        assert first.welcome is not None
        session = first.welcome.session
    with Link(robot) as second:
        drive(second, 3)
        assert second.welcome is not None
        assert second.welcome.session != session


def test_damaged_bytes_are_counted_and_nothing_else_happens(robot: Path) -> None:
    with Link(robot) as link:
        before = drive(link, 15)[-1]
        noise = os.open(robot, os.O_WRONLY | os.O_NOCTTY)
        os.write(noise, b"\x05noise\0" * 3)
        os.close(noise)
        after = drive(link, 4, first=50)[-1]
        assert link.connected
    assert after.counters["damaged"] - before.counters["damaged"] == 3
    assert after.state == "Working"
