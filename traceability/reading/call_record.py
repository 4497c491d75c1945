"""Recordings of the calls that the firmware image makes on the virtual board, with the times of the
calls."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from traceability.reading.products import DEFAULT, recorded_image_of
from traceability.reading.results import RESULTS, read_fresh
from traceability.reading.task_record import CALLS
from traceability.reading.toml_reader import Entries
from traceability.schema import Place

DECLARED = Path("design/recordings.toml")
SCENARIOS = Path("sim/scenario")
RECORD = RESULTS / "calls.json"
IMAGE, ELF = (recorded_image_of(DEFAULT, suffix) for suffix in (".bin", ".elf"))
FIRST_LINE = 16  # number of the exception of interrupt line 0
BYTE_RECEIVED = "byte_received"
KEPT_EVENTS = (BYTE_RECEIVED, "byte_sent", "pwm_changed")


@dataclass(frozen=True)
class Window:
    """The part of a scenario in which calls are recorded. ``begin`` and ``end`` are in ms since
    power-on."""

    name: str
    scenario: str
    begin: int
    end: int
    without: Sequence[str]  # interrupt handlers whose calls are left out
    place: Place

    @property
    def file(self) -> str:
        return str(SCENARIOS / f"{self.scenario}.scenario")


@dataclass
class Activation:
    """One execution of an interrupt or a thread, from its start to its end. The first activation of
    a recording is the program outside interrupts."""

    exception: int
    priority: int | None  # None for the program outside interrupts and for exceptions of the core
    # time of the interrupt request [ns]; the time of the entry if no request was recorded
    raised: int
    begin: int
    end: int
    below: int  # number of the interrupted activation; -1 if no activation was interrupted

    @property
    def line(self) -> int:
        """Returns the number of the interrupt line. The number is negative for exceptions of the
        core and for the program outside interrupts."""
        return self.exception - FIRST_LINE


@dataclass
class Span:
    """A call of a method or function, with the times of its start and end [ns]."""

    method: str
    begin: int
    end: int
    depth: int  # number of recorded calls in the same activation that enclose this call
    activation: int
    parent: int  # number of the enclosing call in the same activation; -1 without such a call


@dataclass(frozen=True)
class BoardEvent:
    at: int
    kind: str
    number: int
    value: int


@dataclass
class Recording:
    """The calls that were recorded in a window, in the order in which they began."""

    activations: list[Activation] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    events: list[BoardEvent] = field(default_factory=list)

    def pulses(self, line: int) -> list[int]:
        """Returns the times of the requests on an interrupt line. Requests that did not start the
        handler are left out."""
        return [activation.raised for activation in self.activations if activation.line == line]


def declared_recordings(root: Path, entries: Entries | None = None) -> list[Window]:
    keys = {"begin": "from", "end": "to"}
    entries = entries or Entries(root)
    return entries.records(root / DECLARED, "recording", Window, "name", may=["without"], keys=keys)


def read_recordings(root: Path) -> dict[str, Recording] | None:
    """Returns the recordings by name. Returns None if no recordings of the present sources
    exist."""
    content = read_fresh(root, RECORD, CALLS)
    if content is None:
        return None
    return {name: unpacked(recording) for name, recording in content["recordings"].items()}


# ---- from the lines of the board program -------------------------------------


class _Reader:
    """A reader that makes a recording from the events of the board program. It assigns each call to
    its activation and to its enclosing call."""

    def __init__(self, symbols: Mapping[int, str]) -> None:
        self.symbols = symbols
        self.found = Recording()
        self.active: list[int] = []
        # activation -> the calls that have not returned. Each call has its address and the number
        # of its span; the number is -1 if the call has no span.
        self.open: dict[int, list[tuple[int, int]]] = {}
        self.raised: dict[int, int] = {}
        # number of return events that are ignored next, because their calls were already closed at
        # the end of the activation
        self.closing = 0

    def take(self, at: int, event: str, number: int, value: int) -> None:
        if event == "call":
            self._call(at, number)
        elif event == "return":
            self._return(at, number)
        elif event == "exception_entered":
            self.enter(at, number, value if number >= FIRST_LINE else None)
        elif event == "exception_left":
            self._leave(at, number)
        elif event == "line_raised":
            self.raised.setdefault(number, at)
        elif event in KEPT_EVENTS:
            self.found.events.append(BoardEvent(at, event, number, value))

    def finish(self, at: int) -> Recording:
        for number in self.active:
            self._close(number, at)
        return self.found

    def _close(self, number: int, at: int) -> None:
        self.found.activations[number].end = at
        for _, span in self.open[number]:
            if span >= 0:
                self.found.spans[span].end = at

    def enter(self, at: int, exception: int, priority: int | None) -> None:
        self.closing = 0
        raised = self.raised.pop(exception, at)
        below = self.active[-1] if self.active else -1
        self.active.append(len(self.found.activations))
        self.open[self.active[-1]] = []
        self.found.activations.append(Activation(exception, priority, raised, at, at, below))

    def _leave(self, at: int, exception: int) -> None:
        number = self.active[-1]
        if self.found.activations[number].exception != exception or number == 0:
            return  # The interrupt began before the recorded window.
        self._close(number, at)
        self.active.pop()
        self.closing = len(self.open.pop(number))

    def _call(self, at: int, address: int) -> None:
        number = self.active[-1]
        calls = self.open[number]
        name = self.symbols.get(address, "")
        shown = "::" in name or (number > 0 and not calls and bool(name))
        if shown:
            around = [span for _, span in calls if span >= 0]
            parent = around[-1] if around else -1
            self.found.spans.append(Span(name, at, at, len(around), number, parent))
        calls.append((address, len(self.found.spans) - 1 if shown else -1))

    def _return(self, at: int, address: int) -> None:
        if self.closing:
            self.closing -= 1
            return
        calls = self.open[self.active[-1]]
        if calls and calls[-1][0] == address:
            _, span = calls.pop()
            if span >= 0:
                self.found.spans[span].end = at


def recording_of(lines: Iterable[str], symbols: Mapping[int, str]) -> Recording:
    """Returns the recording from the text lines that the board program wrote. The first text line
    contains the names of the columns."""
    reader, at = _Reader(symbols), 0
    for line in lines:
        time, event, number, value = line.strip().split(",")
        if not time.isdigit():
            continue
        at = int(time)
        if not reader.active:
            reader.enter(at, 0, None)
        reader.take(at, event, int(number), int(value))
    return reader.finish(at)


def reduced(recording: Recording, handlers: Iterable[str]) -> Recording:
    """Returns a copy of the recording without the activations of these interrupt handlers."""
    dropped = {
        span.activation for span in recording.spans if span.depth == 0 and span.method in handlers
    }
    numbers = [number for number in range(len(recording.activations)) if number not in dropped]
    place = {-1: -1, **{number: index for index, number in enumerate(numbers)}}
    shorter = Recording(events=recording.events)
    for number in numbers:
        activation = recording.activations[number]
        below = activation.below
        while below in dropped:
            below = recording.activations[below].below
        shorter.activations.append(replace(activation, below=place[below]))
    moved: dict[int, int] = {-1: -1}
    for number, span in enumerate(recording.spans):
        if span.activation in place:
            moved[number] = len(shorter.spans)
            shorter.spans.append(
                replace(span, activation=place[span.activation], parent=moved[span.parent])
            )
    return shorter


# ---- the record --------------------------------------------------------------


def packed(recording: Recording) -> dict[str, Any]:
    """Returns a recording as columns that need little memory in JSON. The start time of a call is
    stored as the difference to the start time of the previous call. The method is stored as a
    number."""
    names = list(dict.fromkeys(span.method for span in recording.spans))
    numbers = {name: number for number, name in enumerate(names)}
    begins = [0, *(span.begin for span in recording.spans)]
    return {
        "names": names,
        "activations": [list(asdict(activation).values()) for activation in recording.activations],
        "begins": [after - before for before, after in pairwise(begins)],
        "lengths": [span.end - span.begin for span in recording.spans],
        "methods": [numbers[span.method] for span in recording.spans],
        "depths": [span.depth for span in recording.spans],
        "in": [span.activation for span in recording.spans],
        "events": [list(asdict(event).values()) for event in recording.events],
    }


def unpacked(content: Mapping[str, Any]) -> Recording:
    recording = Recording(
        [Activation(*columns) for columns in content["activations"]],
        events=[BoardEvent(*columns) for columns in content["events"]],
    )
    at = 0
    # (activation, depth) -> number of the last call at this depth
    last: dict[tuple[int, int], int] = {}
    columns = ("begins", "lengths", "methods", "depths", "in")
    for step, length, method, depth, activation in zip(
        *(content[name] for name in columns), strict=True
    ):
        at += step
        name, parent = content["names"][method], last.get((activation, depth - 1), -1)
        last[activation, depth] = len(recording.spans)
        recording.spans.append(Span(name, at, at + length, depth, activation, parent))
    return recording
