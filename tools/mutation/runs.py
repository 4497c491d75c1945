"""Runs the tests of a mutant, and returns the tests that find the mutant."""

from __future__ import annotations

import contextlib
import math
import os
import re
import resource
import signal
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import NamedTemporaryFile

from traceability.reading.results import plain_name

# A program has a limit of its processor time. Without a mutant, its tests need a certain time. The
# limit is SLOWER multiplied by this time, plus LEAST_SECONDS. If the program reaches this limit,
# the running test counts as hanging.
SLOWER = 10
LEAST_SECONDS = 2.0
# A program can wait without using processor time. It is therefore also ended when its run time
# reaches ASLEEP multiplied by its limit.
ASLEEP = 30
HANGS = 2  # After this number of hanging tests, the other tests stay without a result.
LINE = re.compile(rb"^\[ +(RUN|OK|FAILED|SKIPPED) +\] ([\w/]+)\.([\w/]+)", re.MULTILINE)

SUITE = re.compile(rb"^\[-+\] \d+ tests? from ([\w/]+)(?:, .*)?$", re.MULTILINE)


@dataclass
class Outcome:
    """The failed and the passed tests of a run. A test that is in neither set is not decided."""

    failed: set[str] = field(default_factory=set)
    passed: set[str] = field(default_factory=set)


def run_tests(program: Path, mutant: int, seconds: dict[str, float]) -> Outcome:
    """Runs tests with an active mutant. The number 0 means that no mutant is active.

    ``seconds`` contains the time of each test without a mutant. If a test ends the program, the
    test counts as failed, and the remaining tests run in the next process."""
    outcome = Outcome()
    left = dict(seconds)
    hangs = 0
    while left and hangs < HANGS:
        limit = LEAST_SECONDS + SLOWER * sum(left.values())
        ended, hung = _run(program, mutant, left, limit, outcome)
        hangs += hung
        if ended is None:
            break
        outcome.failed.add(ended)
        decided = outcome.failed | outcome.passed
        left = {name: time for name, time in left.items() if name not in decided}
    outcome.passed -= outcome.failed
    return outcome


def _run(
    program: Path, mutant: int, tests: Iterable[str], limit: float, outcome: Outcome
) -> tuple[str | None, bool]:
    """Runs one process. Returns the test that ended the process, if there is one, and whether this
    test hung.

    ``limit`` counts processor seconds, because other programs on this computer delay the tests."""
    tests = list(tests)
    # Every run of a random test has the same seed. A difference is therefore an effect of the
    # mutant.
    environment = {**os.environ, "WR_MUTANT": str(mutant), "WR_SEED": "1"}
    # The names of all tests are too long for an argument of a program.
    with NamedTemporaryFile("w", dir=program.parent, suffix=".flags") as flags:
        flags.write(f"--gtest_color=no\n--gtest_filter={':'.join(map(_pattern, tests))}\n")
        flags.flush()
        with subprocess.Popen(
            [program, f"--gtest_flagfile={flags.name}"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
        ) as process:
            _limit_processor_time(process.pid, math.ceil(limit))
            try:
                text, _ = process.communicate(timeout=ASLEEP * limit)
                hung = process.returncode == -signal.SIGXCPU
            except subprocess.TimeoutExpired:
                process.kill()
                text, _ = process.communicate()
                hung = True
    code = process.returncode
    running = record_results(text, outcome) or _suite_began(text, tests, outcome)
    return (running if code not in (0, 1) else None), hung


def _pattern(test: str) -> str:
    """Returns the filter that selects a test with all its parameters and all types of its
    suite."""
    suite, _, name = test.partition(".")
    return f"{test}:{test}/*:*/{test}:*/{test}/*:{suite}/*.{name}"


def _suite_began(text: bytes, tests: Iterable[str], outcome: Outcome) -> str | None:
    """Searches the suite whose name was printed last. Returns one of its tests that has no result.
    A fault can end the process in the set-up of a suite, before a test begins. The returned test
    then counts as the test that ended the process."""
    for suite in SUITE.findall(text)[-1:]:
        begin = plain_name(suite.decode(), "")
        opened = set(tests) - outcome.failed - outcome.passed
        return next((name for name in sorted(opened) if name.startswith(begin)), None)
    return None


def _limit_processor_time(process: int, seconds: int) -> None:
    """Limits the processor time of the process and of each child. The kernel ends a process at this
    limit."""
    with contextlib.suppress(ProcessLookupError):  # The process has already ended.
        resource.prlimit(process, resource.RLIMIT_CPU, (seconds, seconds + 1))


def record_results(text: bytes, outcome: Outcome) -> str | None:
    """Adds the results that the program printed. Returns the test that began and did not end."""
    running: str | None = None
    for word, suite, name in LINE.findall(text.partition(b"Global test environment tear-down")[0]):
        test = plain_name(suite.decode(), name.decode())
        if word == b"RUN":
            running = test
            continue
        running = None
        (outcome.failed if word == b"FAILED" else outcome.passed).add(test)
    return running
