"""Reads the size of the image that was built for the K64."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traceability.reading.results import read_json
from traceability.reading.task_record import IMAGES, is_fresh

TOTALS = Path("build/results/image_k64.json")  # record of the flash and RAM of the image


def read_image(root: Path) -> dict[str, Any] | None:
    """Returns the record of the image, if the present sources built the image."""
    record = read_json(root / TOTALS)
    return record if isinstance(record, dict) and is_fresh(root, IMAGES) else None
