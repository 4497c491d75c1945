"""Runs the tests of a mutant, and returns those that find it."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.results import plain_name

SLOWER = 10  # a test counts as hanging after this factor times its time without a mutant
LEAST_SECONDS = 2.0
HANGS = 2  # tests that may hang: the tests after them stay undecided
LINE = re.compile(rb"^\[ +(RUN|OK|FAILED|SKIPPED) +\] ([\w/]+)\.([\w/]+)", re.MULTILINE)


@dataclass
class Outcome:
    """Results of tests: those that failed, those that passed. Other tests are undecided."""

    failed: set[str] = field(default_factory=set)
    passed: set[str] = field(default_factory=set)


def run_tests(program: Path, mutant: int, seconds: dict[str, float]) -> Outcome:
    """Runs tests with a mutant activated; 0 means none.

    ``seconds`` contains the time of each test without a mutant. A test that ends the
    program has failed; the others run in the next process.
    """
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
    """One process. Returns the test that ended it, if any, and whether this test hung."""
    patterns = (f"{name}:{name}/*:*/{name}:*/{name}/*" for name in tests)
    words = [str(program), f"--gtest_filter={':'.join(patterns)}", "--gtest_color=no"]
    environment = {**os.environ, "WR_MUTANT": str(mutant)}
    hung = False
    try:
        run = subprocess.run(
            words,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
            timeout=limit,
            check=False,
        )
        text, code = run.stdout, run.returncode
    except subprocess.TimeoutExpired as error:
        text, code, hung = error.stdout or b"", -1, True
    running = record_results(text, outcome)
    return (running if code not in (0, 1) else None), hung


def record_results(text: bytes, outcome: Outcome) -> str | None:
    """Adds the results that the program printed. Returns the test that had begun and not ended."""
    running: str | None = None
    for word, suite, name in LINE.findall(text.partition(b"Global test environment tear-down")[0]):
        test = plain_name(suite.decode(), name.decode())
        if word == b"RUN":
            running = test
            continue
        running = None
        (outcome.failed if word == b"FAILED" else outcome.passed).add(test)
    return running
