"""Reads the published results of the campaigns, which are long test runs with inserted faults,
random inputs or random drives."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from traceability.reading.published import Published, read_published

OUTCOMES = ("harmless", "detected", "late", "silent", "hung", "stopped")
FAULTS, FUZZ, LOADS = "faults", "fuzz", "loads"  # names of the published campaigns


METRICS = (
    "reliability.faults",
    *(f"reliability.faults_{outcome}" for outcome in OUTCOMES),
    "reliability.fuzz_inputs",
    "reliability.fuzz_failures",
)


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
