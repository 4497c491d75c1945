"""Builds the firmware and its tests with CMake, and runs the tests. A build compiles only the files
that changed."""

from __future__ import annotations

import json
import os
import secrets
import shlex
import shutil
import subprocess
import threading
from collections import defaultdict
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TextIO

from tools.steps import FailureError, run
from tools.task_graph import Outcome
from traceability.reading.products import DEFAULT, PAPER, image_of, recorded_image_of
from traceability.reading.results import RESULTS, cost_of
from traceability.schema import Counts
from traceability.sources import FRAMES, TESTED, files_below, source_hash

_building: dict[str, threading.Lock] = defaultdict(threading.Lock)
# CMake stores the values of these files in its cache. A change of these files needs a new
# configuration.
SETTINGS = ("CMakePresets.json", "setup/k64-toolchain.cmake")
# The folders and files that are copied, when a copy of the project is built and tested.
COPIED = (*TESTED, "docs", "design", "setup", *FRAMES)
TESTS = "firmware_tests"
# The tests on the virtual K64 are a separate run. Their program is built with the preset for this
# computer.
BOARD, BOARD_TESTS, BOARD_PRESET = "board", "board_tests", "host"
BOARD_PROGRAM = "weeding_robot_board"


def jobs() -> str:
    return str(os.cpu_count() or 1)


def build(root: Path, preset: str, log: TextIO, *targets: str) -> None:
    """Configures the build if necessary. Then builds the targets in the folder build/<preset>. Only
    one build at a time runs in each folder."""
    directory = root / "build" / preset
    made = directory / "build.ninja"
    arguments = ["--target", *targets] if targets else []
    with _building[preset]:
        newest = max((root / name).stat().st_mtime for name in SETTINGS)
        if made.exists() and made.stat().st_mtime < newest:
            shutil.rmtree(directory)  # Old objects and coverage notes must not remain.
        if not made.exists():
            run(log, ["cmake", "--fresh", "-S", root, "--preset", preset])
        run(log, ["cmake", "--build", directory, "--parallel", jobs(), *arguments])


def board_words(root: Path, image: Path) -> list[str]:
    """Returns the command that runs a firmware image on the virtual K64."""
    program, elf = root / "build/host/sim" / BOARD_PROGRAM, image.with_suffix(".elf")
    return [str(program), "--image", str(root / image), "--elf", str(root / elf)]


def gtest_counts(results: Path) -> Counts:
    """Counts the tests in a result file of GoogleTest. Disabled tests count as skipped."""
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
    """Writes the failures in a result file of GoogleTest to the log. For each failure, also writes
    the seed that repeats this failure."""
    for suite in json.loads(results.read_text())["testsuites"]:
        for test in suite["testsuite"]:
            if "failures" not in test:
                continue
            seed = f", WR_SEED={test['seed']}" if "seed" in test else ""
            image = f" with the image {test['image']}" if "image" in test else ""
            log.write(f"\nFAILED {suite['name']}.{test['name']}{image}{seed}\n")
            log.write(f"to debug this test: ./wr debug {suite['name']}.{test['name']}\n")
            log.writelines(f"{failure['failure']}\n" for failure in test["failures"])


def run_tests(root: Path, run_name: str, log: TextIO) -> Counts:
    """Runs the tests of a build, or the tests on the virtual K64. Each processor runs a part of the
    tests."""
    on_board = run_name == BOARD
    results = root / RESULTS / f"{run_name}.json"
    binaries = root / "build" / (BOARD_PRESET if on_board else run_name)
    program = binaries / "tests" / (BOARD_TESTS if on_board else TESTS)
    shutil.rmtree(binaries / ("traces-board" if on_board else "traces"), ignore_errors=True)
    # The files with the coverage counters of the last run are removed. Otherwise, the program would
    # add its counts to these counters.
    for counters in binaries.rglob("*.gcda"):
        counters.unlink()
    seed = {"WR_SEED": os.environ.get("WR_SEED") or str(secrets.randbits(31))}
    suites, seconds, ended = run_shards(results, program, log, seed)
    names = of_each_image(suites) if on_board else []
    for image in (image_of(DEFAULT, ".bin"), recorded_image_of(PAPER, ".bin")) if names else ():
        again = {**seed, "WR_IMAGE": str(root / image), "GTEST_FILTER": ":".join(names)}
        more = run_shards(results, program, log, again)
        suites, seconds, ended = suites + more[0], seconds + more[1], ended or more[2]
    results.write_text(json.dumps({"testsuites": suites}) + "\n")
    cost = {"sources": source_hash(root), "seconds": seconds}
    cost_of(root, run_name).write_text(json.dumps(cost) + "\n")
    write_failures(results, log)
    counts = gtest_counts(results)
    if ended and not counts.failed:
        raise FailureError(ended)
    return counts


