"""The link of the client. A robot in Python answers at the other end of a pseudo-terminal."""

import fcntl
import itertools
import os
import time
from pathlib import Path
from typing import Any

import pytest

from weeding_robot_client.link import HELLO_EVERY_S, BusyError, Link
from weeding_robot_client.messages import Order, Quantity, Report, WheelSetPoint

HELLO, CONFIRM, KEEP_ALIVE, ORDER = 0x01, 0x02, 0x03, 0x04


def order(number: int) -> Order:
    point = WheelSetPoint(Quantity.VELOCITY, 10.0)
    return Order(number, 1.0, (point, point, point, point))


def first_report(link: Link) -> Report:
    report = next(link.reports(5.0), None)
    assert report is not None
    return report


def serve_until(link: Link, condition: Any, seconds: float = 5.0) -> bool:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        link.service(0.01)
        if condition():
            return True
    return False


def test_handshake_confirms_the_offered_session_and_brings_reports(mcu: Any) -> None:
    with Link(mcu.path) as link:
        assert not link.connected
        report = first_report(link)
        assert link.connected
        assert link.welcome is not None
        assert link.welcome.version == (1, 2, 3)
        assert report.mode == "PC"
    confirm = mcu.of_kind(CONFIRM)[-1]
    assert confirm.payload == bytes([mcu.session])


def test_sequence_numbers_follow_from_the_hello_on(mcu: Any) -> None:
    with Link(mcu.path) as link:
        first_report(link)
        for number in range(1, 301):
            assert link.send(order(number))
            link.service()
        assert serve_until(link, lambda: len(mcu.of_kind(ORDER)) == 300)
    last_hello = max(n for n, frame in enumerate(mcu.received) if frame.kind == HELLO)
    numbers = [frame.sequence for frame in mcu.received[last_hello:]]
    assert numbers == [n % 256 for n in range(len(numbers))]


def test_an_order_reaches_the_mcu_and_comes_back_in_a_report(mcu: Any) -> None:
    with Link(mcu.path) as link:
        first_report(link)
        link.send(order(77))
        reports = itertools.islice(link.reports(2.0), 50)
        assert any(report.order_id == 77 for report in reports)


def test_an_order_is_refused_without_a_connection(mcu: Any) -> None:
    mcu.silent = True
    with Link(mcu.path) as link:
        link.service(0.1)
        assert not link.send(order(1))
    assert not mcu.of_kind(ORDER)


def test_keep_alive_is_sent_when_there_is_no_order(mcu: Any) -> None:
    with Link(mcu.path) as link:
        first_report(link)
        assert serve_until(link, lambda: len(mcu.of_kind(KEEP_ALIVE)) >= 2, 3.0)
        assert link.connected


def test_hello_is_repeated_until_it_is_answered(mcu: Any) -> None:
    mcu.silent = True
    with Link(mcu.path) as link:
        assert serve_until(link, lambda: len(mcu.of_kind(HELLO)) >= 2, 3.0)
        mcu.silent = False
        first_report(link)


def test_every_third_hello_is_for_a_robot_that_accepts_only_version_1(mcu: Any) -> None:
    mcu.silent = True
    # Each time the link reads the clock, the time is later by one period of Hello.
    now = itertools.count(step=HELLO_EVERY_S)
    with Link(mcu.path, clock=lambda: float(next(now))) as link:
        assert serve_until(link, lambda: len(mcu.of_kind(HELLO)) >= 7)
    versions = [frame.version for frame in mcu.of_kind(HELLO)[:7]]
    assert versions == [2, 2, 1, 2, 2, 1, 2]


def test_a_silent_robot_is_lost_and_found_again(mcu: Any) -> None:
    with Link(mcu.path) as link:
        first_report(link)
        mcu.silent = True
        assert serve_until(link, lambda: not link.connected, 3.0)
        session = mcu.session
        mcu.silent = False
        assert serve_until(link, lambda: link.connected, 3.0)
        assert mcu.session == session + 1


def test_reports_of_a_connection_of_another_program_are_not_taken(mcu: Any) -> None:
    mcu.connected = True
    time.sleep(0.1)
    with Link(mcu.path) as link:
        first_report(link)
        assert link.welcome is not None
        assert mcu.of_kind(CONFIRM)


