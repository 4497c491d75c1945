"""Chooses the mutants and their tests, and records the results."""

from __future__ import annotations

import hashlib
import random
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from tools.cmake_build import jobs
from tools.mutation.points import Mutant
from tools.mutation.runs import Outcome, run_tests
from traceability.model.design_model import Model
from traceability.model.trees import accepted
from traceability.reading.results import RESULTS
from traceability.reading.source_facts import Facts
from traceability.reading.traces import Traces, nodes_of
from traceability.schema import HOST, Equivalent, Test

RESULT = RESULTS / "mutation.json"
FIRST_PART = 0.2  # processor time of the tests that run first [s]
PART_GROWTH = 4
MUTANT = [one.name for one in fields(Mutant)]
NO_REQUIREMENT = ""  # key of the mutants of functions that serve no requirement


@dataclass
class Plan:
    """The requirements and the tests of each method. They are determined before mutants run."""

    methods: dict[str, list[str]]  # method -> requirements that it serves
    verifying: dict[str, set[str]]  # requirement -> its tests on this computer
    executing: dict[str, set[str]]  # method -> tests that executed it
    seconds: dict[str, float] = field(default_factory=dict)  # test that passes -> its time

    def own(self, method: str, requirement: str) -> set[str]:
        """Returns the tests of a requirement that can detect a change of a method."""
        return self.verifying[requirement] & self.executing.get(method, set()) & set(self.seconds)

    def timed(self, tests: set[str]) -> dict[str, float]:
        return {name: self.seconds[name] for name in sorted(tests) if name in self.seconds}


@dataclass
class Tried:
    """A mutant that was tried, with the tests that found it. For each requirement, ``own`` states
    whether a test of the requirement found the mutant.

    If no test of a requirement failed, and some of these tests have no result, ``own`` contains no
    value for this requirement."""

    mutant: Mutant
    killed_by: list[str]
    own: dict[str, bool]


def make_plan(model: Model, facts: Facts, traces: Traces, functions: Iterable[str]) -> Plan:
    """Returns the tests for the functions that have mutants. Only the invocation trees count here:
    a function outside them has no requirement, even if its comment has the tag @satisfies."""
    plan = Plan({name: [] for name in functions}, {}, {})
    for requirement in model.requirements.values():
        if requirement.tree is None:
            continue
        for node in nodes_of(requirement.tree):
            for method in accepted(node, facts):
                held = plan.methods.setdefault(method, [])
                if requirement.id not in held:
                    held.append(requirement.id)
        plan.verifying[requirement.id] = {
            name for name in requirement.verified_by if HOST in model.tests[name].gave("passed")
        }
    for test in model.tests.values():
        if HOST not in test.gave("passed"):
            continue
        for method in executed(traces, test, set(plan.methods)):
            plan.executing.setdefault(method, set()).add(test.id)
    return plan


def executed(traces: Traces, test: Test, methods: set[str]) -> set[str]:
    """Returns the called methods: each given method that was called by the test. If the recording
    of the test is incomplete, returns all given methods.

    The recording of a death test is always incomplete, because the test runs in a separate process
    that is not recorded."""
    known = [name for name in test.results[HOST].recordings if name in traces.tests]
    if test.suite.endswith("DeathTest") or any(
        traces.file(name).with_suffix(".truncated").exists() for name in known
    ):
        return methods
    return {method for name in known for method in traces.functions(name)} & methods


def order(mutants: list[Mutant], plan: Plan, seed: int) -> list[int]:
    """Returns the numbers of the mutants in random order. The order consists of rounds: each round
    adds one mutant for each requirement."""
    numbers = list(range(1, len(mutants) + 1))
    random.Random(seed).shuffle(numbers)
    waiting: dict[str, list[int]] = {name: [] for name in plan.verifying}
    for number in numbers:
        for name in plan.methods.get(mutants[number - 1].method) or [NO_REQUIREMENT]:
            waiting.setdefault(name, []).append(number)
    queues: dict[str, Iterator[int]] = {name: iter(held) for name, held in waiting.items()}
    chosen: dict[int, None] = {}
    while queues:
        for name in list(queues):
            following = next((one for one in queues[name] if one not in chosen), None)
            if following is None:
                del queues[name]
            else:
                chosen[following] = None
    return list(chosen)


def measure(program: Path, plan: Plan, seconds: dict[str, float]) -> list[str]:
    """Records the time of each test that passes without a mutant. Returns the tests that do not
    pass."""
    names = set().union(*plan.executing.values()) if plan.executing else set()
    wanted = {name: seconds.get(name, 1.0) for name in sorted(names)}
    outcome = run_tests(program, 0, wanted)
    plan.seconds = {name: wanted[name] for name in sorted(outcome.passed)}
    return sorted(names - outcome.passed)


def try_mutant(program: Path, number: int, mutant: Mutant, plan: Plan) -> Tried | None:
    """Runs the tests of the requirements that the changed method serves, if these tests execute the
    method. If no test finds the mutant, runs the other tests that execute the method. Returns None
    if no test found the mutant and some tests did not end."""
    own = {name: plan.own(mutant.method, name) for name in plan.methods[mutant.method]}
    outcome = run_until_found(program, number, plan, list(own.values()))
    if not outcome.failed:
        others = plan.executing.get(mutant.method, set()).difference(*own.values())
        rest = run_until_found(program, number, plan, [others])
        outcome.failed |= rest.failed
        outcome.passed |= rest.passed
    executing = plan.executing.get(mutant.method, set()) & plan.seconds.keys()
    if not outcome.failed and not executing <= outcome.passed:
        return None
    found = {name: _found(outcome, tests) for name, tests in own.items()}
    decided = {name: one for name, one in found.items() if one is not None}
    return Tried(mutant, sorted(outcome.failed), decided)


