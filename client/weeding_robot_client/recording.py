"""Records reports in a CSV file, in an MCAP file, or in both. In the CSV file, a missing value is
empty."""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Protocol

from weeding_robot_client.layout import LAYOUTS
from weeding_robot_client.messages import Report

COLUMNS = (*LAYOUTS["Report"].value_names, "round_trip_ms")


def row(report: Report) -> list[object]:
    return [cell_of(value) for value in (*report.values.values(), report.round_trip_ms)]


def cell_of(value: object) -> object:
    if isinstance(value, bool):
        return int(value)
    return " ".join(value) if isinstance(value, tuple) else value


class ReportFile(Protocol):
    """A file to which reports are written."""

    def add(self, report: Report) -> None: ...

    def close(self) -> None: ...


class CsvFile:
    """A table with a row for each report."""

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", newline="")
        self._table = csv.writer(self._file)
        self._table.writerow(COLUMNS)

    def add(self, report: Report) -> None:
        self._table.writerow(row(report))

    def close(self) -> None:
        self._file.close()


class Recording(AbstractContextManager["Recording"]):
    """The files to which reports are written as they arrive. Without a path, nothing is written.

    A full disk ends the recording. The program does not end, and the robot continues to drive.
    """

    def __init__(self, table: Path | None, mcap: Path | None = None) -> None:
        self._files: dict[Path, ReportFile] = {}
        if table:
            self._files[table] = CsvFile(table)
        if mcap:
            from weeding_robot_client.mcap_file import McapFile

            self._files[mcap] = McapFile(mcap)

    def __exit__(self, *_: object) -> None:
        self._each(lambda file: file.close())

    def add(self, report: Report) -> None:
        self._each(lambda file: file.add(report))

    def _each(self, action: Callable[[ReportFile], None]) -> None:
        for path, file in [*self._files.items()]:
            try:
                action(file)
            except OSError as error:
                # the recording is incomplete, and no more reports are written
                del self._files[path]
                print(f"\nthe recording {path} ends here: {error.strerror}", file=sys.stderr)
