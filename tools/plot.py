"""./wr plot: a recording of reports as curves."""

from __future__ import annotations

import argparse
from pathlib import Path

from portal.recording_page import RecordingError, recording_page
from tools.steps import FailureError


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "plot",
        description="Draws a recording: velocity, voltage and current of each wheel with their "
        "set-points, the steering, and the changes of the states. The result is one HTML file, "
        "which needs no other file. Recordings are the CSV and MCAP files of ./wr drive and "
        "./wr monitor, and the tables of ./wr sim --reports.",
    )
    parser.add_argument("recording", type=Path, metavar="RECORDING", help="a CSV or MCAP file")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="the page (default: next to the recording)"
    )
    parser.set_defaults(run=lambda _root, options: plot(options.recording, options.out))


def plot(recording: Path, out: Path | None) -> int:
    page = out or recording.with_suffix(".html")
    try:
        page.write_text(recording_page(recording), encoding="utf-8")
    except (OSError, RecordingError, KeyError) as error:
        raise FailureError(f"cannot draw {recording}: {error}") from error
    print(page)
    return 0
