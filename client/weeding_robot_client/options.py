"""The common options of the client's commands."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from weeding_robot_client.capture import Capture, write_dissector
from weeding_robot_client.exit_codes import BUSY, MISSING
from weeding_robot_client.link import BusyError, Link
from weeding_robot_client.recording import Recording
from weeding_robot_client.script import ScriptError, wheel_number

DEFAULT_LINK = Path(__file__).resolve().parents[2] / "build" / "pc-link"
DISSECTOR = DEFAULT_LINK.with_name("weeding_robot.lua")


def add_link(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--link",
        type=Path,
        default=DEFAULT_LINK,
        metavar="PATH",
        help="serial port, or the path that ./wr sim printed (default: build/pc-link)",
    )
    parser.add_argument(
        "--csv", type=Path, metavar="FILE", help="write each report to this file, in CSV"
    )
    parser.add_argument(
        "--mcap", type=Path, metavar="FILE", help="write each report to this file, in MCAP"
    )
    parser.add_argument(
        "--capture", type=Path, metavar="FILE", help="write each frame to this file, for Wireshark"
    )


def positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{number} is less than 1")
    return number


def wheel(text: str) -> int:
    try:
        return wheel_number(text)
    except ScriptError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


@contextmanager
def opened(options: argparse.Namespace) -> Iterator[tuple[Link, Recording]]:
    """Opens the files and the link of a command. If this fails, prints the reason and exits."""
    recording = open_recording(options)
    capture = open_capture(options.capture)
    if recording is None or capture is None:
        sys.exit(MISSING)
    link = open_link(options.link)
    if isinstance(link, int):
        sys.exit(link)
    with link, recording, capture as link.capture:
        yield link, recording


def open_link(path: Path) -> Link | int:
    """Returns the link. If it cannot be opened, prints the reason and returns the exit code."""
    try:
        return Link(path)
    except BusyError:
        print(f"{path} is in use: another program drives or monitors the robot.", file=sys.stderr)
        print("End that program, and try again.", file=sys.stderr)
        return BUSY
    except OSError as error:
        print(f"cannot open {path}: {error.strerror or error}", file=sys.stderr)
        print("Run ./wr sim in another terminal, or name a port with --link.", file=sys.stderr)
        return MISSING


def open_recording(options: argparse.Namespace) -> Recording | None:
    """Returns the recording. If it cannot be opened, prints the reason and returns None."""
    try:
        return Recording(options.csv, options.mcap)
    except OSError as error:
        print(
            f"cannot write {error.filename}: {error.strerror}. Name another file.", file=sys.stderr
        )
        return None


def open_capture(path: Path | None) -> Capture | None:
    """Returns the capture. If it cannot be opened, prints the reason and returns None."""
    try:
        capture = Capture(path)
        if path is not None:
            write_dissector(DISSECTOR)
    except OSError as error:
        print(f"cannot write {path}: {error.strerror}. Name another file.", file=sys.stderr)
        return None
    if path is not None:
        print(f"Show it with: wireshark -X lua_script:{DISSECTOR} {path}", file=sys.stderr)
    return capture
