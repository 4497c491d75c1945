"""The page of the bench: the paper's four scenarios, its values and ours."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

from portal.plots import HEIGHT, WIDTH, Axis, Drawing, Line, Tick, axis
from portal.portal import Portal
from traceability.reading import bench_record
from traceability.reading.bench_record import MANUAL, SCENARIOS, SHARE, SLOW, TIMINGS, Paper
from traceability.schema import BenchRun

Runs = Mapping[str, BenchRun]  # by the model of time

BIN_US = 20
TOP = 12  # modules and functions shown of each scenario
CLASSES = {MANUAL: "measured host", SLOW: "measured board", "board": "truth host"}
WORDS = {**TIMINGS, "board": "a board"}


def bench(portal: Portal) -> dict[str, Any]:
    measured = portal.model.bench or {}
    runs = {name: scenario.runs for name, scenario in measured.items()}
    return {
        "record": bench_record,
        "runs": runs,
        "profiles": {name: scenario.profile for name, scenario in measured.items()},
        "target": target,
        "top": TOP,
        "comparison": comparison(runs) if runs else None,
        "distributions": {name: distribution(run) for name, run in runs.items()},
        "board": any("board" in run for run in runs.values()),
    }


def target(paper: Paper, run: Runs, kind: str) -> tuple[float, float]:
    """The most that the pessimistic time may be, and how many times that it is."""
    most = (paper.average if kind == "average" else paper.maximum) / SHARE
    return round(most, 3), round(getattr(run[SLOW].report_ms, kind) / most, 2)


def comparison(runs: Mapping[str, Runs]) -> Drawing:
    """For each scenario a line from the average to the maximum: the paper's and ours."""
    x = axis(0.0, max(paper.maximum for paper in SCENARIOS), rounded=True)
    rows = len(SCENARIOS)
    lines, parts = [], []
    for offset, name, kind in (
        (-0.2, "the paper", "set-point"),
        (0.0, WORDS[MANUAL], CLASSES[MANUAL]),
        (0.2, WORDS[SLOW], CLASSES[SLOW]),
    ):
        path = ""
        for row, paper in enumerate(SCENARIOS):
            low, high = paper.average, paper.maximum
            if name != "the paper":
                found = runs[paper.name].get(MANUAL if name == WORDS[MANUAL] else SLOW)
                if found is None:
                    continue
                low, high = found.report_ms.average, found.report_ms.maximum
            down = HEIGHT * (row + 0.5 + offset) / rows
            first, last = (x.place(value) * WIDTH / 100 for value in (low, high))
            path += f"M{first:.1f} {down - 8:.1f}v16m0 -8H{last:.1f}"
            parts.append(f"{paper.title}, {name}: {low:g} to {high:g} ms")
        lines.append(Line(kind, f"{name}: average to maximum", path))
    marks = [Tick(str(row + 1), 100 - 100 * (row + 0.5) / rows) for row in range(rows)]
    return Drawing(
        "Time from the clock pulse to the report", "ms", x.ticks, marks, lines, "; ".join(parts)
    )


def distribution(run: Runs) -> Drawing:
    """How many cycles took how long, in steps of 20 us."""
    times = {kind: run[kind].times_us for kind in CLASSES if kind in run}
    bins = {kind: Counter(time // BIN_US for time in values) for kind, values in times.items()}
    most = max(max(found) for found in bins.values()) + 1
    x = axis(0.0, most * BIN_US / 1000, rounded=True)
    y = axis(0.0, float(max(max(found.values()) for found in bins.values())), rounded=True)
    lines = [Line(CLASSES[kind], WORDS[kind], outline(found, x, y)) for kind, found in bins.items()]
    words = "; ".join(
        f"{WORDS[kind]}: {min(values)} to {max(values)} us" for kind, values in times.items()
    )
    return Drawing("Cycles by their time", "cycles in 20 us", x.ticks, y.ticks, lines, words)


def outline(found: Counter[int], x: Axis, y: Axis) -> str:
    """The steps of a histogram."""
    parts: list[str] = []
    for number in range(min(found), max(found) + 1):
        left, right = (x.place(edge * BIN_US / 1000) * WIDTH / 100 for edge in (number, number + 1))
        down = HEIGHT - y.place(found[number]) * HEIGHT / 100
        parts.append(f"{'V' if parts else f'M{left:.1f} {HEIGHT}V'}{down:.1f}H{right:.1f}")
    return "".join([*parts, f"V{HEIGHT}"])
