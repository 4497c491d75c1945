"""The record of a release that was made twice, in two folders."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traceability.reading.results import RESULTS, read_json

RECORD = RESULTS / "release.json"


def release_metrics(root: Path, commit: str) -> dict[str, Any]:
    """Returns whether two builds of this commit were equal byte by byte, or nothing without a
    comparison."""
    record = read_json(root / RECORD)
    if not isinstance(record, dict) or not commit or not record["commit"].startswith(commit):
        return {}
    return {"release.reproducible": record["reproducible"]}
