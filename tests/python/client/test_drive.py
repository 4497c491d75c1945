"""Driving by keyboard and by script, and the display and recording of reports."""

import argparse
import csv
import itertools
import os
import pty
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from weeding_robot_client import drive, exit_codes, monitor, procedures
from weeding_robot_client import orders as orders_module
from weeding_robot_client.keyboard import HELP, KEYS, Hand, keys
from weeding_robot_client.layout import FRAMES, LAYOUTS
from weeding_robot_client.link import Link
from weeding_robot_client.messages import Quantity, WheelSetPoint
from weeding_robot_client.reasons import CAUSES, CHECKS, faults
from weeding_robot_client.recording import COLUMNS
from weeding_robot_client.script import HELP as SCRIPT_HELP
from weeding_robot_client.script import ScriptError, Wish, parse

pytestmark = pytest.mark.runs_tools

ROOT = Path(__file__).parents[3]


def options(mcu: Any, **more: Any) -> argparse.Namespace:
    absent = dict.fromkeys(("csv", "mcap", "capture", "script", "reports", "wheel"))
    return argparse.Namespace(**{"link": mcu.path, "lines": True, **absent, **more})


def script_in(folder: Path, text: str) -> Path:
    script = folder / "script"
    script.write_text(text)
    return script


def orders(mcu: Any) -> list[tuple[int, int, int]]:
    """Returns three values of each order, in the units of the frames: the velocity of the first
    wheel, the steering and the commands."""
    return [
        (
            int.from_bytes(frame.payload[9:11], "little", signed=True),
            int.from_bytes(frame.payload[6:8], "little", signed=True),
            frame.payload[20],
        )
        for frame in mcu.of_kind(0x04)
    ]


def test_the_script_of_the_help_is_understood() -> None:
    lines = [line for line in SCRIPT_HELP.splitlines() if line.startswith("  ")]
    script = parse("\n".join(lines))
    assert script.end_s == 9.0
    assert script.at(2.0) == Wish.of(Quantity.VELOCITY, 150.0, 10.0)
    current = Wish.of(Quantity.CURRENT, -2.5, -5.0)
    assert script.at(4.5) == current
    one = current.with_wheel(0, WheelSetPoint(Quantity.TENSION, 1.0))
    assert script.at(5.5) == one
    assert script.at(6.0) == replace(one, stop=True)
    assert script.at(7.0) == Wish(steering_degrees=-5.0)
    assert script.at(8.1) == Wish(steering_degrees=-5.0, acknowledge=True)
    assert script.at(8.9) == Wish(steering_degrees=-5.0)


def test_each_wheel_has_its_own_value() -> None:
    script = parse("at 0s velocity 5 rpm wheel 2 tension 1 V wheel 3 velocity -7 rpm\nat 1s end")
    wish = script.at(0.0)
    assert wish is not None
    assert [str(point) for point in wish.wheels] == ["5 rpm", "5 rpm", "1 V", "-7 rpm"]


@pytest.mark.parametrize("words", ["release", "acknowledge"])
def test_release_and_acknowledge_set_the_wheels_to_0(words: str) -> None:
    script = parse(f"at 0s velocity 50 rpm stop\nat 1s {words}\nat 3s end")
    wish = script.at(1.0)
    assert wish is not None
    assert not any(point.value for point in wish.wheels)
    assert wish.stop == (words == "acknowledge")


def test_nothing_is_ordered_before_the_first_line() -> None:
    assert parse("at 1s velocity 5 rpm\nat 2s end").at(0.5) is None


