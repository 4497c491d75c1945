"""Plays parts of scenarios on the virtual board, and records each call with its time."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TextIO

from tools.cmake_build import board_words
from tools.steps import FailureError, run
from traceability.reading.call_record import (
    ELF,
    IMAGE,
    RECORD,
    Recording,
    Window,
    declared_recordings,
    packed,
    recording_of,
    reduced,
)
from traceability.reading.chains import declared_chains, first_missing, follow
from traceability.reading.traces import read_symbols
from traceability.whole_file import write_whole

SECONDS = 300  # time limit of a scenario
NAMES = "arm-none-eabi-nm"


def record_all(root: Path, log: TextIO) -> str:
    """Records the calls in each time window for which the design declares a recording."""
    folder = root / "build" / "calls"
    folder.mkdir(parents=True, exist_ok=True)
    symbols = read_symbols(root / ELF, NAMES, folder / "symbols.pickle")
    recordings: dict[str, Recording] = {}
    for window in declared_recordings(root):
        lines = play(root, window, folder / f"{window.name}.csv", log)
        with lines.open(encoding="utf-8") as file:
            recordings[window.name] = reduced(recording_of(file, symbols), window.without)
        lines.unlink()
        if not recordings[window.name].spans:
            raise FailureError(
                f"{window.place.file}:{window.place.line}: the recording {window.name} has no call"
            )
    for chain in declared_chains(root):
        recording = recordings[chain.recording]
        if follow(chain, recording) is None:
            place = f"{chain.place.file}:{chain.place.line}"
            raise FailureError(
                f"{place}: the recording {chain.recording} has no step "
                f"{first_missing(chain, recording)!r} after the previous steps"
            )
    content = {"recordings": {name: packed(recording) for name, recording in recordings.items()}}
    write_whole(root / RECORD, json.dumps(content, separators=(",", ":")))
    calls = sum(len(recording.spans) for recording in recordings.values())
    return f"{len(recordings)} parts of scenarios, {calls} calls"


def play(root: Path, window: Window, output: Path, log: TextIO) -> Path:
    """Plays a scenario, and records the events in a time window. Returns the file, which has one
    event in each line."""
    output.unlink(missing_ok=True)
    words = [
        *(*board_words(root, IMAGE), "--scenario", str(root / window.file)),
        *("--calls", str(output), "--between", str(window.begin), str(window.end)),
    ]
    run(log, ["timeout", str(SECONDS), *words])
    return output
