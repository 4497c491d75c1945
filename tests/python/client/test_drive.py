"""Driving by keyboard and by script, and the display and record of reports."""

import argparse
import csv
import itertools
import os
import pty
import select
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from weeding_robot_client import drive, monitor
from weeding_robot_client.drive import keys, pressed
from weeding_robot_client.link import Link
from weeding_robot_client.messages import Quantity
from weeding_robot_client.recording import COLUMNS
from weeding_robot_client.script import HELP, ScriptError, Wish, parse

ROOT = Path(__file__).parents[3]


def options(mcu: Any, **more: Any) -> argparse.Namespace:
    defaults = {"link": mcu.path, "csv": None, "script": None, "lines": True, "reports": None}
    return argparse.Namespace(**{**defaults, **more})


def orders(mcu: Any) -> list[tuple[int, int, int]]:
    """Velocity of the first wheel, steering and stop of each order, as on the line."""
    return [
        (
            int.from_bytes(frame.payload[5:7], "little", signed=True),
            int.from_bytes(frame.payload[2:4], "little", signed=True),
            frame.payload[16],
        )
        for frame in mcu.of_kind(0x04)
    ]


def test_the_script_of_the_help_is_understood() -> None:
    lines = [line for line in HELP.splitlines() if line.startswith("  ")]
    script = parse("\n".join(lines))
    assert script.end_s == 7.0
    assert script.at(2.0) == Wish(value=150.0, steering_degrees=10.0)
    assert script.at(4.5) == Wish(Quantity.CURRENT, -2.5, -5.0)
    assert script.at(5.0) == Wish(Quantity.CURRENT, -2.5, -5.0, stop=True)
    assert script.at(6.9) == Wish(Quantity.CURRENT, -2.5, -5.0, stop=False)


def test_nothing_is_ordered_before_the_first_line() -> None:
    assert parse("at 1s velocity 5 rpm\nat 2s end").at(0.5) is None


@pytest.mark.parametrize(
    ("text", "place", "reason"),
    [
        ("at 0s velocity 150", 1, "cannot understand"),
        ("at 0s velocity 150 V", 1, "in rpm, not in V"),
        ("\nat 0s velocity 301 rpm", 2, "not within"),
        ("at 0s steering 33 deg", 1, "not within"),
        ("at 0s speed 3 rpm", 1, "unknown word"),
        ("at 0s velocity x rpm", 1, "not a number"),
        ("velocity 3 rpm", 1, "begins with a time"),
        ("at 0s", 1, "nothing follows"),
        ("at 2s stop\nat 1s release", 2, "before the line above"),
        ("at 2s end\nat 3s stop", 2, "nothing may follow"),
        ("at 2s stop end", 1, "stands alone"),
        ("at 2s end stop", 1, "stands alone"),
    ],
)
def test_a_wrong_line_is_named(text: str, place: int, reason: str) -> None:
    with pytest.raises(ScriptError, match=f"^script:{place}: .*{reason}"):
        parse(text)


def test_a_script_without_end_is_refused() -> None:
    with pytest.raises(ScriptError, match="end"):
        parse("at 0s stop")


def test_keys_and_arrows() -> None:
    assert list(keys(b"w\x1b[A\x1bOBq")) == [b"w", b"w", b"s", b"q"]
    wish = Wish()
    for key, repeat in ((b"w", 40), (b"a", 40)):
        for _ in range(repeat):
            wish = pressed(wish, key)
    assert wish == Wish(value=300.0, steering_degrees=32.0)
    assert pressed(wish, b" ") == Wish(value=0.0, steering_degrees=32.0, stop=True)
    assert pressed(pressed(wish, b" "), b"r") == Wish(value=0.0, steering_degrees=32.0)
    assert pressed(wish, b"0") == Wish()
    assert pressed(wish, b"x") == wish
    for key in (b"s", b"d"):
        for _ in range(80):
            wish = pressed(wish, key)
    assert wish == Wish(value=-300.0, steering_degrees=-32.0)


