"""The recorded calls of the image on the virtual board, with their times."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from traceability.reading.products import DEFAULT, recorded_image_of
from traceability.reading.results import RESULTS, read_json
from traceability.reading.task_record import CALLS, is_fresh
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
    """A part of a scenario that is recorded. Its times are in ms since power-on."""

    name: str
    scenario: str
    begin: int
    end: int
    without: Sequence[str]  # handlers of interrupts that are not recorded
    place: Place

    @property
    def file(self) -> str:
        return str(SCENARIOS / f"{self.scenario}.scenario")


@dataclass
class Activation:
    """A run of an interrupt or a thread. Number 0 is the program outside of interrupts."""

    exception: int
    priority: int | None  # None if it is not an exception
    raised: int  # time of the request [ns], or of the entry if no request was recorded
    begin: int
    end: int
    below: int  # number of the interrupted activation

    @property
    def line(self) -> int:
        """Returns the line of the interrupt controller. The line is negative for the program
        itself."""
        return self.exception - FIRST_LINE


@dataclass
class Span:
    """A call of a method or function, with its times [ns] and its position among the other
    calls."""

    method: str
    begin: int
    end: int
    depth: int  # depth of calls in the activation
    activation: int
    parent: int  # caller in the same activation; -1 if there is none


@dataclass(frozen=True)
class BoardEvent:
    at: int
    kind: str
    number: int
    value: int


@dataclass
class Recording:
    """The calls of a window, in the order in which they began."""

    activations: list[Activation] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    events: list[BoardEvent] = field(default_factory=list)

    def pulses(self, line: int) -> list[int]:
        """Returns the times at which an interrupt line was raised, if the interrupt was then
        entered."""
        return [activation.raised for activation in self.activations if activation.line == line]

    def between(self, begin: int, end: int) -> Iterator[int]:
        """Yields the calls that begin between two times."""
        for number, span in enumerate(self.spans):
            if begin <= span.begin < end:
                yield number


def declared_recordings(root: Path, entries: Entries | None = None) -> list[Window]:
    keys = {"begin": "from", "end": "to"}
    entries = entries or Entries(root)
    return entries.records(root / DECLARED, "recording", Window, "name", may=["without"], keys=keys)


def read_recordings(root: Path) -> dict[str, Recording] | None:
    """Returns the recordings of the present sources. Returns None if they were not recorded."""
    content = read_json(root / RECORD)
    if not isinstance(content, dict) or not is_fresh(root, CALLS):
        return None
    return {name: unpacked(recording) for name, recording in content["recordings"].items()}


# ---- from the lines of the board program -------------------------------------


class _Reader:
    """Assigns the calls of a file to the activations of interrupts and threads, and nests them."""

    def __init__(self, symbols: Mapping[int, str]) -> None:
        self.symbols = symbols
        self.found = Recording()
        self.active: list[int] = []
        self.open: dict[
            int, list[tuple[int, int]]
        ] = {}  # activation -> (address, number of the span or -1)
        self.raised: dict[int, int] = {}
        self.closing = (
            0  # number of returns that still follow, for calls that ended with their activation
        )

    def begin(self, at: int) -> None:
        self._enter(at, 0, None)

    def take(self, at: int, event: str, number: int, value: int) -> None:
        if event == "call":
            self._call(at, number)
        elif event == "return":
            self._return(at, number)
        elif event == "exception_entered":
            self._enter(at, number, value if number >= FIRST_LINE else None)
        elif event == "exception_left":
            self._leave(at, number)
        elif event == "line_raised":
            self.raised.setdefault(number, at)
        elif event in KEPT_EVENTS:
            self.found.events.append(BoardEvent(at, event, number, value))

    def finish(self, at: int) -> Recording:
        for number in self.active:
            self.found.activations[number].end = at
            for _, span in self.open[number]:
                if span >= 0:
                    self.found.spans[span].end = at
        return self.found

    def _enter(self, at: int, exception: int, priority: int | None) -> None:
        self.closing = 0
        raised = self.raised.pop(exception, at)
        below = self.active[-1] if self.active else -1
        self.active.append(len(self.found.activations))
        self.open[self.active[-1]] = []
        self.found.activations.append(Activation(exception, priority, raised, at, at, below))

    def _leave(self, at: int, exception: int) -> None:
        number = self.active[-1]
        activation = self.found.activations[number]
        if activation.exception != exception or number == 0:
            return  # The interrupt was entered before the window.
        self.active.pop()
        activation.end = at
        self.closing = len(self.open[number])
        for _, span in self.open.pop(number):
            if span >= 0:
                self.found.spans[span].end = at

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
    """Returns the recording in the lines that the board program wrote. The first line is the
    head.
    """
    reader, at = _Reader(symbols), 0
    for line in lines:
        time, event, number, value = line.strip().split(",")
        if not time.isdigit():
            continue
        at = int(time)
        if not reader.active:
            reader.begin(at)
        reader.take(at, event, int(number), int(value))
    return reader.finish(at)


def reduced(recording: Recording, handlers: Iterable[str]) -> Recording:
    """Returns the recording without the activations of these handlers."""
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
    """Returns a recording as small columns. Begins are stored as differences, and methods as
    numbers.
    """
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
    last: dict[tuple[int, int], int] = {}  # activation and depth -> the call that began last
    columns = ("begins", "lengths", "methods", "depths", "in")
    for step, length, method, depth, activation in zip(
        *(content[name] for name in columns), strict=True
    ):
        at += step
        name, parent = content["names"][method], last.get((activation, depth - 1), -1)
        last[activation, depth] = len(recording.spans)
        recording.spans.append(Span(name, at, at + length, depth, activation, parent))
    return recording
