"""./wr plot: draws a recording of reports as curves."""

from __future__ import annotations

import argparse
from pathlib import Path

from portal.recording_page import RecordingError, recording_page
from tools.steps import MissingError, UsageError, need_file


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "plot",
        description="Draws a recording: the steering, the changes of the states, and for each "
        "wheel the velocity, the voltage, the current and the set-points. The result is one "
        "HTML file that needs no other file. A recording is a CSV or MCAP file of ./wr "
        "drive and ./wr monitor, or a table of ./wr sim --reports.",
    )
    parser.add_argument("recording", type=Path, metavar="RECORDING", help="a CSV or MCAP file")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="file of the page (default: next to the recording)"
    )
    parser.set_defaults(run=lambda _root, options: plot(options.recording, options.out))


def plot(recording: Path, out: Path | None) -> int:
    need_file(recording, "make a recording with ./wr monitor --mcap FILE")
    page = out or recording.with_suffix(".html")
    try:
        text = recording_page(recording)
    except (RecordingError, KeyError, ValueError) as error:
        raise UsageError(f"cannot draw {recording}: {error}") from error
    try:
        page.write_text(text, encoding="utf-8")
    except OSError as error:
        said = f"cannot write {page}: {error.strerror}; name another file with --out"
        raise MissingError(said) from error
    print(page)
    return 0
