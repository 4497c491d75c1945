"""Builds and runs the firmware and its tests with CMake. Each stage does only what changed."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from traceability.commands.steps import FailureError, run
from traceability.sources import source_hash


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
    made = directory / "build.ninja"
    if not made.exists() or made.stat().st_mtime < (root / "CMakePresets.json").stat().st_mtime:
        run(log, ["cmake", "-S", root, "--preset", preset])
    wanted = ["--target", *targets] if targets else []
    run(log, ["cmake", "--build", directory, "--parallel", jobs(), *wanted])


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


def results_of(root: Path, preset: str) -> Path:
    """The result file of the tests; coverage.json is the coverage itself."""
    name = "coverage_tests" if preset == "coverage" else preset
    return root / "build" / "results" / f"{name}.json"


def is_current(root: Path, preset: str) -> bool:
    """Whether there are results, and they are those of the present sources."""
    stamp = root / "build" / "results" / f"{preset}.hash"
    return (
        results_of(root, preset).exists()
        and stamp.exists()
        and json.loads(stamp.read_text()) == {"sources": source_hash(root)}
    )


def run_tests(root: Path, preset: str, log: TextIO) -> tuple[Counts, bool]:
    """Builds and runs the C++ tests, unless they ran on these very sources.

    Returns the counts, and whether the tests were run now.
    """
    results = results_of(root, preset)
    stamp = root / "build" / "results" / f"{preset}.hash"
    if is_current(root, preset):
        return gtest_counts(results), False
    now = {"sources": source_hash(root)}
    build(root, preset, log)
    results.parent.mkdir(parents=True, exist_ok=True)
    results.unlink(missing_ok=True)
    stamp.unlink(missing_ok=True)
    binaries = root / "build" / preset
    shutil.rmtree(binaries / "traces", ignore_errors=True)
    for counter in binaries.rglob("*.gcda"):
        counter.unlink()
    ended = ""
    try:
        run(log, [binaries / "tests" / "firmware_tests", f"--gtest_output=json:{results}"])
    except FailureError as error:
        ended = str(error)
    if not results.exists():
        raise FailureError(ended or "the tests wrote no results")
    counts = gtest_counts(results)
    if ended and not counts.failed:
        raise FailureError(ended)
    stamp.write_text(json.dumps(now) + "\n")
    return counts, True


def measure_coverage(root: Path, log: TextIO) -> None:
    """Writes build/results/coverage.json from the counters of the last run of the tests."""
    result = root / "build" / "results" / "coverage.json"
    ran = results_of(root, "coverage")
    if result.exists() and result.stat().st_mtime >= ran.stat().st_mtime:
        return
    run(
        log,
        [
            root / ".venv" / "bin" / "gcovr",
            *("--root", root, "--filter", root / "src", "-j", jobs()),
            *("--exclude-throw-branches", "--exclude-unreachable-branches"),
            *("--json", result, root / "build" / "coverage"),
        ],
    )


def require_counts(counts: Counts, fresh: bool) -> str:
    """The note of a step that ran tests; a failed test, or no test, fails the step."""
    if counts.failed or not counts.passed:
        raise FailureError(str(counts))
    return str(counts) if fresh else f"{counts} (unchanged)"


def firmware_sizes(root: Path) -> dict[str, dict[str, int]]:
    """Flash and RAM of each source file in the library for the K64; writes size_k64.json."""
    libraries = list((root / "build" / "k64").rglob("libfirmware.a"))
    if len(libraries) != 1:
        raise FailureError("the library for the K64 was not built")
    table = subprocess.run(
        ["arm-none-eabi-size", libraries[0]], capture_output=True, text=True, check=True
    ).stdout
    sizes = {}
    for line in table.splitlines()[1:]:
        text, data, bss, _, _, member = line.split(maxsplit=5)
        module = member.split(".", 1)[0]
        sizes[module] = {"flash": int(text) + int(data), "ram": int(data) + int(bss)}
    target = root / "build" / "results" / "size_k64.json"
    target.parent.mkdir(parents=True, exist_ok=True)
    content = json.dumps(dict(sorted(sizes.items())), indent=1) + "\n"
    if not target.exists() or target.read_text() != content:
        target.write_text(content)
    return sizes
