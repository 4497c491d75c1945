"""Drives the robot from the keyboard or from a file."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

from weeding_robot_client import keyboard
from weeding_robot_client.exit_codes import DONE, FAILED, MISSING, USAGE
from weeding_robot_client.keyboard import Hand, raw_keys, read_keys
from weeding_robot_client.link import Link
from weeding_robot_client.messages import Quantity, Report, Welcome
from weeding_robot_client.monitor import as_line, shown, status
from weeding_robot_client.options import add_link, opened, wheel
from weeding_robot_client.orders import (
    ORDER_EVERY_S,
    ORDER_LIFETIME_S,
    Orders,
    arm,
    connect,
    not_connected,
)
from weeding_robot_client.reasons import NOT_MOVING, conditions, inhibited, latched
from weeding_robot_client.recording import Recording
from weeding_robot_client.script import HELP, NEUTRAL_S, Script, ScriptError, Wish, load

DESCRIPTION = f"""\
Sends orders to the robot every {ORDER_EVERY_S} s.
An order is valid for {ORDER_LIFETIME_S} s.
Without --script the keyboard orders the motion. While no key is pressed, the orders are neutral.
If the robot has the safety functions and no protective stop is latched, {NEUTRAL_S} s of neutral
orders arm it. A robot without the safety functions needs no arming.
If a stop is already in force, it stays in force until it is released. When the terminal is lost or
the program is suspended, the program orders the robot to stop.

{keyboard.HELP}

