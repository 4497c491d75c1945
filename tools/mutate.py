"""./wr mutate: inserts faults in the firmware and its extensions, and counts the faults that the
tests find."""

from __future__ import annotations

import argparse
import random
import time
from pathlib import Path
from typing import TextIO

from tools.lock import only_one
from tools.mutation.points import Mutant
from tools.mutation.score import (
    RESULT,
    Justifications,
    Plan,
    Tried,
    file_hashes,
    found_before,
    make_plan,
    measure,
    order,
    record,
    try_all,
)
from tools.mutation.switched import PROGRAM, build_switched, write_switched
from tools.steps import FailureError, Steps
from tools.tasks import graph
from traceability.model.build import build
from traceability.model.design_model import Model
from traceability.reading.published import publish
from traceability.reading.results import read_json
from traceability.reading.task_record import TESTS_TRACE
from traceability.reading.traces import read_traces
from traceability.schema import HOST
from traceability.whole_file import write_json

STEPS = 4
LONGEST = 240.0  # [minutes]
USUAL = 45.0  # [minutes]
SHOWN_EVERY = 10.0  # seconds


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "mutate",
        description="Builds a copy of the firmware that contains small faults in the functions of "
        "the firmware and its extensions. Each fault has a number. For each fault, the "
        "command runs the tests of the requirements that the function serves. If none of "
        "these tests finds the fault, the command runs the other tests that execute the "
        "function. The portal shows the score, "
        "which is not a pass criterion. design/mutants.toml justifies faults that cannot be found "
        "by a test. If any other fault is not found, the command lists it as file:line, with the "
        "change.",
    )
    parser.add_argument(
        "--minutes",
        type=minutes,
        default=USUAL,
        help=f"longest time of the run [min], up to {LONGEST:g} (default: {USUAL:g})",
    )
    parser.add_argument(
        "--seed",
        type=int,
        help="seed of the sequence in which the faults are tried (default: a new seed)",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="skip the faults that the last run found, if their files have not changed since",
    )
    parser.add_argument(
        "--publish",
        action="store_true",
        help="also write the score to a file in tests/records; then commit this file",
    )
    parser.set_defaults(run=mutate)


def minutes(text: str) -> float:
    value = float(text)
    if not 0 < value <= LONGEST:
        raise argparse.ArgumentTypeError(f"from more than 0 to {LONGEST:g}")
    return value


def mutate(root: Path, options: argparse.Namespace) -> int:
    steps = Steps(root, STEPS)
    seed = random.SystemRandom().randrange(1 << 16) if options.seed is None else options.seed
    run = _Run(root, seed, options.minutes, options.resume, steps.out)
    with only_one(root, "mutate"):
        print(f"seed {seed}")
        ready = not graph(root).run([TESTS_TRACE]).failed
        for title, action in (
            ("mutants", run.generate),
            ("mutated build", run.build),
            ("tests without a mutant", run.measure),
            ("tests with mutants", run.attempt),
        ):
            if ready:
                ready = steps.run(title, action)
            else:
                steps.skip(title, "an earlier step failed")
    if not ready:
        return 1
    if options.publish:
        command = f"./wr mutate --minutes {options.minutes:g} --seed {seed}"
        score = {
            "found": run.killed(),
            "justified": run.justified(),
            "tried": len(run.tried),
            "total": len(run.mutants),
        }
        publish(root, "mutation", command, run.model.commit, score)
    for mutant in run.survivors():
        print(f"{mutant.file}:{mutant.line}: no test finds this change: {mutant.change}")
    print(
        f"{run.killed()} of {len(run.tried)} mutants were found, and {run.justified()} others are "
        f"justified; seed {seed}; {RESULT}"
    )
    return 0


class _Run:
    """The steps of a mutation test. Each step passes its results to the next step."""

    def __init__(self, root: Path, seed: int, longest: float, resume: bool, out: TextIO) -> None:
        self.root = root
        self.out = out
        self.seed = seed
        self.longest = 60 * longest
        self.resume = resume
        self.took = 0.0
        self.model: Model
        self.plan: Plan
        self.justifications: Justifications
        self.mutants: list[Mutant] = []
        self.files: dict[str, str] = {}  # file with mutants -> its hash
        self.tried: list[Tried] = []

    def generate(self, log: TextIO) -> str:
        self.model, facts = build(self.root)
        traces = read_traces(self.root, self.root / "build" / "model")[HOST]
        self.mutants = write_switched(self.root, log)
        self.justifications = Justifications(self.root, facts.declared.equivalents)
        functions = {mutant.method for mutant in self.mutants}
        self.plan = make_plan(self.model, facts, traces, functions)
        return f"{len(self.mutants)} in {len(functions)} functions"

    def build(self, log: TextIO) -> None:
        build_switched(self.root, log)

    def measure(self, log: TextIO) -> str:
        known = {
            test.id: (test.results[HOST].milliseconds or 0) / 1000
            for test in self.model.tests.values()
            if HOST in test.results
        }
        failing = measure(self.root / PROGRAM, self.plan, known)
        for name in failing:
            log.write(f"{name} does not pass in the mutated build, and is left out\n")
        if not self.plan.seconds:
            raise FailureError("no test passes in the mutated build")
        left_out = f", {len(failing)} left out" if failing else ""
        return f"{len(self.plan.seconds)} passed{left_out}"

    def attempt(self, _log: TextIO) -> str:
        self.files = file_hashes(self.root, self.mutants)
        last = read_json(self.root / RESULT) if self.resume else None
        before = found_before(last or {}, self.mutants, self.files, self.plan)
        start = shown = time.monotonic()

        def goes_on(tried: list[Tried]) -> bool:
            nonlocal shown
            self.tried = [*before.values(), *tried]
            now = time.monotonic()
            self.took = (now - start) / 60
            if now - shown >= SHOWN_EVERY:
                shown = now
                self.show(now - start)
                self.write()
            return now - start < self.longest

        chosen = order(self.mutants, self.plan, self.seed)
        numbers = iter([number for number in chosen if number not in before])
        try_all(self.root / PROGRAM, self.mutants, numbers, self.plan, goes_on)
        self.took = (time.monotonic() - start) / 60
        self.write()
        return (
            f"{self.killed()} of {len(self.tried)} tried mutants found; "
            f"{len(self.mutants)} mutants in total"
        )

    def write(self) -> None:
        """Writes the record of the mutants that were tried until now. If the run is
        interrupted, these results are not lost."""
        origin = {
            "sources": self.model.sources_hash,
            "commit": self.model.commit,
            "files": self.files,
            "seed": self.seed,
            "minutes": round(self.took, 1),
        }
        result = record(self.tried, origin, len(self.mutants), self.justifications)
        write_json(self.root / RESULT, result)

    def survivors(self) -> list[Mutant]:
        """Returns the mutants that were not found by a test, except the justified mutants of
        design/mutants.toml."""
        missed = [one.mutant for one in self.tried if not one.killed_by]
        reasons = self.justifications.reasons_of(missed)
        return [mutant for mutant, why in zip(missed, reasons, strict=True) if not why]

    def justified(self) -> int:
        return len(self.tried) - self.killed() - len(self.survivors())

    def killed(self) -> int:
        return sum(bool(tried_mutant.killed_by) for tried_mutant in self.tried)

    def show(self, seconds: float) -> None:
        clock = f"{int(seconds // 60)}:{int(seconds % 60):02}"
        print(
            f"\n  {clock} {len(self.tried)} of {len(self.mutants)} tried, {self.killed()} found",
            end=" ",
            file=self.out,
            flush=True,
        )
