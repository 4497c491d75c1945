"""Plays the scenarios of the closed loop on the host and on the virtual K64, and records the
results."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from typing import TextIO

from tools.cmake_build import board_words
from tools.task_graph import Outcome
from traceability.reading.closed_loop_record import (
    EXAMPLES,
    OUTCOMES,
    PRODUCT,
    csv_of,
    declared,
)
from traceability.reading.products import image_of
from traceability.schema import HOST, VIRTUAL_K64
from traceability.whole_file import write_json

HOST_PROGRAM = "weeding_robot_host"
SECONDS = 300  # time limit of a scenario
STACK = re.compile(r"^stack: (?P<bytes>\d+) bytes$", re.MULTILINE)


def play_all(root: Path, log: TextIO) -> Outcome:
    """Plays each scenario on both targets."""
    runs = {
        str(item["name"]): {
            binding: _play(root, log, str(item["name"]), binding) for binding in (HOST, VIRTUAL_K64)
        }
        for item in declared(root)
    }
    write_json(root / OUTCOMES, {"runs": runs})
    return _outcome(runs)


def _play(root: Path, log: TextIO, name: str, binding: str) -> dict[str, object]:
    reports = root / csv_of(name, binding)
    reports.parent.mkdir(parents=True, exist_ok=True)
    reports.unlink(missing_ok=True)
    words: list[str | Path] = [root / "build/host/sim" / HOST_PROGRAM, "--paper"]
    if binding == VIRTUAL_K64:
        words = [*board_words(root, image_of(PRODUCT, ".bin")), "--stack"]
    words += ["--scenario", root / EXAMPLES / f"{name}.scenario", "--reports", reports]
    log.write(f"$ {' '.join(str(word) for word in words)}\n")
    try:
        run = subprocess.run(words, capture_output=True, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return {
            "passed": False,
            "said": f"the scenario did not end within {SECONDS} s",
            "stack": None,
        }
    output = run.stdout + run.stderr
    log.write(output)
    lines = [line for line in run.stderr.splitlines() or run.stdout.splitlines() if line.strip()]
    said = lines[0].replace(f"{root}/", "") if lines else f"exit code {run.returncode}"
    stack = STACK.search(run.stdout)
    return {
        "passed": run.returncode == 0,
        "said": "" if run.returncode == 0 else said,
        "stack": int(stack["bytes"]) if stack else None,
    }


def _outcome(runs: dict[str, dict[str, dict[str, object]]]) -> Outcome:
    """Returns the outcome of all scenarios. The outcome is a failure if a scenario failed."""
    failed = [
        f"{name} ({binding})"
        for name, bindings in runs.items()
        for binding, run in bindings.items()
        if not run["passed"]
    ]
    if failed:
        return Outcome(f"these scenarios failed: {', '.join(failed)}", failed=True)
    return Outcome(f"{len(runs)} scenarios")
