"""The campaign of random inputs: its programs, and the summary of its runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

PROGRAM = Path("tools/campaign/fuzz_program.py")
FUZZERS = (Path("build/fuzz/tests/fuzz/fuzz_link"), Path("build/fuzz/tests/fuzz/fuzz_robot"))
LISTED = 20  # failures in the record


def summarise(_root: Path, cases: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Counts the inputs and the failures of each fuzzer."""
    runs = [run for case in cases for run in case["runs"]]
    failures = [{"fuzzer": run["fuzzer"], **run["failure"]} for run in runs if run["failure"]]
    inputs = {
        name: sum(run["inputs"] for run in runs if run["fuzzer"] == name)
        for name in sorted({run["fuzzer"] for run in runs})
    }
    return {
        "outcomes": {"inputs": sum(inputs.values()), "failures": len(failures)},
        "inputs": inputs,
        "failures": failures[:LISTED],
    }
