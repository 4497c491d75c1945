"""Reports as lines of a CSV file. An empty cell is a value that is missing."""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterable
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

from weeding_robot_client.layout import LAYOUTS
from weeding_robot_client.messages import Report

COLUMNS = (*LAYOUTS["Report"].value_names, "round_trip_ms")


def row(report: Report) -> list[object]:
    return [_cell(value) for value in (*report.values.values(), report.round_trip_ms)]


def _cell(value: object) -> object:
    if isinstance(value, bool):
        return int(value)
    return " ".join(value) if isinstance(value, tuple) else value


class Recording(AbstractContextManager["Recording"]):
    """Writes reports to a file as they come; without a path it writes nothing.

    A full disk ends the recording, not the program: the robot is driven on.
    """

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._file = path.open("w", newline="") if path else None
        if self._file:
            self._write(COLUMNS)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._close()

    def add(self, report: Report) -> None:
        self._write(row(report))

    def _write(self, cells: Iterable[object]) -> None:
        if self._file is None:
            return
        try:
            csv.writer(self._file).writerow(cells)
        except OSError as error:
            self._end(error)

    def _close(self) -> None:
        if self._file is None:
            return
        try:
            self._file.close()
        except OSError as error:
            self._end(error)

    def _end(self, error: OSError) -> None:
        """States that the recording is not complete, and writes no more."""
        self._file = None
        print(f"\nthe recording {self._path} ends here: {error.strerror}", file=sys.stderr)
