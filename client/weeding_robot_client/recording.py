"""Reports as lines of a CSV file. An empty cell is a value that is missing."""

from __future__ import annotations

import csv
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

from weeding_robot_client.messages import COUNTERS, WHEELS, Report

WHEEL_COLUMNS = (
    "set_point",
    "set_point_unit",
    "velocity_rpm",
    "current_amperes",
    "position_counts",
    "tension_volts",
    "cut_off",
    "blind",
    "rejected_edges",
)
PLAIN_COLUMNS = (
    "cycle",
    "time_ms",
    "state",
    "mode",
    "source",
    "stop",
    "order_read",
    "held",
    "overran",
    "armed",
    "inhibit",
    "stop_cause",
    "stop_wheel",
    "stop_sources",
    "order_id",
    "sent_at_ms",
    "round_trip_ms",
    "steering_set_point_degrees",
    "steering_degrees",
    "turn",
    "steering_state",
    "left_end",
    "right_end",
)
COSTS = ("report_cycles", "awake_cycles", "start_cycles")
COLUMNS = (
    *PLAIN_COLUMNS,
    *(f"{wheel.replace(' ', '_')}_{column}" for wheel in WHEELS for column in WHEEL_COLUMNS),
    *COUNTERS,
    *COSTS,
)


def row(report: Report) -> list[object]:
    cells: list[object] = [getattr(report, column) for column in PLAIN_COLUMNS]
    for wheel in report.wheels:
        cells += [wheel.set_point.value, wheel.set_point.unit]
        cells += [getattr(wheel, column) for column in WHEEL_COLUMNS[2:]]
    cells += [report.counters[counter] for counter in COUNTERS]
    cells += [getattr(report, column) for column in COSTS]
    return [_cell(value) for value in cells]


def _cell(value: object) -> object:
    if isinstance(value, bool):
        return int(value)
    return " ".join(value) if isinstance(value, tuple) else value


class Recording(AbstractContextManager["Recording"]):
    """Writes reports to a file as they come; without a path it writes nothing."""

    def __init__(self, path: Path | None) -> None:
        self._file = path.open("w", newline="") if path else None
        self._writer = csv.writer(self._file) if self._file else None
        if self._writer:
            self._writer.writerow(COLUMNS)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._file:
            self._file.close()

    def add(self, report: Report) -> None:
        if self._writer:
            self._writer.writerow(row(report))
