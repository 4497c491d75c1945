"""The published records of the campaigns of faults and of random inputs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traceability.reading.published import Published, read_published

OUTCOMES = ("harmless", "detected", "late", "silent", "hung", "stopped")
FAULTS, FUZZ = "faults", "fuzz"  # names of the records


def campaign_metrics(root: Path) -> dict[str, Any]:
    """The metrics of the last campaigns: no build runs them, so all are under ``last``."""
    return faults_of(read_published(root, FAULTS)) | fuzz_of(read_published(root, FUZZ))


def faults_of(record: Published | None) -> dict[str, Any]:
    if record is None:
        return {}
    counts = {f"reliability.faults_{key}": record.result["outcomes"][key] for key in OUTCOMES}
    return _last(record, {"reliability.faults": record.result["cases"], **counts})


def fuzz_of(record: Published | None) -> dict[str, Any]:
    if record is None:
        return {}
    keys = {"reliability.fuzz_inputs": "cases", "reliability.fuzz_failures": "failures"}
    return _last(record, {name: record.result[key] for name, key in keys.items()})


def _last(record: Published, values: dict[str, Any]) -> dict[str, Any]:
    origin = {"command": record.command, "commit": record.commit, "date": record.date}
    return {name: {**origin, "value": value} for name, value in values.items()}