def test_a_script_drives_and_its_end_orders_standstill(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = tmp_path / "script"
    script.write_text("at 0s velocity 50 rpm\nat 0.3s steering -2 deg stop\nat 0.6s end\n")
    table = tmp_path / "reports.csv"
    assert drive.run(options(mcu, script=script, csv=table)) == 0
    time.sleep(0.2)
    ordered = [key for key, _ in itertools.groupby(orders(mcu))]
    assert ordered == [(500, 0, 0), (500, -200, 1), (0, -200, 1)]
    rows = list(csv.DictReader(table.open()))
    assert len(rows) >= 5
    assert tuple(rows[0]) == COLUMNS
    assert rows[-1]["state"] == "Working"
    assert rows[-1]["steering_degrees"] == ""
    assert rows[-1]["damaged"] == "0"
    assert "Working" in capsys.readouterr().out


def test_a_script_ends_with_an_error_when_the_connection_is_lost(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = tmp_path / "script"
    script.write_text("at 0s velocity 50 rpm\nat 60s end\n")
    threading.Timer(1.0, mcu.fall_silent).start()
    assert drive.run(options(mcu, script=script)) == 1
    assert "lost" in capsys.readouterr().err


def test_a_script_that_is_wrong_is_wrong_usage(
    mcu: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    script = tmp_path / "script"
    script.write_text("at 0s fly\n")
    assert drive.run(options(mcu, script=script)) == 2
    assert f"{script}:1:" in capsys.readouterr().err


def test_a_missing_line_is_explained(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    missing = argparse.Namespace(link=tmp_path / "none", csv=None, lines=True, reports=1)
    assert monitor.run(missing) == 1
    assert "./wr sim" in capsys.readouterr().err


def test_the_monitor_shows_lines(mcu: Any, capsys: pytest.CaptureFixture[str]) -> None:
    assert monitor.run(options(mcu, reports=3)) == 0
    shown = capsys.readouterr()
    assert len(shown.out.splitlines()) == 3
    assert "0 deg, 0 rpm  measured - deg, - - - - rpm" in shown.out
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


@pytest.mark.parametrize(("start", "told"), [((4, 0, 0, 0), False), ((4, 7, 2, 0), True)])
def test_driving_by_keyboard_tells_a_fault_once(
    mcu: Any, capsys: pytest.CaptureFixture[str], start: tuple[int, ...], told: bool
) -> None:
    mcu.start = start
    with Link(mcu.path) as link:
        next(link.reports(5.0))
        welcome = drive.tell_fault(link, None)
        assert drive.tell_fault(link, welcome) is welcome
    shown = capsys.readouterr().out
    assert shown.count("last reset: watchdog, after clock failed in step 2") == told


def test_the_monitor_shows_a_table(mcu: Any) -> None:
    with Link(mcu.path) as link:
        report = next(link.reports(5.0))
        table = monitor.as_table(report, link)
    assert "rear right" in table
    assert "counters: all 0" in table
    assert "no fault" in table


CUT_OFF = "front left wheel is cut off: its current was too high"
BLIND = "rear right wheel has tension but gives no Hall edge"


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
            ["steering is in fault: it did not move as ordered, or its position is missing"],
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
    assert monitor.faults(report) == words
    assert monitor.as_line(report).split("; ")[1:] == words
    assert all(word in table.splitlines() for word in words)


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
        known = drive.tell_changes(next(reports), [])
        known = drive.tell_changes(next(reports), known)
        assert capsys.readouterr().out.count(CUT_OFF) == 1
        mcu.conditions = (1, 0, 0, 0b1000, 0, 0, 0, 0)
        while monitor.faults(report := next(reports)) == known:
            pass
        assert drive.tell_changes(report, known) == [BLIND]
    shown = capsys.readouterr().out
    assert shown.count(f"no longer: {CUT_OFF}") == 1
    assert shown.count(BLIND) == 1


def read_until(terminal: int, text: bytes, seconds: float = 10.0) -> bytes:
    """What the program shows, until the text is there."""
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


def test_the_keyboard_drives_in_a_terminal(mcu: Any) -> None:
    mcu.stop = 1
    terminal, inner = pty.openpty()
    program = subprocess.Popen(
        [sys.executable, "-m", "traceability", "drive", "--link", mcu.path],
        cwd=ROOT, stdin=inner, stdout=inner, stderr=inner,
    )  # fmt: skip
    try:
        read_until(terminal, b"STOP (r releases)")
        wait_for(lambda: orders(mcu))
        os.write(terminal, b"r")
        read_until(terminal, b"ordered: +0 rpm")
        os.write(terminal, b"w\x1b[A\x1b[D")
        read_until(terminal, b"ordered: +20 rpm, +1 deg")
        time.sleep(0.2)
        os.write(terminal, b"q")
        assert program.wait(10) == 0
    finally:
        program.kill()
        program.wait()
        os.close(inner)
        os.close(terminal)
    time.sleep(0.2)
    ordered = orders(mcu)
    assert ordered[0] == (0, 0, 1)
    assert (200, 100, 0) in ordered
    assert ordered[-1] == (0, 100, 0)
