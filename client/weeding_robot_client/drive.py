"""Drives the robot from the keyboard or from a file."""

from __future__ import annotations

import argparse
import itertools
import os
import select
import sys
import termios
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from weeding_robot_client.link import Link
from weeding_robot_client.messages import Order, Quantity, Report, Welcome
from weeding_robot_client.monitor import as_line, faults, status
from weeding_robot_client.options import add_link, open_link
from weeding_robot_client.recording import Recording
from weeding_robot_client.script import HELP, Script, ScriptError, Wish, load

KEYS_HELP = """\
Keys:
  up, w     10 rpm faster          left, a    1 degree to the left
  down, s   10 rpm slower          right, d   1 degree to the right
  space     stop: halts the wheels and holds the steering, in every mode
  r         release the stop       0          velocity and steering to 0
  q         quit: orders velocity 0, keeps a stop"""
DESCRIPTION = f"""\
Sends orders to the robot, every 100 ms, because an order lives for 200 ms. Without --script the
keyboard drives. A stop that is already in force stays until it is released.

{KEYS_HELP}"""
EPILOG = HELP

ORDER_EVERY_S = 0.1
CONNECT_WITHIN_S = 5.0
VELOCITY_STEP_RPM = 10.0
STEERING_STEP_DEGREES = 1.0
ESCAPES = {b"\x1b[A": b"w", b"\x1b[B": b"s", b"\x1b[C": b"d", b"\x1b[D": b"a"}
ESCAPES |= {b"\x1bO" + code[-1:]: key for code, key in ESCAPES.items()}


def add_options(parser: argparse.ArgumentParser) -> None:
    add_link(parser)
    parser.add_argument("--script", type=Path, metavar="FILE", help="drive from this file")


def run(options: argparse.Namespace) -> int:
    script = None
    if options.script:
        try:
            script = load(options.script)
        except (OSError, ScriptError) as error:
            print(error, file=sys.stderr)
            return 2
    elif not sys.stdin.isatty():
        print("the keyboard needs a terminal; give a file with --script", file=sys.stderr)
        return 2
    link = open_link(options.link)
    if link is None:
        return 1
    with link, Recording(options.csv) as recording:
        return follow(link, script, recording) if script else by_keyboard(link, recording)


def order_ids() -> Iterator[int]:
    """1 to 65535, again and again; 0 stands for orders of the remote control."""
    return itertools.cycle(range(1, 0x10000))


def follow(link: Link, script: Script, recording: Recording) -> int:
    """Drives by the script; ends with an error when there is no connection or it is lost."""
    if not connect(link, recording):
        print(f"no answer on {link.path}", file=sys.stderr)
        return 1
    print(status(link), file=sys.stderr)
    ids = order_ids()
    start = next_order = time.monotonic()
    while (now := time.monotonic()) < start + script.end_s:
        if now >= next_order:
            next_order += ORDER_EVERY_S
            wish = script.at(now - start)
            if wish is not None:
                link.send(wish.order(next(ids)))
        for report in link.service(max(0.0, min(next_order - time.monotonic(), ORDER_EVERY_S))):
            recording.add(report)
            print(as_line(report), flush=True)
        if not link.connected:
            print("the connection was lost", file=sys.stderr)
            return 1
    halt(link, script.at(script.end_s) or Wish(), next(ids))
    return 0


def connect(link: Link, recording: Recording) -> Report | None:
    """The first report, or None when none came in time."""
    for report in link.reports(CONNECT_WITHIN_S):
        recording.add(report)
        return report
    return None


def halt(link: Link, wish: Wish, order_id: int) -> None:
    """The last order: velocity 0; a stop stays."""
    link.send(replace(wish, quantity=Quantity.VELOCITY, value=0.0).order(order_id))
    link.service()


@contextmanager
def raw_keys(keyboard: int) -> Iterator[None]:
    """Keys at once and unseen, while Ctrl-C still interrupts."""
    before = termios.tcgetattr(keyboard)
    try:
        tty.setcbreak(keyboard)
        yield
    finally:
        termios.tcsetattr(keyboard, termios.TCSADRAIN, before)


def keys(data: bytes) -> Iterator[bytes]:
    """Single keys; arrows become letters."""
    while data:
        if data[:3] in ESCAPES:
            yield ESCAPES[data[:3]]
            data = data[3:]
        else:
            yield data[:1].lower()
            data = data[1:]


def pressed(wish: Wish, key: bytes) -> Wish:
    """The wish after a key; a value stays within the range of the protocol."""
    limit = Quantity.VELOCITY.limit
    if key in (b"w", b"s"):
        step = VELOCITY_STEP_RPM if key == b"w" else -VELOCITY_STEP_RPM
        return replace(wish, value=min(limit, max(-limit, wish.value + step)))
    if key in (b"a", b"d"):
        step = STEERING_STEP_DEGREES if key == b"a" else -STEERING_STEP_DEGREES
        angle = wish.steering_degrees + step
        most = Order.steering_limit_degrees
        return replace(wish, steering_degrees=min(most, max(-most, angle)))
    if key == b" ":
        return replace(wish, value=0.0, stop=True)
    if key == b"r":
        return replace(wish, value=0.0, stop=False)
    if key == b"0":
        return replace(wish, value=0.0, steering_degrees=0.0)
    return wish


def by_keyboard(link: Link, recording: Recording) -> int:
    keyboard = sys.stdin.fileno()
    print(KEYS_HELP)
    ids = order_ids()
    wish: Wish | None = None
    told: Welcome | None = None
    known: list[str] = []
    next_order = time.monotonic()
    with raw_keys(keyboard):
        try:
            while True:
                if select.select([keyboard], [], [], 0)[0]:
                    data = os.read(keyboard, 64)
                    for key in keys(data):
                        if key == b"q":
                            return 0
                        wish = pressed(wish, key) if wish else None
                    if not data:
                        return 0
                if wish and time.monotonic() >= next_order:
                    next_order = time.monotonic() + ORDER_EVERY_S
                    link.send(wish.order(next(ids)))
                for report in link.service(0.02):
                    recording.add(report)
                    wish = wish or Wish(stop=report.stop)
                    told = tell_fault(link, told)
                    known = tell_changes(report, known)
                    show(wish, report)
                if not link.connected:
                    wish = None
                    print(f"\r\x1b[Kno connection on {link.path}, trying", end="", flush=True)
        finally:
            if wish:
                halt(link, wish, next(ids))
            print()


def tell_fault(link: Link, told: Welcome | None) -> Welcome | None:
    """Shows the fault before the last start once for each connection; returns its Welcome."""
    welcome = link.welcome
    if welcome and welcome is not told and welcome.start.faulted:
        print(f"\r\x1b[Klast reset: {welcome.start}", flush=True)
    return welcome


def tell_changes(report: Report, known: list[str]) -> list[str]:
    """Shows each fault of the robot once when it begins and when it ended; returns all of now."""
    now = faults(report)
    for fault in now:
        if fault not in known:
            print(f"\r\x1b[K{fault}", flush=True)
    for fault in known:
        if fault not in now:
            print(f"\r\x1b[Kno longer: {fault}", flush=True)
    return now


def show(wish: Wish, report: Report) -> None:
    stop = "STOP (r releases)" if wish.stop else f"{wish.value:+.0f} rpm"
    print(
        f"\r\x1b[Kordered: {stop}, {wish.steering_degrees:+.0f} deg   robot: {report.state}, "
        f"mode {report.mode}, {'held' if report.held else 'moving by its set-points'}",
        end="",
        flush=True,
    )
