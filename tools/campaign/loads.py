"""The campaign of random drives, with its program and the summary of the drives. In each drive, the
PC keeps its serial line busy."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

PROGRAM = Path("build/host/sim/weeding_robot_loads")
LISTED = 10  # The record lists only this number of drives. They have the longest control cycles.


def summarise(_root: Path, cases: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Returns the longest control cycles of all drives."""
    longest = sorted(cases, key=lambda case: (-case["longest_ns"], case["seed"]))
    quiet = [case["longest_ns"] for case in longest if not case["noise"]]
    noisy = [case["longest_ns"] for case in longest if case["noise"]]
    return {
        "outcomes": {
            "longest_ms": round(quiet[0] / 1e6, 4),
            "median_ms": round(quiet[len(quiet) // 2] / 1e6, 4),
            "noise_ms": round(noisy[0] / 1e6, 4) if noisy else None,
            "noisy": len(noisy),
        },
        "longest": longest[:LISTED],
    }
