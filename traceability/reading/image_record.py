"""Reads the size of the firmware image for the K64."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traceability.reading.results import read_fresh
from traceability.reading.task_record import IMAGES

# file with the flash and RAM sizes of the firmware image
TOTALS = Path("build/results/image_k64.json")


def read_image(root: Path) -> dict[str, Any] | None:
    """Returns the sizes of the firmware image. Returns None if the image was not built from the
    present sources."""
    return read_fresh(root, TOTALS, IMAGES)
