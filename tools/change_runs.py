"""Tests the kits of the likely changes and the port, and measures the images of the kits."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any, TextIO

from tools.cmake_build import BOARD_PRESET, gtest_counts, outcome_of, run_shards, write_failures
from tools.sizes import whole_of
from tools.task_graph import Outcome
from traceability.reading.change_kits import RESULT, images_of, read_kits
from traceability.reading.ports import FOLDER as PORT
from traceability.reading.ports import RESULT as PORT_RESULT
from traceability.reading.products import recorded_image_of
from traceability.reading.toml_reader import Entries

TESTS, IMAGES = "changes_tests", "change_images"  # targets of CMake
PORT_TESTS, PORT_IMAGE = "ports_tests", "weeding_robot_mps2"
EMULATOR = "qemu-system-arm"
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


def test_port(root: Path, log: TextIO) -> Outcome:
    """Writes build/results/port.json: the results of the tests of the port on QEMU."""
    path = root / PORT_RESULT
    path.unlink(missing_ok=True)
    if missing := missing_emulator():
        return Outcome(f"not run in this build: {missing} is not installed")
    path.parent.mkdir(parents=True, exist_ok=True)
    program = root / "build" / BOARD_PRESET / PORT / PORT_TESTS
    suites, _, _ = run_shards(path, program, log, {})
    path.write_text(json.dumps({"testsuites": suites}) + "\n")
    write_failures(path, log)
    return outcome_of(gtest_counts(path))


def missing_emulator() -> str:
    """Returns the program that the tests of the port need, if it is missing."""
    return "" if shutil.which(EMULATOR) else EMULATOR


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
