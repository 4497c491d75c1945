"""Reads and writes published results: committed records of runs that take too long for each build.
Examples are the campaigns, which are long runs with inserted faults, random inputs or random
drives."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from traceability.reading.results import read_object
from traceability.schema import LastRecord
from traceability.whole_file import write_json

RECORDS = Path("tests/records")
OUTCOMES = ("harmless", "detected", "late", "silent", "hung", "stopped")
FAULTS, FUZZ, LOADS = "faults", "fuzz", "loads"  # names of the published campaigns
METRICS = (
    "reliability.faults",
    *(f"reliability.faults_{outcome}" for outcome in OUTCOMES),
    "reliability.fuzz_inputs",
    "reliability.fuzz_failures",
)


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
    write_json(path, asdict(record))
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


def read_campaigns(root: Path) -> dict[str, Published]:
    """Returns the published results by the kind of the campaign."""
    records = {name: read_published(root, name) for name in (FAULTS, FUZZ, LOADS)}
    return {name: record for name, record in records.items() if record}


def campaign_metrics(records: Mapping[str, Published]) -> dict[str, Any]:
    """Returns the metrics of the last campaigns. All of them are below the key ``last``, because a
    build does not run the campaigns."""
    return {
        metric: {
            "command": record.command,
            "commit": record.commit,
            "date": record.date,
            "value": value,
        }
        for name, record in records.items()
        for metric, value in _values(name, record.result).items()
    }


def _values(name: str, result: Mapping[str, Any]) -> dict[str, Any]:
    if name == LOADS:
        return {}  # The page of the bench shows these results.
    if name == FUZZ:
        counts = result["outcomes"]
        return {f"reliability.fuzz_{key}": counts[key] for key in ("inputs", "failures")}
    counts = {f"reliability.faults_{key}": result["outcomes"][key] for key in OUTCOMES}
    return {"reliability.faults": result["cases"], **counts}
