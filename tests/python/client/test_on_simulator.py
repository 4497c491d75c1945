"""The client against the firmware, which runs in real time on a pseudo-terminal: once built for
this machine, once as the image of the K64 on the virtual board."""

import itertools
import os
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from weeding_robot_client.link import Link
from weeding_robot_client.messages import Order, Quantity, Report, WheelSetPoint

ROOT = Path(__file__).parents[3]
PROGRAMS = ROOT / "build" / "host" / "sim"
IMAGE = ROOT / "build" / "k64" / "weeding_robot_paper.bin"
VELOCITY = WheelSetPoint(Quantity.VELOCITY, 40.0)


def build(preset: str, target: str) -> None:
    folder = ROOT / "build" / preset
    jobs = str(os.cpu_count() or 1)
    for words in (
        ["cmake", "-S", str(ROOT), "--preset", preset],
        ["cmake", "--build", str(folder), "--parallel", jobs, "--target", target],
    ):
        subprocess.run(words, check=True, cwd=ROOT, timeout=300, stdout=subprocess.DEVNULL)


@pytest.fixture(scope="module", params=["host", "board"])
def program(request: pytest.FixtureRequest) -> list[Path | str]:
    name = f"weeding_robot_{request.param}"
    build("host", name)
    if request.param == "host":
        return [PROGRAMS / name, "--paper"]
    build("k64", "weeding_robot_paper")
    return [PROGRAMS / name, "--image", IMAGE]


@pytest.fixture
def robot(program: list[Path | str], tmp_path: Path) -> Iterator[Path]:
    """A robot that was just switched on; its remote control is silent."""
    path = tmp_path / "pc-link"
    process = subprocess.Popen([*program, "--link", path], stdout=subprocess.DEVNULL)
    end = time.monotonic() + 10
    while not path.exists() and time.monotonic() < end:
        time.sleep(0.005)
    assert path.exists(), "the simulator made no link"
    yield path
    process.send_signal(signal.SIGINT)
    assert process.wait(10) == 0


def order(number: int, stop: bool = False) -> Order:
    return Order(number, -3.0, (VELOCITY,) * 4, stop)


def drive(link: Link, reports: int, first: int = 1, stop: bool = False) -> list[Report]:
    """Sends an order at once after each report, and returns the reports."""
    found: list[Report] = []
    for report in link.reports(5.0):
        found.append(report)
        link.send(order(first + len(found), stop))
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
    for report in reports[working:]:
        assert (report.mode, report.source, report.state) == ("PC", "PC", "Working")
        assert report.order_read


def test_the_robot_tells_why_it_started_and_no_fault(
    robot: Path, program: list[Path | str]
) -> None:
    with Link(robot) as link:
        drive(link, 1)
        assert link.welcome is not None
        start = str(link.welcome.start)
    assert start == ("power on" if IMAGE in program else "unknown cause")


def test_an_order_sent_before_a_clock_pulse_is_in_the_report_of_that_cycle(robot: Path) -> None:
    """Judges each order that was written at least 20 ms before the clock pulse by this clock."""
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
        report = drive(link, 30)[-1]
    assert report.steering_set_point_degrees == -3.0
    assert [wheel.set_point for wheel in report.wheels] == [VELOCITY] * 4
    assert report.steering_degrees == pytest.approx(-3.0, abs=0.5)
    for wheel in report.wheels:
        assert wheel.velocity_rpm == pytest.approx(VELOCITY.value, abs=10)


def test_cycles_follow_each_other_every_100_ms(robot: Path) -> None:
    with Link(robot) as link:
        reports = drive(link, 20)
    for before, after in itertools.pairwise(reports):
        assert after.cycle == before.cycle + 1
    assert reports[-1].time_ms - reports[0].time_ms == pytest.approx(1900, abs=60)


def test_a_stop_holds_and_outlives_the_connection_until_it_is_released(robot: Path) -> None:
    with Link(robot) as link:
        drive(link, 15)
        stopped = drive(link, 5, first=100, stop=True)[-1]
        assert stopped.stop
        assert stopped.held
    time.sleep(1.2)
    with Link(robot) as link:
        again = next(link.reports(5.0))
        assert again.stop
        assert again.held
        released = drive(link, 10, first=200)[-1]
        assert not released.stop
        assert not released.held


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
