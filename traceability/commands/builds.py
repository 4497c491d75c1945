"""Builds and runs the firmware and its tests with CMake. Each stage does only what changed."""

from __future__ import annotations

import json
import os
import resource
import shutil
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from traceability.commands.steps import FailureError, run
from traceability.model.results import cost_of
from traceability.products import PAPER, PRODUCTS, image_of
from traceability.sources import hash_of, source_hash

# CMake keeps what it once read of them, so that a change needs a fresh configuration.
SETTINGS = ("CMakePresets.json", "setup/k64-toolchain.cmake")
IMAGE = str(image_of(PAPER, ".bin"))
TESTS = "firmware_tests"
# The tests on the virtual K64 are a run of their own, built with the preset of this machine.
BOARD, BOARD_TESTS, BOARD_PRESET = "board", "board_tests", "host"
BOARD_PROGRAM = "weeding_robot_board"


@dataclass(frozen=True)
class Counts:
    """Results of a run of tests."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Counts) -> Counts:
        return Counts(
            self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped
        )

    def __str__(self) -> str:
        text = f"{self.passed} passed, {self.failed} failed"
        return f"{text}, {self.skipped} skipped" if self.skipped else text


def jobs() -> str:
    return str(os.cpu_count() or 1)


def build(root: Path, preset: str, log: TextIO, *targets: str) -> None:
    """Configures where needed, then builds into build/<preset>."""
    directory = root / "build" / preset
    stamp = directory / "settings.hash"
    now = hash_of(root, [root / name for name in SETTINGS])
    if not stamp.exists() or stamp.read_text() != now or not (directory / "build.ninja").exists():
        run(log, ["cmake", "--fresh", "-S", root, "--preset", preset])
        stamp.write_text(now)
    wanted = ["--target", *targets] if targets else []
    run(log, ["cmake", "--build", directory, "--parallel", jobs(), *wanted])


def build_for_board(root: Path, log: TextIO, *targets: str) -> None:
    """Builds programs that hold the virtual K64."""
    build(root, BOARD_PRESET, log, *targets)


def gtest_counts(results: Path) -> Counts:
    """Counts of a result file of GoogleTest; a disabled or skipped test did not run."""
    passed = failed = skipped = 0
    for suite in json.loads(results.read_text())["testsuites"]:
        for test in suite["testsuite"]:
            if test["status"] != "RUN" or test["result"] == "SKIPPED":
                skipped += 1
            elif "failures" in test:
                failed += 1
            else:
                passed += 1
    return Counts(passed, failed, skipped)


def write_failures(results: Path, log: TextIO) -> None:
    """What failed in a result file of GoogleTest, with the seed that shows it again."""
    for suite in json.loads(results.read_text())["testsuites"]:
        for test in suite["testsuite"]:
            if "failures" not in test:
                continue
            seed = f", WR_SEED={test['seed']}" if "seed" in test else ""
            log.write(f"\nFAILED {suite['name']}.{test['name']}{seed}\n")
            log.writelines(f"{one['failure']}\n" for one in test["failures"])


def junit_counts(results: Path) -> Counts:
    """Counts of a result file of pytest."""
    passed = failed = skipped = 0
    for case in ET.parse(results).iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            failed += 1
        elif case.find("skipped") is not None:
            skipped += 1
        else:
            passed += 1
    return Counts(passed, failed, skipped)


def results_of(root: Path, run_name: str) -> Path:
    """The result file of the tests."""
    return root / "build" / "results" / f"{run_name}.json"


def tested(root: Path, run_name: str) -> dict[str, str]:
    """What the results depend on."""
    now = {"sources": source_hash(root)}
    if run_name == BOARD:
        now["images"] = hash_of(root, [root / image_of(one, ".bin") for one in PRODUCTS])
    return now


def program_of(root: Path, run_name: str) -> Path:
    """The program that holds the tests; what they leave lies beside it."""
    if run_name == BOARD:
        return root / "build" / BOARD_PRESET / "tests" / BOARD_TESTS
    return root / "build" / run_name / "tests" / TESTS


def is_current(root: Path, run_name: str) -> bool:
    """Whether there are results, and they are those of the present sources."""
    stamp = root / "build" / "results" / f"{run_name}.hash"
    return (
        results_of(root, run_name).exists()
        and program_of(root, run_name).exists()
        and stamp.exists()
        and json.loads(stamp.read_text()) == tested(root, run_name)
    )


def run_tests(root: Path, run_name: str, log: TextIO) -> tuple[Counts, bool]:
    """Builds and runs the C++ tests of a preset, or those on the virtual K64.

    They are not run when they ran on these very sources. Returns the counts, and whether the tests
    were run now.
    """
    on_board = run_name == BOARD
    results = results_of(root, run_name)
    stamp = root / "build" / "results" / f"{run_name}.hash"
    if is_current(root, run_name):
        write_failures(results, log)
        return gtest_counts(results), False
    now = tested(root, run_name)
    if on_board:
        build_for_board(root, log, BOARD_TESTS, BOARD_PROGRAM)
    else:
        build(root, run_name, log, TESTS)
    results.parent.mkdir(parents=True, exist_ok=True)
    results.unlink(missing_ok=True)
    stamp.unlink(missing_ok=True)
    binaries = root / "build" / (BOARD_PRESET if on_board else run_name)
    shutil.rmtree(binaries / ("traces-board" if on_board else "traces"), ignore_errors=True)
    for counters in binaries.rglob("*.gcda"):  # gcc would add those of this run
        counters.unlink()
    ended = ""
    before = processor_seconds()
    try:
        run(log, [program_of(root, run_name), f"--gtest_output=json:{results}"])
    except FailureError as error:
        ended = str(error)
    cost = {"sources": now["sources"], "seconds": processor_seconds() - before}
    cost_of(root, run_name).write_text(json.dumps(cost) + "\n")
    if not results.exists():
        raise FailureError(ended or "the tests wrote no results")
    write_failures(results, log)
    counts = gtest_counts(results)
    if ended and not counts.failed:
        raise FailureError(ended)
    stamp.write_text(json.dumps(now) + "\n")
    return counts, True


def processor_seconds() -> float:
    """What the processes that this one started, and that ended, have used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def require_counts(counts: Counts, fresh: bool) -> str:
    """The note of a step that ran tests; a failed test, or no test, fails the step."""
    if counts.failed or not counts.passed:
        raise FailureError(str(counts))
    return str(counts) if fresh else f"{counts} (unchanged)"
