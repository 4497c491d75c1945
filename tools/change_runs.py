"""Tests the likely changes and the ports, and measures the firmware images of the changes."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any, TextIO

from tools.cmake_build import BOARD_PRESET, gtest_counts, outcome_of, run_shards, write_failures
from tools.sizes import whole_of
from tools.task_graph import Outcome
from traceability.reading.change_kits import RESULT, images_of, read_kits
from traceability.reading.ports import FOLDER as PORTS
from traceability.reading.ports import RESULT as PORTS_RESULT
from traceability.reading.ports import read_ports
from traceability.reading.products import PAPER, recorded_image_of
from traceability.reading.toml_reader import Entries

TESTS, IMAGES = "changes_tests", "change_images"  # CMake targets
COST = "instructions"  # property of a test: average number of instructions in a cycle


def test_changes(root: Path, log: TextIO) -> Outcome:
    """Writes build/results/changes.json with the results of the tests and the costs of the
    firmware images."""
    path = root / RESULT
    program = root / "build" / BOARD_PRESET / "changes" / TESTS
    suites, _, _ = run_shards(path, program, log, {})
    path.write_text(json.dumps({"testsuites": suites, "images": costs(root, suites)}) + "\n")
    write_failures(path, log)
    return outcome_of(gtest_counts(path))


def test_ports(root: Path, log: TextIO) -> Outcome:
    """Writes build/results/ports.json. For each port whose emulator is installed, the file contains
    the results of the tests and the sizes of the firmware image. It also contains the sizes of the
    same design on the K64."""
    path = root / PORTS_RESULT
    reports = {}
    for name, port in read_ports(root, Entries(root)).items():
        if port.needs and not shutil.which(port.needs):
            log.write(f"{name} is not tested, because {port.needs} is not installed\n")
            continue
        program = root / "build" / BOARD_PRESET / PORTS / name / port.program
        suites, _, _ = run_shards(path.with_suffix(f".{name}.json"), program, log, {})
        (image,) = (root / "build/k64_calls").rglob(f"{port.image}.elf")
        reports[name] = {"testsuites": suites, "image": size_of(image)}
    whole = [suite for report in reports.values() for suite in report["testsuites"]]
    sizes = size_of(root / recorded_image_of(PAPER, ".elf"))
    path.write_text(json.dumps({**reports, "k64": sizes, "testsuites": whole}) + "\n")
    write_failures(path, log)
    return outcome_of(gtest_counts(path))


def missing_emulators(root: Path) -> str:
    """Returns the missing programs. The tests of the ports need these programs."""
    ports = read_ports(root, Entries(root)).values()
    return ", ".join(port.needs for port in ports if port.needs and not shutil.which(port.needs))


def size_of(elf: Path) -> dict[str, float]:
    """Returns the flash and RAM of a firmware image [bytes]."""
    whole = whole_of(elf)
    return {"flash": whole.flash, "ram": whole.ram}


def costs(root: Path, suites: list[dict[str, Any]]) -> dict[str, dict[str, float]]:
    """Returns the flash and RAM of each firmware image [bytes]. Also returns the number of
    instructions of a cycle, if they were counted."""
    tests = [test for suite in suites for test in suite["testsuite"]]
    counted = {test["image"]: float(test[COST]) for test in tests if COST in test}
    images: dict[str, dict[str, float]] = {}
    for image in images_of(read_kits(root, Entries(root)).values()):
        images[image] = size_of(root / recorded_image_of(image, ".elf"))
        if image in counted:
            images[image][COST] = counted[image]
    return images