def run_shards(
    results: Path, program: Path, log: TextIO, variables: Mapping[str, str]
) -> tuple[list[dict[str, Any]], float, str]:
    """Runs the tests in several processes. Returns three values: the suites with their results, the
    processor time [s], and the first failure of a process. The failure is empty if no process
    failed."""
    results.parent.mkdir(parents=True, exist_ok=True)
    shards = range(int(jobs()))
    parts = [results.with_suffix(f".{number}.part") for number in shards]
    logs = [results.with_suffix(f".{number}.log") for number in shards]

    def run_shard(number: int) -> tuple[str, float]:
        """Runs a process. Returns its failure, if there is one, and its processor time [s]."""
        parts[number].unlink(missing_ok=True)
        numbers = {"GTEST_TOTAL_SHARDS": str(len(shards)), "GTEST_SHARD_INDEX": str(number)}
        words: list[str | Path] = [program, f"--gtest_output=json:{parts[number]}"]
        with logs[number].open("w") as output:
            try:
                return "", run(output, words, env={**os.environ, **numbers, **variables})
            except FailureError as error:
                return str(error), 0.0

    with ThreadPoolExecutor(len(shards)) as pool:
        ends = list(pool.map(run_shard, shards))
    log.writelines(path.read_text(errors="replace") for path in logs)
    ended = next((end for end, _ in ends if end), "")
    if not all(path.exists() for path in parts):
        raise FailureError(ended or "the tests wrote no results")
    suites = [suite for path in parts for suite in json.loads(path.read_text())["testsuites"]]
    return suites, sum(seconds for _, seconds in ends), ended


def of_each_image(suites: list[dict[str, Any]]) -> list[str]:
    """Returns the tests that ran with the image PAPER, because they must be repeated with the other
    firmware images. Tests that are only for one product are left out."""
    return [
        f"{suite['name']}.{test['name']}"
        for suite in suites
        for test in suite["testsuite"]
        if test.get("image") == PAPER and "only" not in test
    ]


def outcome_of(counts: Counts) -> Outcome:
    """Returns the outcome of tests. The outcome is a failure if a test failed or no test passed."""
    values = {"passed": counts.passed, "failed_tests": counts.failed, "skipped": counts.skipped}
    return Outcome(str(counts), bool(counts.failed or not counts.passed), values)


def sources_of(root: Path, preset: str, *targets: str) -> list[str]:
    """Returns the source files of targets, as Ninja lists them. Paths are relative to the
    project."""
    folder = root / "build" / preset

    def ask(*words: str) -> list[str]:
        command = ["ninja", "-C", str(folder), "-t", *words]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        return done.stdout.split("\n")

    # Ninja quotes the inputs for a shell.
    inputs = {shlex.split(line)[0] for line in ask("inputs", *targets) if line}
    input_files = set(inputs)
    object_wanted = False
    for line in ask("deps"):
        if line.startswith("    "):
            if object_wanted:
                input_files.add(line.strip())
        elif line:
            object_wanted = line.partition(": #deps")[0] in inputs
    input_files |= {line.strip(" |") for line in ask("query", "build.ninja")}
    paths = {(folder / name).resolve() for name in input_files}
    names = (path.relative_to(root) for path in paths if path.is_relative_to(root))
    written = [path for path in names if path.parts[0] != "build" and (root / path).is_file()]
    return sorted(map(str, written))


def copy_sources(root: Path, target: Path, texts: Mapping[str, str] | None = None) -> None:
    """Makes the target folder equal to the sources. ``texts`` maps the name of a file to the text
    that its copy gets. A file that is already equal keeps its modification time."""
    python = root / "tests/python"
    paths = [path for path in files_below(root, COPIED) if python not in path.parents]
    contents = {str(path.relative_to(root)): path.read_bytes() for path in paths}
    contents |= {name: text.encode() for name, text in (texts or {}).items()}
    for path in files_below(target, COPIED):
        if str(path.relative_to(target)) not in contents:
            path.unlink()
    for name, content in contents.items():
        copy = target / name
        if not copy.exists() or copy.read_bytes() != content:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
            shutil.copymode(root / name, copy)
