"""Reads and writes published results: committed records of runs that take too long for each
build."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from traceability.reading.results import read_object
from traceability.schema import LastRecord
from traceability.whole_file import write_whole

RECORDS = Path("tests/records")


@dataclass(frozen=True)
class Published:
    """The published result of the last run of a command."""

    command: str
    commit: str  # empty if git is not available
    date: str  # YYYY-MM-DD
    result: Mapping[str, Any]


def publish(root: Path, name: str, command: str, commit: str, result: Mapping[str, Any]) -> Path:
    """Writes the record of a run with the date of today. Returns the path of the record."""
    record = Published(command, commit, time.strftime("%Y-%m-%d", time.gmtime()), result)
    path = root / RECORDS / f"{name}.json"
    write_whole(path, json.dumps(asdict(record), indent=1) + "\n")
    return path


def read_published(root: Path, name: str) -> Published | None:
    """Returns the last published result of a command. Returns None if there is no published
    result."""
    data = read_object(root / RECORDS / f"{name}.json")
    return Published(**data) if data else None


def last_score(root: Path, name: str) -> LastRecord | None:
    """Returns the last published result of a test that does not run in each build. The result is
    marked as not current, because the sources may have changed since."""
    record = read_published(root, name)
    if record is None:
        return None
    found, tried = record.result["found"], record.result["tried"]
    justified, total = record.result.get("justified", 0), record.result.get("total")
    command = record.command.removeprefix("./wr ")
    return LastRecord(command, record.commit, found, tried, False, record.date, justified, total)
