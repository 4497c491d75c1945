"""Reads the measurements of the WebAssembly module that runs the firmware images in a web page."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from traceability.reading.results import RESULTS, read_fresh
from traceability.reading.task_record import LIVE

MODULE = Path("build/web/sim/live.wasm")
RECORD = RESULTS / "live.json"
KEYS = ("ready_s", "bytes", "real_time_factor", "scenarios_equal", "scenarios")


def read_live(root: Path) -> dict[str, Any] | None:
    """Returns the measurements. Returns None if they were not made with the present sources."""
    return read_fresh(root, RECORD, LIVE)


def live_metrics(root: Path) -> dict[str, Any]:
    """Returns the metrics of the WebAssembly module. The value of a metric that was not measured is
    None."""
    record = read_live(root) or {}
    return {f"live.{key}": record.get(key) for key in KEYS}
