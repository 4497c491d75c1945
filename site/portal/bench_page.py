"""The page of the bench. It compares the cycle times in the paper's four scenarios: the values in
the paper, and the values measured with this firmware."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from portal.plots import HEIGHT, Axis, Drawing, Line, Mark, Tick, axis, path
from portal.portal import Portal
from traceability.reading import bench_record
from traceability.reading.bench_record import (
    FOLDER,
    MANUAL,
    SCENARIOS,
    SHARE,
    SLOW,
    TIMINGS,
    Paper,
    measured_orders,
)
from traceability.reading.published import LOADS
from traceability.schema import HOST, BenchRun, Curve

Runs = Mapping[str, BenchRun]  # key: name of the timing model of the virtual K64, or "board"

BIN_US = 20
GROUP = 4  # number of cycles that are combined into a single point of a band
TOP = 12  # number of modules that the page lists for each scenario
CLASSES = {MANUAL: "measured host", SLOW: "measured board", "board": "truth host"}
WORDS = {**TIMINGS, "board": "a board"}


def bench(portal: Portal) -> dict[str, Any]:
    measured = portal.model.bench or {}
    runs = {name: scenario.runs for name, scenario in measured.items()}
    return {
        "proof": portal.model.times,
        "loads": portal.model.campaigns.get(LOADS),
        "record": bench_record,
        "runs": runs,
        "profiles": {name: scenario.profile for name, scenario in measured.items()},
        "target": target,
        "top": TOP,
        "comparison": comparison(runs),
        "longest": longest(runs),
        "bands": {name: bands(run) for name, run in runs.items()},
        "set_points": {name: set_points(portal, name) for name in runs},
        "wide": True,
        "distributions": {name: distribution(run) for name, run in runs.items()},
        "board": any("board" in run for run in runs.values()),
    }


def target(paper: Paper, run: Runs, kind: str) -> tuple[float, float]:
    """Returns two values: the target [ms] for the cycle time, and the ratio of the measured time to
    this target. The time is measured with the model of the slow flash."""
    most = (paper.average if kind == "average" else paper.maximum) / SHARE
    return round(most, 3), round(getattr(run[SLOW].report_ms, kind) / most, 2)


@dataclass
class Range:
    """The cycle times of a scenario: the average and the maximum [ms], and the positions of both on
    the axis [per cent]."""

    words: str
    kind: str
    average: float
    maximum: float
    first: float
    last: float


def longest(runs: Mapping[str, Runs]) -> dict[str, float]:
    """For each timing model, returns the longest time of all scenarios [ms]. The time is from a
    clock pulse to its report."""
    times = [
        (name, entry.report_ms.maximum) for run in runs.values() for name, entry in run.items()
    ]
    return {name: max(value for key, value in times if key == name) for name, _ in times}


def comparison(runs: Mapping[str, Runs]) -> dict[str, Any]:
    """For each scenario, returns the range of the paper and the measured ranges of this firmware.
    All ranges have the same axis."""
    x = axis(0.0, max(paper.maximum for paper in SCENARIOS), rounded=True)

    def shown(words: str, kind: str, average: float, maximum: float) -> Range:
        return Range(words, kind, average, maximum, x.place(average), x.place(maximum))

    rows = {
        paper.name: [
            shown("the paper", "paper", paper.average, paper.maximum),
            *(
                shown(WORDS[name], kind, run.report_ms.average, run.report_ms.maximum)
                for name, kind in ((MANUAL, "fast"), (SLOW, "slow"), ("board", "board"))
                if (run := runs.get(paper.name, {}).get(name))
            ),
        ]
        for paper in SCENARIOS
    }
    return {"ticks": x.ticks, "rows": rows}


def bands(run: Runs) -> Drawing:
    """Returns the drawing of the cycle times. Each point combines GROUP cycles: a line shows their
    mean, and a band reaches from their minimum to their maximum."""
    times = {kind: run[kind].times_us for kind in CLASSES if kind in run}
    count = max(len(values) for values in times.values())
    x = axis(0.0, float(count), rounded=False)
    y = axis(0.0, max(max(values) for values in times.values()) / 1000, rounded=True)
    lines = []
    for kind, values in times.items():
        parts = {at: values[at : at + GROUP] for at in range(0, len(values), GROUP)}
        style = "board" if kind == SLOW else "host"
        high = [point(x, at, y, max(part)) for at, part in parts.items()]
        low = [point(x, at, y, min(part)) for at, part in parts.items()]
        mean = [point(x, at, y, sum(part) / len(part)) for at, part in parts.items()]
        lines.append(Line(f"band {style}", "", f"M{'L'.join([*high, *reversed(low)])}Z"))
        lines.append(Line(f"truth {style} thin", WORDS[kind], f"M{'L'.join(mean)}"))
    words = "; ".join(f"{WORDS[kind]}: up to {max(micros)} us" for kind, micros in times.items())
    most, at = max((max(own), own.index(max(own))) for own in times.values())
    mark = Mark(f"maximum {most / 1000:.3f}", x.place(at), y.place(most / 1000))
    return Drawing("Time of the cycle", "ms", x.ticks, y.ticks, lines, words, [mark])


def set_points(portal: Portal, name: str) -> list[Drawing]:
    """Returns the drawings for the measured cycles: the set-points of the wheels, and the
    set-points of the steering. A quantity whose set-points are all zero has no drawing."""
    file = portal.root / FOLDER / f"{name}.scenario"
    orders = measured_orders(file.read_text(encoding="utf-8")) if file.is_file() else []
    quantities = {
        ("Set-point of the wheels", "rpm"): [order.velocity for order in orders],
        ("Set-point of the steering", "degrees"): [order.steering for order in orders],
    }
    return [steps(*title, values) for title, values in quantities.items() if any(values)]


def steps(title: str, unit: str, values: list[float]) -> Drawing:
    """Returns the drawing of a curve with steps. There is one value for each cycle; the curve keeps
    a value until the next value."""
    x = axis(0.0, float(len(values)), rounded=False)
    low, high = min(0.0, *values), max(values)
    y = Axis(low, high, [])
    y.ticks = [Tick(f"{value:g}", y.place(value)) for value in sorted({low, 0.0, high})]
    changes = [
        (float(at), value) for at, value in enumerate(values) if not at or value != values[at - 1]
    ]
    curve = Curve("set_point", HOST, [*changes, (float(len(values)), values[-1])])
    line = Line("set-point", "", path(curve, x, y))
    words = f"{title}: {len(changes)} values from {low:g} to {high:g} {unit}"
    return Drawing(title, unit, [], y.ticks, [line], words)


def point(x: Axis, cycle: int, y: Axis, time_us: float) -> str:
    return f"{x.across(cycle):.1f} {y.down(time_us / 1000):.1f}"


def distribution(run: Runs) -> Drawing:
    """Returns a histogram of the cycle times, in steps of 20 us."""
    times = {kind: run[kind].times_us for kind in CLASSES if kind in run}
    bins = {kind: Counter(time // BIN_US for time in values) for kind, values in times.items()}
    most = max(max(counts) for counts in bins.values()) + 1
    x = axis(0.0, most * BIN_US / 1000, rounded=True)
    y = axis(0.0, float(max(max(counts.values()) for counts in bins.values())), rounded=True)
    lines = [
        Line(CLASSES[kind], WORDS[kind], outline(counts, x, y)) for kind, counts in bins.items()
    ]
    words = "; ".join(
        f"{WORDS[kind]}: {min(values)} to {max(values)} us" for kind, values in times.items()
    )
    return Drawing("Cycles by their time", "cycles in 20 us", x.ticks, y.ticks, lines, words)


def outline(counts: Counter[int], x: Axis, y: Axis) -> str:
    """Returns the SVG path of the outline of a histogram."""
    parts: list[str] = []
    for number in range(min(counts), max(counts) + 1):
        left, right = (x.across(edge * BIN_US / 1000) for edge in (number, number + 1))
        begin = "V" if parts else f"M{left:.1f} {HEIGHT}V"
        parts.append(f"{begin}{y.down(counts[number]):.1f}H{right:.1f}")
    return "".join([*parts, f"V{HEIGHT}"])