@pytest.mark.parametrize(
    ("text", "place", "reason"),
    [
        ("at 0s velocity 150", 1, "is not valid here"),
        ("at 0s velocity 150 V", 1, "is rpm, not V"),
        ("at 0s wheel 4 velocity 5 rpm", 1, "not a wheel"),
        ("at 0s wheel x velocity 5 rpm", 1, "not a wheel"),
        ("at 0s wheel 0 steering 5 deg", 1, "cannot be ordered for a single wheel"),
        ("\nat 0s velocity 301 rpm", 2, "not within"),
        ("at 0s steering 33 deg", 1, "not within"),
        ("at 0s speed 3 rpm", 1, "unknown word"),
        ("at 0s velocity x rpm", 1, "not a number"),
        ("velocity 3 rpm", 1, "begins with a time"),
        ("at 0s", 1, "no values after the time"),
        ("at 2s stop\nat 1s release", 2, "before the time of the previous line"),
        ("at 2s end\nat 3s stop", 2, "nothing may follow"),
        ("at 2s stop end", 1, "must be alone"),
        ("at 2s end stop", 1, "must be alone"),
    ],
)
def test_a_wrong_line_is_named(text: str, place: int, reason: str) -> None:
    with pytest.raises(ScriptError, match=f"^script:{place}: .*{reason}"):
        parse(text)


def test_a_script_without_end_is_refused() -> None:
    with pytest.raises(ScriptError, match="end"):
        parse("at 0s stop")


def test_keys_and_arrows() -> None:
    assert list(keys(b"w\x1b[A\x1bOBQ\x1b[D\x1b[C")) == [b"w", b"w", b"s", b"q", b"j", b"l"]


# Name of a key in the help -> bytes that the terminal sends.
SENT = {"up": b"\x1b[A", "down": b"\x1b[B", "right": b"\x1b[C", "left": b"\x1b[D", "space": b" "}


def after(*names: str) -> Hand:
    """Returns the state after these keys were pressed at the time 0 s."""
    hand = Hand()
    for name in names:
        for key in keys(SENT.get(name, name.encode())):
            hand.press(key, 0.0)
    return hand


@pytest.mark.parametrize(
    ("effect", "expected"),
    [
        ("drive forwards", Wish.of(Quantity.VELOCITY, 50.0, 0.0, None)),
        ("drive backwards", Wish.of(Quantity.VELOCITY, -50.0, 0.0, None)),
        ("to the left", Wish.of(Quantity.VELOCITY, 0.0, 1.0, None)),
        ("to the right", Wish.of(Quantity.VELOCITY, 0.0, -1.0, None)),
        ("stop: halts the wheels", Wish(stop=True)),
        ("acknowledge", Wish(acknowledge=True)),
    ],
)
def test_each_key_has_the_effect_that_the_help_states(effect: str, expected: Wish) -> None:
    (names,) = (names for names, text in KEYS.items() if effect in text)
    for name in names.split(", "):
        assert after(name).wish(0.0) == expected
    assert effect in HELP


def test_the_keys_of_the_help_change_the_speed_and_centre_the_steering() -> None:
    (faster,) = (key for key, text in KEYS.items() if "faster" in text)
    (slower,) = (key for key, text in KEYS.items() if "slower" in text)
    (centre,) = (key for key, text in KEYS.items() if "steering to 0" in text)
    assert (after(faster).speed_rpm, after(slower).speed_rpm) == (60.0, 40.0)
    assert "10 rpm faster" in HELP
    assert after("left", centre).steering_degrees == 0.0


def velocity(hand: Hand, now: float) -> float:
    return hand.wish(now).wheels[0].value


def test_a_motion_lasts_for_300_ms_after_the_last_key() -> None:
    hand = Hand()
    assert velocity(hand, 0.0) == 0.0
    hand.press(b"w", 10.0)
    assert velocity(hand, 10.29) == 50.0
    assert velocity(hand, 10.31) == 0.0
    hand.press(b"w", 11.0)
    hand.press(b"w", 11.25)
    assert velocity(hand, 11.5) == 50.0
    hand.press(b"s", 11.6)
    assert velocity(hand, 11.7) == -50.0
    assert velocity(hand, 12.0) == 0.0


