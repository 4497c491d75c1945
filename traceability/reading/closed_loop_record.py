"""The results of the closed-loop runs, in which the firmware controls the simulated robot: curves,
and values with limits."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from numbers import Real
from pathlib import Path
from typing import Any

from traceability import schema
from traceability.reading.products import PAPER
from traceability.reading.results import RESULTS, read_fresh
from traceability.reading.task_record import CLOSED_LOOP
from traceability.reading.toml_reader import Entries, Keys

PRODUCT = PAPER  # the product that runs the scenarios
DECLARED = Path("design/closed_loop.toml")
EXAMPLES = Path("sim/scenario/examples")
OUTCOMES = RESULTS / "closed_loop.json"
FOLDER = RESULTS / "closed_loop"
SHORT = {schema.HOST: "host", schema.VIRTUAL_K64: "k64"}
MEAN_MS = 1000
CURVES = ("set_point", "measured", "truth")
SCENARIO: Keys = {"name": str, "title": str, "says": str}
PARTS: dict[str, tuple[Keys, Keys]] = {
    "plot": (
        {"title": str, "unit": str, "scale": Real},
        {**dict.fromkeys(CURVES, str), "from": Real},
    ),
    "figure": (
        {"title": str, "unit": str, "kind": str, "column": str}
        | dict.fromkeys(("from", "to", "limit"), Real),
        {"requirement": str} | dict.fromkeys(("target", "band", "scale"), Real),
    ),
}

Rows = list[dict[str, str]]
Points = list[tuple[float, float]]


def csv_of(scenario: str, binding: str) -> Path:
    """Returns the path of the file into which a run writes its reports."""
    return FOLDER / f"{scenario}-{SHORT[binding]}.csv"


def declared(root: Path, entries: Entries | None = None) -> list[dict[str, Any]]:
    """Returns the closed-loop scenarios that the design declares, with their plots and metrics but
    without results."""
    entries = entries or Entries(root)
    may: Keys = {"plot": list, "figure": list}
    scenarios = entries.tables(root / DECLARED, "scenario", SCENARIO, may, own="name")
    for item, place in scenarios:
        for part, (needs, others) in PARTS.items():
            item[part] = [
                entry
                for entry in item.get(part, [])
                if entries.fits(
                    entry, entries.line_in(place, f'"{entry.get("title", "")}"'), needs, others
                )
            ]
    return [{**item, "place": place} for item, place in scenarios]


def read_closed_loop(root: Path, entries: Entries | None = None) -> list[schema.LoopScenario]:
    """Returns the closed-loop scenarios. A scenario that ran with the present sources has curves
    and values."""
    outcomes = read_fresh(root, OUTCOMES, CLOSED_LOOP)
    runs = outcomes["runs"] if outcomes else {}
    return [_scenario(root, item, runs.get(item["name"], {})) for item in declared(root, entries)]


def _scenario(root: Path, item: dict[str, Any], runs: dict[str, Any]) -> schema.LoopScenario:
    name = str(item["name"])
    rows = {
        binding: read_rows(root / csv_of(name, binding)) for binding in SHORT if binding in runs
    }
    return schema.LoopScenario(
        name,
        item["title"],
        item["says"],
        str(EXAMPLES / f"{name}.scenario"),
        item["place"],
        [_plot(plot, rows) for plot in item.get("plot", [])],
        [_figure(figure, rows) for figure in item.get("figure", [])],
        {
            binding: schema.LoopRun(run["passed"], run["said"], run.get("stack"))
            for binding, run in runs.items()
        },
    )


def read_rows(path: Path) -> Rows:
    if not path.is_file():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


# ---- curves ------------------------------------------------------------------


def _plot(plot: dict[str, Any], rows: dict[str, Rows]) -> schema.LoopPlot:
    curves = []
    for kind in CURVES:
        if kind not in plot:
            continue
        for binding, table in rows.items():
            points = [
                (at / 1000, value * plot["scale"])
                for at, value in column(table, plot[kind])
                if at >= plot.get("from", 0)
            ]
            curves.append(schema.Curve(kind, binding, points))
    return schema.LoopPlot(plot["title"], plot["unit"], curves)


def column(rows: Rows, name: str) -> Points:
    """Returns the valid values of a column with their times [ms].

    For a true value of the simulated robot, the time is the time at which the value was read. For a
    value that the robot reported, it is the time of the clock pulse."""
    return [
        (float(row[time_column(name)]), float(row[name])) for row in rows if is_valid(row, name)
    ]


def time_column(name: str) -> str:
    truth = name.startswith("true_") or name in ("way", "distance", "ground_speed", "slope")
    return "at_ms" if truth else "time_ms"


def is_valid(row: dict[str, str], name: str) -> bool:
    """Returns whether a value is valid. For each measured value and each applied voltage, a bit of
    the report shows whether the value is valid. Other values are always valid."""
    wheel = int(name[-1]) if name[-1].isdigit() else 0
    bits = {
        f"velocity{wheel}": ("measured", 3 * wheel),
        f"current{wheel}": ("measured", 3 * wheel + 1),
        "steering": ("measured", 12),
        f"tension{wheel}": ("applied", wheel),
    }
    if name not in bits:
        return True
    mask, bit = bits[name]
    return bool(int(row[mask]) >> bit & 1)


# ---- values -----------------------------------------------------------------


def _figure(figure: dict[str, Any], rows: dict[str, Rows]) -> schema.LoopFigure:
    values = {}
    for binding, table in rows.items():
        points = [
            point
            for point in column(table, figure["column"])
            if figure["from"] <= point[0] <= figure["to"]
        ]
        values[binding] = measure(figure, points)
    return schema.LoopFigure(
        figure["title"], figure["limit"], figure["unit"], figure.get("requirement", ""), values
    )


def measure(figure: dict[str, Any], points: Points) -> float | None:
    """Computes a metric of a curve. Returns None if the curve has no points, or if the value never
    settles in its band."""
    if not points:
        return None
    target = float(figure.get("target", 0))
    scale = float(figure.get("scale", 1))
    match figure["kind"]:
        case "settling":
            return settling(points, figure["from"], target, figure["band"] / 100)
        case "overshoot":
            return max(0.0, *(100 * (value / target - 1) for _, value in points))
        case "mean_error":
            return max(100 * abs(mean / target - 1) for mean in means(points))
        case "error":
            return scale * max(abs(value - target) for _, value in points)
        case "peak":
            return scale * max(abs(value) for _, value in points)
    raise ValueError(f"{DECLARED}: unknown kind of metric {figure['kind']!r}")


def settling(points: Points, start: float, target: float, band: float) -> float | None:
    """Returns the settling time: the time from ``start`` until the values are in the band and stay
    there. Returns None if the last value is outside the band."""
    inside: float | None = None
    for at, value in points:
        if abs(value - target) > band * abs(target):
            inside = None
        elif inside is None:
            inside = at
    return None if inside is None else inside - start


def means(points: Points) -> Sequence[float]:
    """Returns a moving average: for each point, the mean over the 1000 ms that begin at this
    point. At the end, points with less than 1000 ms after them are left out. If the curve is
    shorter than 1000 ms, returns the mean of all its points."""
    last = points[-1][0]
    averages: list[float] = []
    for at, _ in points:
        if at + MEAN_MS <= last or not averages:
            values = [value for when, value in points if at <= when < at + MEAN_MS]
            averages.append(sum(values) / len(values))
    return averages
