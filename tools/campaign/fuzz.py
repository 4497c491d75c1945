"""The campaign of random inputs, with its programs and the summary of its runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

PROGRAM = Path("tools/campaign/fuzz_program.py")
NAMES = ("frames", "link", "robot")
FUZZERS = tuple(Path(f"build/fuzz/tests/fuzz/fuzz_{name}") for name in NAMES)
LISTED = 20  # greatest number of failures that the record lists


def options(files: Sequence[Path]) -> list[str]:
    """Returns the options of the program that runs the fuzzers."""
    return [
        word
        for name, file in zip(NAMES, files[1:], strict=True)
        for word in (f"--{name}", str(file))
    ]


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