def test_a_steering_key_prolongs_a_motion_but_begins_none() -> None:
    hand = Hand()
    hand.press(b"j", 1.0)
    assert velocity(hand, 1.1) == 0.0
    hand.press(b"w", 2.0)
    hand.press(b"j", 2.2)
    assert velocity(hand, 2.45) == 50.0
    hand.press(b"j", 2.6)
    assert velocity(hand, 2.65) == 0.0
    assert hand.wish(3.0).steering_degrees == 3.0


def test_speed_and_steering_keep_their_limits() -> None:
    hand = Hand()
    for key in (b"+", b"j"):
        for _ in range(60):
            hand.press(key, 0.0)
    assert (hand.speed_rpm, hand.steering_degrees) == (300.0, 32.0)
    for key in (b"-", b"l"):
        for _ in range(80):
            hand.press(key, 0.0)
    assert (hand.speed_rpm, hand.steering_degrees) == (10.0, -32.0)
    hand.press(b"0", 0.0)
    hand.press(b"x", 0.0)
    assert hand.wish(0.0) == Wish()


def test_stop_release_and_acknowledge_end_a_motion() -> None:
    hand = Hand()
    for key in (b" ", b"r", b"a"):
        hand.press(b"w", 5.0)
        hand.press(key, 5.1)
        assert velocity(hand, 5.1) == 0.0
        assert hand.stop == (key == b" ")
    assert hand.wish(5.3).acknowledge
    assert not hand.wish(5.5).acknowledge
    hand.press(b" ", 6.0)
    hand.press(b"w", 6.1)
    assert hand.wish(6.2) == Wish(stop=True)


def test_the_keyboard_can_drive_some_wheels_only() -> None:
    hand = Hand(wheels=(2,))
    hand.press(b"w", 0.0)
    assert [point.value for point in hand.wish(0.1).wheels] == [0.0, 0.0, 50.0, 0.0]


def test_a_script_arms_drives_and_its_end_orders_standstill(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = script_in(
        tmp_path, "at 0s velocity 50 rpm\nat 0.3s steering -2 deg stop\nat 0.6s end\n"
    )
    table = tmp_path / "reports.csv"
    assert drive.run(options(mcu, script=script, csv=table)) == 0
    time.sleep(0.2)
    ordered = [key for key, _ in itertools.groupby(orders(mcu))]
    assert ordered == [(0, 0, 0), (500, 0, 0), (500, -200, 1), (0, -200, 1)]
    rows = list(csv.DictReader(table.open()))
    assert len(rows) >= 5
    assert tuple(rows[0]) == COLUMNS
    assert rows[-1]["state"] == "Working"
    assert rows[-1]["damaged"] == "0"
    assert {row["armed"] for row in rows} == {"0", "1"}
    assert {"not armed", "none", "stop"} <= {row["inhibit"] for row in rows}
    assert rows[-1]["stop_sources"] == "PC"
    assert any(0 <= int(row["round_trip_ms"] or -1) < 200 for row in rows)
    shown = capsys.readouterr()
    assert "Working" in shown.out
    assert "[stop of PC]" in shown.out
    assert "Send neutral orders for 0.5 s" in shown.err


@pytest.mark.parametrize(
    ("state", "reason"),
    [
        ({"stop": True}, "./wr arm"),
        ({"versions": (1, 1)}, "version 1 of the PC protocol"),
    ],
)
def test_a_script_does_not_start(
    mcu: Any,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    state: dict[str, Any],
    reason: str,
) -> None:
    vars(mcu).update(state)
    script = script_in(tmp_path, "at 0s velocity 50 rpm\nat 1s end\n")
    assert drive.run(options(mcu, script=script)) == 1
    assert reason in capsys.readouterr().err
    assert not orders(mcu)


def test_a_script_ends_with_an_error_when_the_robot_has_stopped_itself(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = script_in(tmp_path, "at 0s velocity 50 rpm\nat 1s end\n")
    threading.Timer(1.0, mcu.control, ("estop press",)).start()
    assert drive.run(options(mcu, script=script)) == 1
    shown = capsys.readouterr().err
    assert "protective stop, the emergency stop is pressed" in shown
    assert "not connected. Check first: the emergency stop: release it" in shown


def test_each_cause_of_a_protective_stop_has_a_text_and_first_checks() -> None:
    causes = {entry.shown for entry in FRAMES.enumerations["stop cause"].entries if entry.number}
    assert CAUSES.keys() == causes
    assert causes == {cause for cause, check in CHECKS.items() if check}
    assert not any("`" in check for check in CHECKS.values())


def test_a_script_ends_with_an_error_when_the_connection_is_lost(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = script_in(tmp_path, "at 0s velocity 50 rpm\nat 60s end\n")
    threading.Timer(1.0, setattr, (mcu, "silent", True)).start()
    assert drive.run(options(mcu, script=script)) == 1
    assert "lost" in capsys.readouterr().err


@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_script_that_is_ended_orders_stop(mcu: Any, tmp_path: Path, sent: int) -> None:
    script = script_in(tmp_path, "at 0s velocity 50 rpm\nat 60s end\n")
    program = start_drive(mcu, "--script", str(script), stdin=subprocess.DEVNULL)
    wait_for(lambda: (500, 0, 0) in orders(mcu))
    program.send_signal(sent)
    assert program.wait(10) == (130 if sent == signal.SIGINT else 1)
    assert orders(mcu)[-1] == (0, 0, 1)
    assert mcu.stop


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"at 0s fly\n", (exit_codes.USAGE, "{}:1:")),
        (b"\xff\xfe", (exit_codes.USAGE, "{}: the file is not UTF-8 text; save it as UTF-8")),
        (None, (exit_codes.MISSING, "cannot read {}: No such file or directory.")),
    ],
)
def test_a_script_that_cannot_be_read_is_named(
    mcu: Any,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    content: bytes | None,
    expected: tuple[int, str],
) -> None:
    script = tmp_path / "script"
    if content is not None:
        script.write_bytes(content)
    code, reason = expected
    assert drive.run(options(mcu, script=script)) == code
    assert reason.format(script) in capsys.readouterr().err