Exit code {FAILED}: no connection, not armed, stopped or interrupted."""
EPILOG = HELP


def add_options(parser: argparse.ArgumentParser) -> None:
    add_link(parser)
    parser.add_argument("--script", type=Path, metavar="FILE", help="drive from this file")
    parser.add_argument(
        "--wheel",
        type=wheel,
        action="append",
        metavar="N",
        help="with the keyboard: drive this wheel only (0 front left, 1 front right, 2 rear left, "
        "3 rear right); repeat the option for several wheels",
    )


def run(options: argparse.Namespace) -> int:
    try:
        script = _script(options)
    except ScriptError as error:
        print(error, file=sys.stderr)
        return USAGE
    except OSError as error:
        print(f"cannot read {error.filename}: {error.strerror}. Name another file with --script.",
              file=sys.stderr)  # fmt: skip
        return MISSING
    with opened(options) as (link, recording):
        if script:
            return by_script(link, script, recording)
        return by_keyboard(link, recording, tuple(options.wheel) if options.wheel else None)


def _script(options: argparse.Namespace) -> Script | None:
    """Returns the script, or None for the keyboard."""
    if options.script is None:
        if not sys.stdin.isatty():
            raise ScriptError("the keyboard needs a terminal; name a file with --script")
        return None
    if options.wheel:
        raise ScriptError("--wheel is for the keyboard; write 'wheel N' in the script")
    return load(options.script)


def by_script(link: Link, script: Script, recording: Recording) -> int:
    """Arms the robot and drives according to the script. Returns the exit code.

    If a signal or an exception ends the program, the program first orders the robot to stop.
    """

    def observe(report: Report) -> None:
        recording.add(report)
        print(as_line(report), flush=True)

    orders = Orders(link, observe)
    with ended_by_signals() as requests:
        try:
            return _follow(orders, script, requests)
        except BaseException:
            orders.stop()
            raise


def _follow(orders: Orders, script: Script, requests: list[int]) -> int:
    error = _prepare(orders)
    if error:
        print(error, file=sys.stderr)
        return FAILED
    start = time.monotonic()
    while (now := time.monotonic()) < start + script.end_s:
        rest = min(start + script.end_s - now, ORDER_EVERY_S / 5)
        orders.service(script.at(now - start), rest)
        if requests:
            orders.stop()
            print("interrupted; the program has ordered the robot to stop", file=sys.stderr)
            return FAILED
        if not orders.link.connected:
            print("the connection was lost: check cable and power", file=sys.stderr)
            return FAILED
    orders.end(script.at(script.end_s) or Wish())
    report = orders.report
    if report and latched(report):
        print(inhibited(report), file=sys.stderr)
        return FAILED
    return DONE


def _prepare(orders: Orders) -> str | None:
    """Connects and arms the robot. Returns the reason if this fails, or None."""
    report = connect(orders)
    if report is None:
        return not_connected(orders.link)
    print(status(orders.link), file=sys.stderr)
    if "PC" in report.stop_sources:
        return f"{inhibited(report)} A script does not release this stop."
    return arm(orders, progress=lambda words: print(words, file=sys.stderr))


@contextmanager
def ended_by_signals() -> Iterator[list[int]]:
    """Collects requests to end or to suspend the program. The program can then stop the robot
    first."""
    requests: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        requests.append(number)

    numbers = (signal.SIGHUP, signal.SIGTERM, signal.SIGTSTP)
    before = {number: signal.signal(number, note) for number in numbers}
    try:
        yield requests
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def by_keyboard(link: Link, recording: Recording, wheels: tuple[int, ...] | None) -> int:
    """Drives the robot with the keys. Orders a stop if the program ends without the key q."""
    orders = Orders(link, recording.add)
    print(keyboard.HELP)
    quits = False
    try:
        with ended_by_signals() as requests, raw_keys(sys.stdin.fileno()):
            quits = _Driver(orders, wheels, requests).run()
    except OSError:
        pass  # the terminal is gone
    finally:
        if not quits:
            orders.stop()
            drop_output()
    if quits:
        print()
    return DONE if quits else FAILED


def drop_output() -> None:
    """Discards the output to a closed terminal. Otherwise, Python would exit with code 120."""
    if os.isatty(sys.stdin.fileno()):
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


class _Driver:
    """The loop of the keyboard drive."""

    def __init__(self, orders: Orders, wheels: tuple[int, ...] | None, requests: list[int]) -> None:
        self._orders = orders
        self._link = orders.link
        self._hand = Hand(wheels)
        self._requests = requests
        self._welcome: Welcome | None = None
        self._conditions: list[str] = []
        self._first = True  # no report of this connection was received yet

    def run(self) -> bool:
        """Runs the loop. Returns true if the key q ended the loop, otherwise false."""
        while True:
            pressed = read_keys(sys.stdin.fileno())
            if pressed is None or self._ends():
                return False
            now = time.monotonic()
            for key in pressed:
                if key == b"q":
                    self._orders.end(self._hand.wish(now))
                    return True
                self._hand.press(key, now)
            wish = self._hand.wish(now)
            for report in self._orders.service(None if self._first else wish):
                self._show(report, wish)
            if self._link.incompatible:
                print(f"\r\x1b[K{self._link.incompatible}", flush=True)
                return False
            if not self._link.connected:
                self._first = True
                print(f"\r\x1b[Kno connection on {self._link.path}, trying", end="", flush=True)

    def _ends(self) -> bool:
        """Stops the robot and suspends this program on request. Returns true if the program must
        end.
        """
        if not self._requests:
            return False
        if set(self._requests) != {signal.SIGTSTP}:
            return True
        self._requests.clear()
        self._hand.press(b" ", time.monotonic())
        self._orders.stop()
        suspend()
        return False

    def _show(self, report: Report, wish: Wish) -> None:
        if self._first:
            self._hand.stop = self._hand.stop or "PC" in report.stop_sources
            self._first = False
        self._welcome = show_start(self._link, self._welcome)
        self._conditions = show_changes(report, self._conditions)
        show(wish, self._hand, report)


def suspend() -> None:
    """Suspends this program as Ctrl-Z does. Returns when the program continues."""
    terminal = sys.stdin.fileno()
    handler = signal.signal(signal.SIGTSTP, signal.SIG_DFL)
    print("\r\x1b[Ksuspended: the robot was ordered to stop", flush=True)
    with raw_keys_off(terminal):
        os.kill(os.getpid(), signal.SIGTSTP)
    signal.signal(signal.SIGTSTP, handler)


@contextmanager
def raw_keys_off(terminal: int) -> Iterator[None]:
    """Restores the mode of the terminal for the shell while this program is suspended."""
    import termios
    import tty

    raw = termios.tcgetattr(terminal)
    usual = termios.tcgetattr(terminal)
    usual[tty.LFLAG] |= termios.ICANON | termios.ECHO
    termios.tcsetattr(terminal, termios.TCSADRAIN, usual)
    try:
        yield
    finally:
        termios.tcsetattr(terminal, termios.TCSADRAIN, raw)


def show_start(link: Link, before: Welcome | None) -> Welcome | None:
    """Shows a fault that was recorded before the last start of the robot. Also shows a difference
    between the layouts of the robot and this client. Each text is shown once in a connection.

    Returns the Welcome of the connection.
    """
    welcome = link.welcome
    if welcome and welcome is not before:
        if welcome.start.faulted:
            print(f"\r\x1b[Klast reset: {welcome.start}", flush=True)
        if welcome.schema_note:
            print(f"\r\x1b[K{welcome.schema_note}", flush=True)
    return welcome


def show_changes(report: Report, before: list[str]) -> list[str]:
    """Shows each condition once when it begins and once when it ends. Returns all present
    conditions.

    A condition can be a reason why the robot does not move. If another such reason replaces this
    reason, the end of the first reason is not shown.
    """
    now = conditions(report)
    for condition in now:
        if condition not in before:
            print(f"\r\x1b[K{condition}", flush=True)
    still = any(condition.startswith(NOT_MOVING) for condition in now)
    for condition in before:
        replaced = still and condition.startswith(NOT_MOVING)
        if condition not in now and not replaced:
            print(f"\r\x1b[Kno longer: {condition}", flush=True)
    return now


def show(wish: Wish, hand: Hand, report: Report) -> None:
    """Shows the present order and the robot's state in one line."""
    velocity = max((point.value for point in wish.wheels), key=abs)
    ordered = "STOP (r releases)" if wish.stop else f"{velocity:+.0f} {Quantity.VELOCITY.unit}"
    if wish.acknowledge:
        ordered = "acknowledge"
    robot = "armed" if report.armed else f"inhibit: {report.inhibit}"
    print(
        f"\r\x1b[Kordered: {ordered}, {wish.steering_degrees:+.0f} deg (speed "
        f"{hand.speed_rpm:.0f})   robot: {report.state}, mode {report.mode}, {robot}   "
        f"round trip {shown(report.round_trip_ms, 'd')} ms",
        end="",
        flush=True,
    )
