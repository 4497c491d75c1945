"""Tests the kits of the likely changes, and measures their images."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, TextIO

from tools.cmake_build import BOARD_PRESET, gtest_counts, outcome_of, run_shards, write_failures
from tools.sizes import whole_of
from tools.task_graph import Outcome
from traceability.reading.change_kits import RESULT, images_of, read_kits
from traceability.reading.products import recorded_image_of
from traceability.reading.toml_reader import Entries

TESTS, IMAGES = "changes_tests", "change_images"  # targets of CMake
COST = "instructions"  # property of a test: those of a cycle, on average


def test_changes(root: Path, log: TextIO) -> Outcome:
    """Writes build/results/changes.json: the results of the tests, and the costs of the images."""
    path = root / RESULT
    path.parent.mkdir(parents=True, exist_ok=True)
    program = root / "build" / BOARD_PRESET / "changes" / TESTS
    suites, _, _ = run_shards(path, program, log, {})
    path.write_text(json.dumps({"testsuites": suites, "images": costs(root, suites)}) + "\n")
    write_failures(path, log)
    return outcome_of(gtest_counts(path))


def costs(root: Path, suites: list[dict[str, Any]]) -> dict[str, dict[str, float]]:
    """Image -> its flash and RAM [bytes], and the instructions of a cycle, where counted."""
    tests = [test for suite in suites for test in suite["testsuite"]]
    counted = {test["image"]: float(test[COST]) for test in tests if COST in test}
    found: dict[str, dict[str, float]] = {}
    for image in images_of(read_kits(root, Entries(root)).values()):
        whole = whole_of(root / recorded_image_of(image, ".elf"))
        found[image] = {"flash": whole.flash, "ram": whole.ram}
        if image in counted:
            found[image][COST] = counted[image]
    return found
