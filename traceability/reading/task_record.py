"""Reads the record of the build tasks. The record shows which results belong to the present
files."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

from doit.dependency import MD5Checker

RECORD = Path("build/tasks.json")
# The names of the tasks whose results the model reads.
TESTS_TRACE, TESTS_BOARD, TESTS_PLAIN = "tests (trace)", "tests (virtual K64)", "tests (plain)"
COVERAGE = "coverage"
IMAGES = "sizes of the images"
CLOSED_LOOP = "closed loop"
BENCH = "bench"
LIVE = "live view"
CALLS = "recorded calls"
PROOFS = "proofs"
BASELINE = "bench of the baseline design"
CHANGES = "likely changes"
PORTS = "ports"
SEEDED_FAULTS = "seeded faults"


def is_fresh(root: Path, task: str) -> bool:
    """Returns whether a task was completed and the inputs of the task have not changed since."""
    entry = _read(root).get(task)
    if entry is None:
        return False
    return all(_is_same(root / name, entry.get(name)) for name in entry["deps:"])


def _is_same(path: Path, state: Any) -> bool:
    if state is None or not path.is_file():
        return False
    return not MD5Checker().check_modified(str(path), path.stat(), tuple(state))


def _read(root: Path) -> dict[str, Any]:
    path = root / RECORD
    try:
        state = path.stat()
    except OSError:
        return {}
    return _load(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=4)
def _load(path: Path, _time: int, _size: int) -> dict[str, Any]:
    record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return record
