"""A recording of reports as one page of curves, which needs no other file."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from portal.plots import Drawing, draw
from traceability.schema import Curve, LoopPlot
from weeding_robot_client.layout import LAYOUTS, WHEEL_COUNT, Layout
from weeding_robot_client.mcap_file import read_mcap

SITE = Path(__file__).parents[1]
MCAP = ".mcap"
ROBOT = "robot"  # name of the source of the values, in place of a target in the plots of the
# simulator
MS_OF_S = 1000
VELOCITY, VOLTAGE, CURRENT = "Velocity", "Tension", "Current"  # as the reports name them
# Values whose changes are listed.
STATES = ("state", "mode", "source", "armed", "held", "inhibit", "stop_cause", "steering_state")

Values = Mapping[str, Any]


class RecordingError(Exception):
    """A file that is not a recording of reports."""


@dataclass(frozen=True)
class Change:
    """A state that changed."""

    seconds: float
    name: str
    before: str
    after: str


# ---- reading -------------------------------------------------------------------


def read_recording(path: Path) -> list[Values]:
    """The values of each report: of an MCAP or CSV file of the client, or a table of a scenario."""
    if path.suffix == MCAP:
        return list(read_mcap(path))
    with path.open(newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    report = LAYOUTS["Report"]
    if rows and raw_columns(report) <= rows[0].keys():
        return [report.decode(report.pack(**numbers(report, row))) for row in rows]
    if rows and set(report.value_names) <= rows[0].keys():
        return [{name: _value(cell) for name, cell in row.items()} for row in rows]
    raise RecordingError(f"{path} is not a recording of reports")


def raw_columns(report: Layout) -> set[str]:
    """The columns of a scenario's table: numbers as on the line, and a column for each bit."""
    bits = {bit.name for field in report.fields for bit in field.bits}
    return bits | {field.name for field in report.fields if not field.bits}


def numbers(report: Layout, row: Mapping[str, str]) -> dict[str, int]:
    return {
        field.name: field.number(**{bit.name: row[bit.name] == "1" for bit in field.bits})
        if field.bits
        else int(row[field.name])
        for field in report.fields
    }


def _value(cell: str) -> float | str | None:
    if not cell:
        return None
    try:
        return float(cell)
    except ValueError:
        return cell


# ---- the plots -----------------------------------------------------------------


def plots(reports: Sequence[Values]) -> list[LoopPlot]:
    """For each wheel its velocity, voltage and current with the set-points, then the steering."""
    wheel_plots = []
    for wheel in range(WHEEL_COUNT):
        for title, unit, quantity, name in (
            ("velocity", "rpm", VELOCITY, f"velocity{wheel}_rpm"),
            ("voltage", "V", VOLTAGE, f"tension{wheel}_volts"),
            ("current", "A", CURRENT, f"current{wheel}_amperes"),
        ):
            ordered = [
                (at, report[f"set_point{wheel}"])
                for at, report in timed(reports)
                if report[f"quantity{wheel}"] == quantity
            ]
            wheel_plots.append(
                _plot(f"Wheel {wheel}, {title}", unit, ordered, points(reports, name))
            )
    steering = points(reports, "steering_set_point_degrees")
    wheel_plots.append(_plot("Steering", "degree", steering, points(reports, "steering_degrees")))
    return wheel_plots


def _plot(title: str, unit: str, ordered: Any, measured: Any) -> LoopPlot:
    curves = [Curve("set_point", ROBOT, ordered), Curve("measured", ROBOT, measured)]
    return LoopPlot(title, unit, curves)


def timed(reports: Sequence[Values]) -> Iterable[tuple[float, Values]]:
    """Each report with its time since the first report [s]; the time continues when the robot is
    reset."""
    start, offset, last = None, 0.0, 0.0
    for report in reports:
        at = float(report["time_ms"]) / MS_OF_S
        start = at if start is None else start
        if at + offset < last:
            offset = last - at
        last = at + offset
        yield last - start, report


def points(reports: Sequence[Values], name: str) -> list[tuple[float, float]]:
    """The values that are not missing."""
    return [(at, report[name]) for at, report in timed(reports) if report[name] is not None]


def changes(reports: Sequence[Values]) -> list[Change]:
    changed: list[Change] = []
    before: Values = {}
    for at, report in timed(reports):
        changed += [
            Change(at, name, text_of(before[name]), text_of(report[name]))
            for name in STATES
            if before and report[name] != before[name]
        ]
        before = report
    return changed


def text_of(value: object) -> str:
    if value is None:
        return "none"
    return str(bool(value)).lower() if isinstance(value, bool | float | int) else str(value)


# ---- the page ------------------------------------------------------------------


def recording_page(path: Path) -> str:
    reports = read_recording(path)
    if not reports:
        raise RecordingError(f"{path} has no report")
    drawings: list[Drawing] = [made for plot in plots(reports) if (made := draw(plot))]
    environment = Environment(
        loader=FileSystemLoader(SITE / "templates"), autoescape=True, undefined=StrictUndefined
    )
    return environment.get_template("recording.html").render(
        title=path.name,
        style=Markup((SITE / "theme" / "static" / "portal.css").read_text(encoding="utf-8")),
        reports=len(reports),
        seconds=list(timed(reports))[-1][0],
        drawings=drawings,
        changes=changes(reports),
    )
