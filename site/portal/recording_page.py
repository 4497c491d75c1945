"""Draws the reports of a recording as curves, in a single HTML file that needs no other file."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from markupsafe import Markup

from portal.plots import ROBOT, draw_all
from portal.templates import SITE, environment
from traceability.schema import Curve, LoopPlot
from weeding_robot_client.layout import LAYOUTS, WHEEL_COUNT, Layout
from weeding_robot_client.mcap_file import TOPIC, read_mcap

MCAP = ".mcap"
MS_OF_S = 1000
VELOCITY, VOLTAGE, CURRENT = "Velocity", "Tension", "Current"  # names of quantities in the reports
# Values whose changes are listed.
STATES = ("state", "mode", "source", "armed", "held", "inhibit", "stop_cause", "steering_state")

Values = Mapping[str, Any]


class RecordingError(Exception):
    """An error: the file is not a recording of reports."""


@dataclass(frozen=True)
class Change:
    """A change of one of the values in ``STATES`` from one report to the next report."""

    seconds: float
    name: str
    before: str
    after: str


# ---- reading -------------------------------------------------------------------


def read_recording(path: Path) -> list[Values]:
    """Returns the values of each report in a file. The file is an MCAP or CSV file of the client,
    or a CSV file of the scenario player. The two kinds of CSV files have different columns."""
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
    """Returns the names of the columns in the CSV file of the scenario player. A number is stored
    as in the frame, and each bit has a separate column."""
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


@dataclass(frozen=True)
class Series:
    """A plot: the names of the columns with the measured value and with the set-point.

    The set-point is drawn only at the times when the column ``quantity`` has the value ``ordered``.
    If ``quantity`` is empty, the set-point is drawn at all times."""

    title: str
    unit: str
    measured: str
    set_point: str
    quantity: str = ""
    ordered: str = ""


def all_series() -> list[Series]:
    """Returns the plots: the velocity, voltage and current of each wheel, then the steering."""
    wheels = [
        Series(f"Wheel {wheel}, {title}", unit, name, f"set_point{wheel}", f"quantity{wheel}", of)
        for wheel in range(WHEEL_COUNT)
        for title, unit, of, name in (
            ("velocity", "rpm", VELOCITY, f"velocity{wheel}_rpm"),
            ("voltage", "V", VOLTAGE, f"tension{wheel}_volts"),
            ("current", "A", CURRENT, f"current{wheel}_amperes"),
        )
    ]
    steering = Series("Steering", "degree", "steering_degrees", "steering_set_point_degrees")
    return [*wheels, steering]


def plots(reports: Sequence[Values]) -> list[LoopPlot]:
    return [_plot(reports, series) for series in all_series()]


def _plot(reports: Sequence[Values], series: Series) -> LoopPlot:
    ordered = [
        report
        for report in timed(reports)
        if not series.quantity or report[1][series.quantity] == series.ordered
    ]
    curves = [
        Curve("set_point", ROBOT, points(ordered, series.set_point)),
        Curve("measured", ROBOT, points(timed(reports), series.measured)),
    ]
    return LoopPlot(series.title, series.unit, curves)


def timed(reports: Sequence[Values]) -> Iterable[tuple[float, Values]]:
    """Yields each report with its time since the first report [s]. A reset of the robot restarts
    its clock, but the returned time continues."""
    start, offset, last = None, 0.0, 0.0
    for report in reports:
        at = float(report["time_ms"]) / MS_OF_S
        start = at if start is None else start
        if at + offset < last:
            offset = last - at
        last = at + offset
        yield last - start, report


def points(reports: Iterable[tuple[float, Values]], name: str) -> list[tuple[float, float]]:
    """Returns the values of a column with their times, without the missing values."""
    return [(at, report[name]) for at, report in reports if report[name] is not None]


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


# ---- the pages -----------------------------------------------------------------


def plotted(_: object) -> dict[str, Any]:
    """Returns the values for the template of the page that draws a recording in the browser."""
    series = [asdict(one) for one in all_series()]
    return {
        "recording": json.dumps({"series": series, "states": STATES, "topic": TOPIC}),
        "wide": True,
    }


def recording_page(path: Path) -> str:
    reports = read_recording(path)
    if not reports:
        raise RecordingError(f"{path} has no report")
    return (
        environment()
        .get_template("recording.html")
        .render(
            title=path.name,
            style=Markup((SITE / "theme" / "static" / "portal.css").read_text(encoding="utf-8")),
            reports=len(reports),
            seconds=list(timed(reports))[-1][0],
            drawings=draw_all(plots(reports)),
            changes=changes(reports),
        )
    )