@pytest.mark.parametrize("run", [monitor.run, procedures.run_arm, drive.run])
def test_a_recording_that_cannot_be_written_is_named(
    mcu: Any,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    run: Callable[[argparse.Namespace], int],
) -> None:
    script = script_in(tmp_path, "at 0s end\n")
    table = tmp_path / "no folder" / "reports.csv"
    with pytest.raises(SystemExit, match=str(exit_codes.MISSING)):
        run(options(mcu, csv=table, script=script, reports=1))
    assert capsys.readouterr().err == (
        f"cannot write {table}: No such file or directory. Name another file.\n"
    )
    assert not mcu.received


def test_a_full_disk_ends_the_recording_and_not_the_drive(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = script_in(tmp_path, "at 0s velocity 50 rpm\nat 3s end\n")
    assert drive.run(options(mcu, script=script, csv=Path("/dev/full"))) == 0
    told = "the recording /dev/full ends here: No space left on device"
    assert capsys.readouterr().err.count(told) == 1
    assert (500, 0, 0) in orders(mcu)


def test_an_error_in_a_script_stops_the_robot(
    mcu: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_report: object) -> str:
        raise BrokenPipeError

    script = script_in(tmp_path, "at 0s velocity 50 rpm\nat 5s end\n")
    monkeypatch.setattr(drive, "as_line", fail)
    with pytest.raises(BrokenPipeError):
        drive.run(options(mcu, script=script))
    time.sleep(0.2)
    assert orders(mcu)[-1] == (0, 0, 1)


def test_a_missing_line_is_explained(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    missing = argparse.Namespace(
        link=tmp_path / "none", csv=None, mcap=None, capture=None, lines=True, reports=1
    )
    with pytest.raises(SystemExit, match=str(exit_codes.MISSING)):
        monitor.run(missing)
    assert "./wr sim" in capsys.readouterr().err


def test_the_monitor_shows_lines(mcu: Any, capsys: pytest.CaptureFixture[str]) -> None:
    assert monitor.run(options(mcu, reports=3)) == 0
    shown = capsys.readouterr()
    assert len(shown.out.splitlines()) == 3
    assert "0 deg, 0 rpm  measured 0.00 deg, 0.0 0.0 0.0 0.0 rpm  [no order]" in shown.out
    assert "connected to firmware 1.2.3 build 0123abcd; last reset: power on\n" in shown.err


def test_the_monitor_shows_the_fault_before_the_last_start(
    mcu: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    mcu.start = (7, 1, 3, 0x4A6E)
    assert monitor.run(options(mcu, reports=1)) == 0
    told = "last reset: software, after assertion 3 failed at 0x00004a6e"
    assert told in capsys.readouterr().err
    with Link(mcu.path) as link:
        assert told in monitor.as_table(next(link.reports(5.0)), link)


def test_the_table_shows_that_the_layouts_of_the_frames_differ(mcu: Any) -> None:
    """When the connection is established, the monitor prints a line about the different layouts.
    Each new table clears the screen, so this line disappears. Therefore the table also shows that
    the layouts differ."""
    mcu.schema = 1
    with Link(mcu.path) as link:
        assert "the layout 0x00000001" in monitor.as_table(next(link.reports(5.0)), link)


def test_the_monitor_shows_the_last_reset_of_a_robot_that_sends_no_reports(mcu: Any) -> None:
    mcu.restarts = True
    mcu.start = (4, 0, 0, 0)
    with Link(mcu.path) as link:
        assert "No answer" in monitor.status(link)
        assert next(link.reports(1.5), None) is None
        assert "sends no reports. Last reset: watchdog. If" in monitor.status(link)
        mcu.restarts = False
        next(link.reports(5.0))
        assert "connected to firmware" in monitor.status(link)
        mcu.silent = True
        list(link.reports(1.5))
        assert "No answer" in monitor.status(link)


@pytest.mark.parametrize(("start", "told"), [((4, 0, 0, 0), False), ((4, 7, 2, 0), True)])
def test_driving_by_keyboard_tells_a_fault_once(
    mcu: Any, capsys: pytest.CaptureFixture[str], start: tuple[int, ...], told: bool
) -> None:
    mcu.start = start
    with Link(mcu.path) as link:
        next(link.reports(5.0))
        welcome = drive.show_start(link, None)
        assert drive.show_start(link, welcome) is welcome
    shown = capsys.readouterr().out
    assert shown.count("last reset: watchdog, after clock failed in step 2") == told


def test_the_monitor_shows_a_table(mcu: Any) -> None:
    with Link(mcu.path) as link:
        report = next(link.reports(5.0))
        table = monitor.as_table(report, link)
    assert "rear right" in table
    assert "counters: all 0" in table
    assert "The robot does not move: no order. Send orders" in table
    assert "stop ordered by: nobody" in table


@pytest.mark.parametrize(
    ("inhibit", "sources", "short"),
    [
        ("no order", (), "[no order; protective stop: emergency stop]"),
        ("stop", ("RC",), "[stop of RC; protective stop: emergency stop]"),
        ("protective stop", (), "[protective stop: emergency stop]"),
    ],
)
def test_the_monitor_shows_a_latched_protective_stop_besides_another_reason(
    mcu: Any, inhibit: str, sources: tuple[str, ...], short: str
) -> None:
    with Link(mcu.path) as link:
        report = replace(
            next(link.reports(5.0)),
            inhibit=inhibit,
            stop_sources=sources,
            stop_cause="emergency stop",
        )
        table = monitor.as_table(report, link)
    assert short in monitor.as_line(report)
    assert "protective stop, the emergency stop is pressed" in table
    assert table.count("Remove the cause, then acknowledge") == 1


def test_a_reason_that_replaces_another_reason_ends_none(
    mcu: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    with Link(mcu.path) as link:
        report = replace(next(link.reports(5.0)), inhibit="stop", stop_cause="emergency stop")
    known = drive.show_changes(report, [])
    known = drive.show_changes(replace(report, inhibit="protective stop"), known)
    assert "no longer" not in capsys.readouterr().out
    drive.show_changes(replace(report, inhibit="none", stop_cause="none"), known)
    assert "no longer: The robot does not move: protective stop" in capsys.readouterr().out


CUT_OFF = "front left wheel has an overcurrent trip: its current was too high"
BLIND = "rear right wheel has no motion feedback: it has voltage but no Hall edges"


@pytest.mark.parametrize(
    ("conditions", "words"),
    [
        ((0, 0, 0, 0, 0, 0, 0, 0), []),
        ((2, 0, 0, 0, 9, 9, 9, 9), []),
        ((1, 0, 0b0001, 0b1000, 0, 0, 0, 0), [CUT_OFF, BLIND]),
        ((2, 0b01, 0, 0, 0, 0, 0, 0), ["steering is at its left end stop"]),
        ((2, 0b10, 0, 0, 0, 0, 0, 0), ["steering is at its right end stop"]),
        (
            (3, 0, 0, 0, 0, 0, 0, 0),
            [
                "steering is in fault: it did not move as ordered, its position is missing, or "
                "both end stops are reached"
            ],
        ),
    ],
)
def test_the_monitor_tells_faults_in_words(
    mcu: Any, conditions: tuple[int, ...], words: list[str]
) -> None:
    mcu.conditions = conditions
    with Link(mcu.path) as link:
        report = next(link.reports(5.0))
        table = monitor.as_table(report, link)
    assert faults(report) == words
    assert monitor.as_line(report).split("; ")[1:] == words
    assert all(word in table.splitlines() for word in words)


@pytest.mark.parametrize(
    ("source", "words"),
    [
        (None, "no order yet"),
        ("PC", "order 7 of the PC"),
        ("RC", "order of the RC"),
        ("Bluetooth", "order 7 of the Bluetooth device"),
    ],
)
def test_the_monitor_names_the_source_of_the_order(
    mcu: Any, source: str | None, words: str
) -> None:
    with Link(mcu.path) as link:
        report = replace(next(link.reports(5.0)), source=source, order_id=7)
    assert monitor.source(report) == words


def test_the_monitor_tells_rejected_edges_of_each_wheel(mcu: Any) -> None:
    mcu.conditions = (1, 0, 0, 0, 10, 20, 30, 65535)
    with Link(mcu.path) as link:
        table = monitor.as_table(next(link.reports(5.0)), link)
    rows = [line for line in table.splitlines() if line.startswith(("front", "rear"))]
    assert [row.split()[-1] for row in rows] == ["10", "20", "30", "65535"]


def test_driving_by_keyboard_tells_when_a_fault_begins_and_ends(
    mcu: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    mcu.conditions = (1, 0, 0b0001, 0, 0, 0, 0, 0)
    with Link(mcu.path) as link:
        reports = link.reports(5.0)
        known = drive.show_changes(next(reports), [])
        known = drive.show_changes(next(reports), known)
        assert capsys.readouterr().out.count(CUT_OFF) == 1
        mcu.conditions = (1, 0, 0, 0b1000, 0, 0, 0, 0)
        while CUT_OFF in faults(report := next(reports)):
            pass
        known = drive.show_changes(report, known)
        assert BLIND in known
        assert CUT_OFF not in known
    shown = capsys.readouterr().out
    assert shown.count(f"no longer: {CUT_OFF}") == 1
    assert shown.count(BLIND) == 1


def read_until(terminal: int, text: bytes, seconds: float = 10.0) -> bytes:
    """Returns the output of the program as soon as it contains the text."""
    data = b""
    end = time.monotonic() + seconds
    while text not in data and time.monotonic() < end:
        if select.select([terminal], [], [], 0.1)[0]:
            data += os.read(terminal, 4096)
    assert text in data, data
    return data


def wait_for(condition: Callable[[], Any], seconds: float = 10.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.005)


def start_drive(mcu: Any, *words: str, stdin: int) -> subprocess.Popen[bytes]:
    output = subprocess.DEVNULL if stdin == subprocess.DEVNULL else stdin
    return subprocess.Popen(
        [sys.executable, "-m", "tools", "drive", "--link", mcu.path, *words],
        cwd=ROOT, stdin=stdin, stdout=output, stderr=output,
        env={**os.environ, "PYTHONUNBUFFERED": "", "PYTHONPATH": f"{ROOT}:{ROOT / 'client'}"},
    )  # fmt: skip


@dataclass
class Terminal:
    """A terminal in which the program for driving by keyboard runs."""

    keys: int
    inner: int
    program: subprocess.Popen[bytes]

    def type(self, text: bytes, seconds: float = 0.0) -> None:
        """Types a text. If a time is given, types the text repeatedly during this time, like a key
        that is held down."""
        end = time.monotonic() + seconds
        os.write(self.keys, text)
        while time.monotonic() < end:
            time.sleep(0.05)
            os.write(self.keys, text)

    def hang_up(self) -> None:
        os.close(self.inner)
        os.close(self.keys)
        self.inner = self.keys = -1


@pytest.fixture
def terminal(mcu: Any) -> Iterator[Terminal]:
    keyboard, inner = pty.openpty()
    tried = Terminal(keyboard, inner, start_drive(mcu, stdin=inner))
    yield tried
    tried.program.kill()
    tried.program.wait()
    if tried.keys >= 0:
        tried.hang_up()


def test_the_keyboard_drives_while_a_key_is_held(mcu: Any, terminal: Terminal) -> None:
    mcu.stop = True
    read_until(terminal.keys, b"STOP (r releases)")
    wait_for(lambda: orders(mcu))
    terminal.type(b"r")
    read_until(terminal.keys, b"ordered: +0 rpm")
    wait_for(lambda: mcu.armed)
    terminal.type(b"\x1b[D")
    terminal.type(b"\x1b[A", seconds=0.5)
    read_until(terminal.keys, b"ordered: +50 rpm, +1 deg")
    wait_for(lambda: orders(mcu)[-1] == (0, 100, 0))  # The key is released.
    terminal.type(b"q")
    assert terminal.program.wait(10) == 0
    ordered = orders(mcu)
    assert ordered[0] == (0, 0, 1)
    assert (500, 100, 0) in ordered
    assert ordered[-1] == (0, 100, 0)
    assert not mcu.stop


def test_acknowledge_key_releases_a_protective_stop(mcu: Any, terminal: Terminal) -> None:
    read_until(terminal.keys, b"armed")
    mcu.control("estop press")
    read_until(terminal.keys, b"the emergency stop is pressed")
    mcu.control("estop release")
    time.sleep(0.1)
    assert mcu.latched
    terminal.type(b"a")
    wait_for(lambda: not mcu.latched)
    wait_for(lambda: mcu.armed)


def test_the_loss_of_the_terminal_stops_the_robot(mcu: Any, terminal: Terminal) -> None:
    read_until(terminal.keys, b"ordered: +0 rpm")
    terminal.hang_up()
    assert terminal.program.wait(10) == 1
    assert mcu.stop


@pytest.mark.parametrize("sent", [signal.SIGHUP, signal.SIGTERM, signal.SIGINT])
def test_a_signal_that_ends_the_keyboard_stops_the_robot(
    mcu: Any, terminal: Terminal, sent: int
) -> None:
    read_until(terminal.keys, b"ordered: +0 rpm")
    terminal.program.send_signal(sent)
    assert terminal.program.wait(10) == (130 if sent == signal.SIGINT else 1)
    assert mcu.stop


def test_a_program_that_is_suspended_stops_the_robot_first(mcu: Any, terminal: Terminal) -> None:
    read_until(terminal.keys, b"ordered: +0 rpm")
    terminal.program.send_signal(signal.SIGTSTP)
    wait_for(lambda: mcu.stop)
    time.sleep(0.3)
    terminal.program.send_signal(signal.SIGCONT)
    read_until(terminal.keys, b"STOP (r releases)")
    terminal.type(b"r")
    wait_for(lambda: not mcu.stop)


def test_a_busy_line_is_explained(mcu: Any, capsys: pytest.CaptureFixture[str]) -> None:
    with Link(mcu.path), pytest.raises(SystemExit, match=str(exit_codes.BUSY)):
        monitor.run(options(mcu, reports=1))
    assert "is in use: another program drives or monitors the robot" in capsys.readouterr().err


def test_arm_reports_progress_and_the_reason(mcu: Any, capsys: pytest.CaptureFixture[str]) -> None:
    mcu.stop = True
    assert procedures.run_arm(options(mcu)) == 0
    shown = capsys.readouterr().out
    assert "releases the stop of the PC" in shown
    assert shown.endswith("armed\n")
    assert not mcu.stop


def test_arm_says_why_it_cannot(
    mcu: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(orders_module, "ARM_WITHIN_S", 0.5)
    mcu.control("rc enable stop")
    assert procedures.run_arm(options(mcu)) == 1
    shown = capsys.readouterr().out
    assert "not armed: The robot does not move: a stop is in force. The remote control" in shown


@pytest.mark.parametrize("inhibit", [0, 3])
def test_arm_states_that_the_remote_control_drives(
    mcu: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], inhibit: int
) -> None:
    """The remote control has armed the robot, or is arming it. The PC cannot drive."""
    monkeypatch.setattr(orders_module, "ARM_WITHIN_S", 0.5)
    mode, source, flags, reason = (
        LAYOUTS["Report"].of(name).offset for name in ("mode", "source", "flags", "inhibit")
    )
    read_and_armed = 0b10010 if inhibit == 0 else 0b00010
    mcu.numbers = {mode: 0, source: 0, flags: read_and_armed, reason: inhibit}
    assert procedures.run_arm(options(mcu)) == exit_codes.FAILED
    last = capsys.readouterr().out.splitlines()[-1]
    assert last.startswith("not armed: The robot reads no order of the PC, because the remote")
    assert "Set the enable switch to 'PC'" in last
    assert "weeding_robot_paper and weeding_robot_warning: switch the transmitter off" in last


def test_arm_shows_a_protective_stop_while_the_remote_control_drives(
    mcu: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(orders_module, "ARM_WITHIN_S", 0.5)
    mcu.latched = 5
    mcu.control("rc enable drive")
    assert procedures.run_arm(options(mcu)) == exit_codes.FAILED
    assert "not armed: The robot does not move: protective stop" in capsys.readouterr().out


def test_a_script_does_not_start_while_the_remote_control_drives(
    mcu: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(orders_module, "ARM_WITHIN_S", 0.5)
    mcu.has_safety = False
    mcu.control("rc enable drive")
    script = script_in(tmp_path, "at 0s velocity 20 rpm\nat 0.2s end\n")
    assert drive.run(options(mcu, script=script)) == exit_codes.FAILED
    assert "switch the transmitter off" in capsys.readouterr().err
    assert all(velocity == 0 for velocity, _, _ in orders(mcu))


def test_acknowledge_releases_a_protective_stop_and_arms(
    mcu: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    mcu.latched = 5
    assert procedures.run_acknowledge(options(mcu)) == 0
    assert mcu.latched == 0
    assert capsys.readouterr().out.endswith("armed\n")
    acknowledged = [order for order in orders(mcu) if order[2] & 2]
    assert acknowledged
    assert set(acknowledged) == {(0, 0, 2)}


def test_a_robot_without_safety_functions_needs_no_arming(mcu: Any) -> None:
    mcu.has_safety = False
    assert procedures.run_arm(options(mcu)) == 0