def run_until_found(program: Path, number: int, plan: Plan, groups: list[set[str]]) -> Outcome:
    """Runs the tests of the groups. The short tests run first. A group is finished when one of its
    tests has found the mutant, or when all its tests have run. The run ends when all groups are
    finished. It also ends if tests hang.

    The tests run in parts. Each part takes a multiple of the time of the previous part. Therefore,
    the program starts only a few times."""
    outcome = Outcome()
    most = FIRST_PART
    while open_groups := [group for group in groups if not group & outcome.failed]:
        waiting = plan.timed(set().union(*open_groups) - outcome.passed - outcome.failed)
        part: dict[str, float] = {}
        for name, seconds in sorted(waiting.items(), key=lambda one: one[1]):
            if not part or sum(part.values()) + seconds <= most:
                part[name] = seconds
        result = run_tests(program, number, part)
        outcome.failed |= result.failed
        outcome.passed |= result.passed
        if not part or not part.keys() <= result.failed | result.passed:
            break  # No test is left, or tests hang.
        most *= PART_GROWTH
    return outcome


def _found(outcome: Outcome, tests: set[str]) -> bool | None:
    """Returns true if a test failed, and false if all tests passed. Otherwise, returns None."""
    if tests & outcome.failed:
        return True
    return False if tests <= outcome.passed else None


def try_all(
    program: Path,
    mutants: list[Mutant],
    numbers: Iterator[int],
    plan: Plan,
    goes_on: Callable[[list[Tried]], bool],
) -> list[Tried]:
    """Tries the mutants in the order of ``numbers``, as long as ``goes_on`` returns true for the
    results so far."""
    tried: list[Tried] = []

    def work() -> None:
        while goes_on(tried):
            number = next(numbers, None)
            if number is None:
                return
            result = try_mutant(program, number, mutants[number - 1], plan)
            if result is not None:
                tried.append(result)

    workers = int(jobs())
    with ThreadPoolExecutor(workers) as pool:
        for done in [pool.submit(work) for _ in range(workers)]:
            done.result()
    return tried


def found_before(
    last: Mapping[str, Any], mutants: list[Mutant], files: Mapping[str, str], plan: Plan
) -> dict[int, Tried]:
    """Returns the last results of found mutants, by number. Two conditions must be met. First, the
    file of the mutant is unchanged. Second, at least one of the tests that found the mutant has
    passed without a mutant in this run.

    Equal changes of a method are one group. The result contains a group only if the last run found
    each of its mutants."""
    results: dict[tuple[str, ...], list[dict[str, Any]]] = {}
    for item in last.get("tried", []):
        results.setdefault(_group(Mutant(*(item[name] for name in MUTANT))), []).append(item)
    numbers: dict[tuple[str, ...], list[int]] = {}
    for number, mutant in enumerate(mutants, 1):
        if last.get("files", {}).get(mutant.file) == files[mutant.file]:
            numbers.setdefault(_group(mutant), []).append(number)
    found: dict[int, Tried] = {}
    for group, held in numbers.items():
        items = results.get(group, [])
        killers = [set(item["killed_by"]) & plan.seconds.keys() for item in items]
        if len(items) == len(held) and all(killers):
            for number, item in zip(held, items, strict=True):
                found[number] = Tried(mutants[number - 1], item["killed_by"], item["own"])
    return found


def _group(mutant: Mutant) -> tuple[str, ...]:
    return (mutant.file, mutant.method, mutant.kind, mutant.change)


def file_hashes(root: Path, mutants: Iterable[Mutant]) -> dict[str, str]:
    files = sorted({mutant.file for mutant in mutants})
    return {file: hashlib.sha256((root / file).read_bytes()).hexdigest() for file in files}


class Justifications:
    """The entries of design/mutants.toml."""

    def __init__(self, root: Path, entries: Iterable[Equivalent]) -> None:
        self.root = root
        self.reasons: dict[tuple[str, ...], list[str]] = {}
        for entry in entries:
            for change in entry.changes:
                key = (entry.file, entry.method, entry.line, change)
                self.reasons.setdefault(key, []).append(entry.why)
        self.lines: dict[str, list[str]] = {}

    def reasons_of(self, mutants: Iterable[Mutant]) -> list[str]:
        """For each mutant, returns the reason why no test can find it. The reason is empty if the
        mutant has no justification.

        An entry lists changes. Each of these changes belongs to one mutant. If a source line can
        have the same change at several places, the entry lists the change once for each place at
        which no test can find the change."""
        left = {key: list(reasons) for key, reasons in self.reasons.items()}
        return [
            reasons.pop() if (reasons := left.get(self._key(mutant))) else "" for mutant in mutants
        ]

    def _key(self, mutant: Mutant) -> tuple[str, ...]:
        if mutant.file not in self.lines:
            text = (self.root / mutant.file).read_text(encoding="utf-8")
            self.lines[mutant.file] = [line.strip() for line in text.splitlines()]
        line = self.lines[mutant.file][mutant.line - 1]
        return mutant.file, mutant.method, line, mutant.change


def record(
    tried: Iterable[Tried], origin: Mapping[str, Any], total: int, justified: Justifications
) -> dict[str, Any]:
    """Returns the record from which the model computes its scores."""
    listed = sorted(tried, key=lambda one: (one.mutant.file, one.mutant.line))
    reasons = iter(justified.reasons_of(one.mutant for one in listed if not one.killed_by))
    return {
        **origin,
        "total": total,
        "tried": [
            {
                **asdict(one.mutant),
                "killed_by": one.killed_by,
                "own": one.own,
                "why": "" if one.killed_by else next(reasons),
            }
            for one in listed
        ],
    }
