"""Reads the record of a release that was built twice, in two different folders, to compare the
files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traceability.reading.results import RESULTS, read_object

RECORD = RESULTS / "release.json"


def release_metrics(root: Path, commit: str) -> dict[str, Any]:
    """Returns the metric that is true if the files of the two builds of this commit are equal byte
    by byte. Returns an empty dictionary if the builds were not compared."""
    record = read_object(root / RECORD)
    if not record or not commit or not record["commit"].startswith(commit):
        return {}
    return {"release.reproducible": record["reproducible"]}
