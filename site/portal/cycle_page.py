"""The page that shows a control cycle as a timeline. Each lane of the timeline shows the calls
at one priority."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

from markupsafe import Markup

from portal.portal import Portal
from portal.recorded_calls import (
    COMMAND,
    NOT_ENTERED,
    PULSE,
    links_of,
    name_of,
    recordings_of,
    requirements_by_method,
    shown_time,
    windows_of,
)
from traceability.reading.call_record import Activation, Recording

RECORDING = "drive"
WIDTH = 1000  # sizes in units of the drawing
LANE, ROW = 26, 12
LEAST = 0.6  # minimum width of a bar of a lane
SHOWN = 2.0  # minimum width of a call in the static drawing; shorter calls are left out
MAIN_THREAD = "mainThreadInterrupt"


@dataclass
class Lane:
    """A priority, the interrupts and threads with this priority, and the times at which they
    run."""

    priority: int | None
    names: list[str] = field(default_factory=list)
    entries: int = 0
    busy: int = 0  # execution time at this priority, without interrupts of higher priority [ns]
    path: str = ""

    @property
    def title(self) -> str:
        return NOT_ENTERED if self.priority is None else f"priority {self.priority}"


@dataclass
class Bar:
    """A call in the static drawing. The drawing ends at the end of the main thread."""

    x: float
    y: int
    width: float
    method: str
    href: str | None
    lane: int


@dataclass
class Cycle:
    """A recorded cycle, from one clock pulse to the next [ns]."""

    recording: Recording
    begin: int
    end: int

    def spans(self) -> list[int]:
        spans = self.recording.spans
        first = self.recording.activations
        return [
            number
            for number, span in enumerate(spans)
            if span.begin < self.end
            and span.end > self.begin
            and (first[span.activation].line < 0 or span.begin >= self.begin)
        ]


def find_cycle(recording: Recording) -> Cycle | None:
    """Returns the first cycle that was recorded from its beginning to its end. A cycle begins when
    the cycle timer requests its interrupt."""
    entered = [span.activation for span in recording.spans if span.method == PULSE]
    pulses = [recording.activations[number].raised for number in entered]
    return next((Cycle(recording, begin, end) for begin, end in pairwise(pulses)), None)


def cycle(portal: Portal) -> dict[str, Any]:
    recordings = recordings_of(portal)
    first_cycle = (
        find_cycle(recordings[RECORDING]) if recordings and RECORDING in recordings else None
    )
    window = windows_of(portal).get(RECORDING)
    values = {"window": window, "command": COMMAND, "time": shown_time, "wide": True}
    if first_cycle is None:
        return {**values, "cycle": None}
    lanes = lanes_of(portal, first_cycle)
    first, last = report_time(first_cycle)
    bars = bars_of(portal, first_cycle, lanes, first, last)
    return {
        **values,
        "cycle": first_cycle,
        "lanes": lanes,
        "lane_height": LANE,
        "row_height": ROW,
        "width": WIDTH,
        "bars": bars,
        "bars_height": max((bar.y for bar in bars), default=0) + ROW,
        "bars_from": first,
        "bars_to": last,
        "data": Markup(json.dumps(data_of(portal, first_cycle), separators=(",", ":"))),
    }


def lanes_of(portal: Portal, shown_cycle: Cycle) -> list[Lane]:
    """Returns the lanes: the highest priority first, and the idle program last."""
    lanes: dict[int | None, Lane] = {}
    inside = [
        a
        for a in shown_cycle.recording.activations
        if a.begin < shown_cycle.end and a.end > shown_cycle.begin
    ]
    for activation in inside:
        lane = lanes.setdefault(activation.priority, Lane(activation.priority))
        name = name_of(portal, activation)
        if name not in lane.names:
            lane.names.append(name)
        lane.entries += 1
    busy = busy_times(inside, shown_cycle)
    for priority, lane in lanes.items():
        lane.busy = busy[priority]
        lane.path = path_of((a for a in inside if a.priority == priority), shown_cycle)
    return sorted(lanes.values(), key=lambda lane: (lane.priority is None, lane.priority or 0))


def busy_times(activations: Iterable[Activation], shown_cycle: Cycle) -> dict[int | None, int]:
    """Returns the execution time at each priority [ns], without the interrupts of higher
    priority."""
    times: dict[int | None, int] = {}
    for activation in activations:
        length = min(activation.end, shown_cycle.end) - max(activation.begin, shown_cycle.begin)
        times[activation.priority] = times.get(activation.priority, 0) + length
        if activation.below >= 0:
            below = shown_cycle.recording.activations[activation.below].priority
            times[below] = times.get(below, 0) - length
    return times


def path_of(activations: Iterable[Activation], shown_cycle: Cycle) -> str:
    """Returns an SVG path with a bar for each activation. Bars that touch are joined."""
    scale = WIDTH / (shown_cycle.end - shown_cycle.begin)
    bars: list[tuple[float, float]] = []
    for activation in activations:
        x = max(0.0, (activation.begin - shown_cycle.begin) * scale)
        end = min(float(WIDTH), max(x + LEAST, (activation.end - shown_cycle.begin) * scale))
        if bars and x <= bars[-1][1]:
            bars[-1] = bars[-1][0], max(end, bars[-1][1])
        else:
            bars.append((x, end))
    return "".join(f"M{x:.1f} 4h{end - x:.1f}v{LANE - 8}h{x - end:.1f}z" for x, end in bars)


def report_time(shown_cycle: Cycle) -> tuple[int, int]:
    """Returns the times at which the clock pulse occurs and the main thread ends [ns]."""
    activations = shown_cycle.recording.activations
    end = next(
        (
            activations[span.activation].end
            for span in shown_cycle.recording.spans
            if span.method == MAIN_THREAD and shown_cycle.begin <= span.begin < shown_cycle.end
        ),
        shown_cycle.end,
    )
    return shown_cycle.begin, end


def bars_of(
    portal: Portal, shown_cycle: Cycle, lanes: list[Lane], first: int, last: int
) -> list[Bar]:
    """Returns the bars of the calls from the clock pulse to the end of the main thread. Short calls
    have no bar: see SHOWN. Each bar is one row below the bar of the caller."""
    scale = WIDTH / (last - first)
    activations = shown_cycle.recording.activations
    chosen = [
        span
        for span in (shown_cycle.recording.spans[number] for number in shown_cycle.spans())
        if first <= span.begin < last
        and (span.end - span.begin) * scale >= SHOWN
        and activations[span.activation].priority is not None
    ]
    order = [lane.priority for lane in lanes]
    rows: dict[int, int] = {}
    for span in chosen:
        lane = order.index(activations[span.activation].priority)
        rows[lane] = max(rows.get(lane, 0), span.depth + 1)
    tops, top = {}, 0
    for lane in sorted(rows):
        tops[lane] = top
        top += rows[lane] * ROW + ROW
    bars = []
    for span in chosen:
        lane = order.index(activations[span.activation].priority)
        method = portal.links.find_method(span.method)
        href = portal.links.source(method.body or method.place) if method else None
        x, width = (span.begin - first) * scale, (span.end - span.begin) * scale
        bars.append(Bar(x, tops[lane] + span.depth * ROW, width, span.method, href, lane))
    return bars


def data_of(portal: Portal, shown_cycle: Cycle) -> dict[str, Any]:
    """Returns the calls of the cycle for the script timeline.js: a list for each property, with an
    entry for each call. Times are in ns since the clock pulse."""
    recording = shown_cycle.recording
    numbers = shown_cycle.spans()
    spans = [recording.spans[number] for number in numbers]
    place = {number: index for index, number in enumerate(numbers)}
    trees = requirements_by_method(portal)
    names = list(dict.fromkeys(span.method for span in spans))
    index = {name: number for number, name in enumerate(names)}
    used = list(dict.fromkeys(span.activation for span in spans))
    active = {number: index for index, number in enumerate(used)}
    begins = [0, *(max(0, span.begin - shown_cycle.begin) for span in spans)]
    links = [links_of(portal, name, trees) for name in names]
    return {
        "length": shown_cycle.end - shown_cycle.begin,
        "methods": [[link.name, link.page, link.source, link.requirements] for link in links],
        "activations": [
            [
                name_of(portal, activation),
                activation.priority,
                activation.raised - shown_cycle.begin,
                activation.begin - shown_cycle.begin,
                activation.end - shown_cycle.begin,
            ]
            for activation in (recording.activations[number] for number in used)
        ],
        "begins": [after - before for before, after in pairwise(begins)],
        "lengths": [
            min(span.end, shown_cycle.end) - max(span.begin, shown_cycle.begin) for span in spans
        ],
        "of": [index[span.method] for span in spans],
        "depths": [span.depth for span in spans],
        "in": [active[span.activation] for span in spans],
        "parents": [place.get(span.parent, -1) for span in spans],
    }