def test_noise_before_each_frame_is_counted_and_costs_no_frame(mcu: Any) -> None:
    mcu.noise = b"noise\0"
    with Link(mcu.path) as link:
        first_report(link)
        assert link.damaged >= 2


def test_a_line_that_goes_away_is_opened_again(mcu: Any, tmp_path: Path) -> None:
    path = tmp_path / "link"
    path.symlink_to(mcu.path)
    with Link(path) as link:
        first_report(link)
        link.close()
        assert serve_until(link, lambda: link.connected, 3.0)


def test_a_path_that_is_no_line_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="no such file"):
        Link(tmp_path / "missing")
    plain = tmp_path / "file"
    plain.touch()
    with pytest.raises(OSError, match="not a serial port"):
        Link(plain)


def test_iteration_over_reports_ends_when_none_comes(mcu: Any) -> None:
    mcu.silent = True
    with Link(mcu.path) as link:
        assert list(link.reports(0.2)) == []


def test_a_second_program_cannot_open_the_line(mcu: Any) -> None:
    with Link(mcu.path), pytest.raises(BusyError, match="another program"):
        Link(mcu.path)
    with Link(mcu.path):
        pass


def test_a_line_that_another_program_has_locked_is_busy(mcu: Any) -> None:
    other = os.open(mcu.path, os.O_RDWR | os.O_NOCTTY)
    try:
        fcntl.flock(other, fcntl.LOCK_EX)
        with pytest.raises(BusyError):
            Link(mcu.path)
    finally:
        os.close(other)


def test_hello_carries_versions_and_schema_hash(mcu: Any) -> None:
    with Link(mcu.path) as link:
        first_report(link)
    payload = mcu.of_kind(HELLO)[0].payload
    assert payload == b"\2\2" + mcu.schema.to_bytes(4, "little")


def test_a_robot_of_version_1_is_found_out(mcu: Any) -> None:
    mcu.versions = (1, 1)
    with Link(mcu.path) as link:
        assert serve_until(link, lambda: link.incompatible, 5.0)
        assert not link.connected
        assert link.incompatible == (
            "The robot uses version 1 of the PC protocol. This client uses version 2. "
            "Flash the robot (./wr flash), and connect again."
        )
    assert not mcu.of_kind(CONFIRM)


def test_a_robot_of_later_versions_asks_for_a_newer_client(mcu: Any) -> None:
    mcu.versions = (3, 4)
    with Link(mcu.path) as link:
        assert serve_until(link, lambda: link.incompatible, 5.0)
        assert "uses versions 3 to 4" in str(link.incompatible)
        assert "Update this client" in str(link.incompatible)


def test_a_robot_with_another_layout_of_the_same_version_is_connected(mcu: Any) -> None:
    mcu.schema ^= 1
    mcu.more = b"fields of later"
    with Link(mcu.path) as link:
        first_report(link)
        assert link.welcome is not None
        note = str(link.welcome.schema_note)
    assert f"0x{mcu.schema:08x}" in note
    assert "ignored" in note


def test_the_round_trip_is_from_the_order_to_the_report_that_echoes_it(mcu: Any) -> None:
    with Link(mcu.path) as link:
        assert first_report(link).round_trip_ms is None
        link.send(order(5))
        read = next(r for r in link.reports(2.0) if r.order_read)
        assert read.round_trip_ms is not None
        assert 0 <= read.round_trip_ms <= 100
        assert link.handshake_ms is not None
        assert 0 <= link.handshake_ms <= 500


def test_a_stop_is_sent_without_a_connection(mcu: Any) -> None:
    mcu.silent = True
    with Link(mcu.path) as link:
        link.service(0.05)
        point = WheelSetPoint(Quantity.VELOCITY, 0.0)
        assert link.send(Order(1, 0.0, (point, point, point, point), stop=True))
        assert serve_until(link, lambda: mcu.stop)


def test_an_unknown_state_does_not_end_the_connection(mcu: Any) -> None:
    mcu.numbers = {8: 9, 9: 7, 10: 6, 120: 99, 121: 98}
    with Link(mcu.path) as link:
        report = first_report(link)
        assert link.connected
    assert (report.state, report.mode, report.source) == ("state 9", "mode 7", "source 6")
    assert (report.inhibit, report.stop_cause) == ("inhibit 99", "stop cause 98")
