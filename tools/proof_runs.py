"""Runs the model checker Spin for each property of the state machines."""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import TextIO

from tools.steps import FailureError
from tools.task_graph import Outcome
from traceability.model.build import commit
from traceability.model.promela import ROBOT, whole
from traceability.reading.declared import Declared, read_declared
from traceability.reading.proof_record import FOLDER, PROOFS, PROVE, SCENARIOS
from traceability.reading.proof_record import scenario as scenario_of
from traceability.reading.published import publish, read_published
from traceability.schema import ProofProperty, ProofResult
from traceability.whole_file import write_json, write_whole

RECORD = "proofs"  # name of the record of complete runs; the record has the hashes of the models
SPIN, COMPILER = "spin", "cc"
SECONDS = 900  # time limit of each step of a proof [s]
DEPTH = 5_000_000  # steps
# Depths of the searches for a counterexample. Spin begins with the smallest depth. If it finds no
# counterexample, it searches with the next depth. A short counterexample is easier to read.
SHORT = (100, 200, 300, 400, 600, 800, 1200, 2000, 4000)
MEMORY_MB = 6000
WORKERS = 2
OPTIONS = ("-O2", "-w", "-DNOFAIR", "-DVECTORSZ=512", f"-DMEMLIM={MEMORY_MB}")
STATES = re.compile(r"^\s*(\d+) states, stored", re.MULTILINE)
REACHED = re.compile(r"depth reached (\d+), errors: (\d+)")
EVENT = re.compile(
    r"(?:^|\s)(round|event [\w-]+|transition [\w-]+ \w+ \w+)$|(START OF CYCLE)", re.MULTILINE
)


def missing_program() -> str:
    """Returns the name of a missing program, if a proof needs this program. The result is empty if
    no program is missing."""
    return next((name for name in (SPIN, COMPILER) if shutil.which(name) is None), "")


def prove_all(root: Path, log: TextIO) -> Outcome:
    """Proves the properties that have no recorded result. Writes the results of all properties."""
    if missing := missing_program():
        return Outcome(f"not run in this build, because {missing} is not installed")
    declared = read_declared(root)
    if declared.entries.unreadable:
        raise FailureError(f"{declared.entries.unreadable[0]} cannot be read")

    def said(text: str) -> None:
        log.write(f"{text}\n")
        log.flush()

    recorded = recorded_proofs(root, declared)
    left = [proof for proof in declared.proofs.values() if proof.name not in recorded]
    results = recorded | prove(root, declared, left, said)
    write_json(root / PROOFS, {name: asdict(result) for name, result in results.items()})
    proven = sum(result.verdict == "proven" for result in results.values())
    states = sum(result.states for result in results.values())
    summary = f"{proven} of {len(results)} properties proven, {states} states"
    if recorded:
        summary += f"; the results of {len(recorded)} properties are from the record"
    return Outcome(summary, failed=proven < len(results))


def prove(
    root: Path, declared: Declared, properties: Iterable[ProofProperty], say: Callable[[str], None]
) -> dict[str, ProofResult]:
    """Proves properties. Several proofs run in parallel. Prints the result of each property, in the
    given order."""
    listed = list(properties)
    results: dict[str, ProofResult] = {}
    with ThreadPoolExecutor(WORKERS) as pool:
        made = pool.map(partial(prove_one, root, declared), listed)
        for number, (proven, result) in enumerate(zip(listed, made, strict=True), 1):
            results[proven.name] = result
            say(
                f"[{number}/{len(listed)}] {proven.name}: {result.verdict}, "
                f"{result.states} states, depth {result.depth}, {result.seconds:.1f} s"
            )
            for line in result.events:
                say(f"        {line}")
    return results


def record_proofs(root: Path, declared: Declared, results: Mapping[str, ProofResult]) -> Path:
    """Writes the record of the properties that a run has proven."""
    proven = {
        name: {"model": model_hash(root, declared, declared.proofs[name]), **asdict(result)}
        for name, result in results.items()
        if result.verdict == "proven"
    }
    return publish(root, RECORD, PROVE, commit(root), proven)


def recorded_proofs(root: Path, declared: Declared) -> dict[str, ProofResult]:
    """Returns the recorded results whose models are equal to the present models, byte by byte."""
    record = read_published(root, RECORD)
    results: dict[str, ProofResult] = {}
    for name, proof in declared.proofs.items():
        values = dict(record.result.get(name, {})) if record else {}
        if record and values.pop("model", "") == model_hash(root, declared, proof):
            results[name] = replace(
                ProofResult(**values), recorded=record.commit, recorded_on=record.date
            )
    return results


def model_hash(root: Path, declared: Declared, proof: ProofProperty) -> str:
    """Returns the hash of a model and of the options of its search."""
    words = [*OPTIONS, str(DEPTH), model_of(root, declared, proof)]
    return hashlib.sha256("\n".join(words).encode()).hexdigest()


def model_of(root: Path, declared: Declared, proof: ProofProperty) -> str:
    robot = (root / ROBOT).read_text(encoding="utf-8")
    return whole(declared.machines, robot, proof)


def prove_one(root: Path, declared: Declared, proof: ProofProperty) -> ProofResult:
    begin = time.monotonic()
    said = search(root, declared, proof)
    return judged(root, declared, proof, said, time.monotonic() - begin)


def search(root: Path, declared: Declared, proof: ProofProperty) -> str:
    """Searches all states for a violation of a property. Returns the output of the verifier."""
    folder = root / FOLDER / proof.name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    model = model_of(root, declared, proof)
    (folder / "model.pml").write_text(model, encoding="utf-8")
    call(folder, proof, [SPIN, "-a", "model.pml"])
    call(folder, proof, [COMPILER, *OPTIONS, "-o", "pan", "pan.c"])
    return call(folder, proof, ["./pan", "-a", "-n", f"-m{DEPTH}"])


def judged(
    root: Path, declared: Declared, proof: ProofProperty, said: str, seconds: float
) -> ProofResult:
    """Reads the result of a proof from the output of the verifier. If a counterexample can be
    played as a scenario, also writes this scenario."""
    states, reached = STATES.search(said), REACHED.search(said)
    if not states or not reached:
        raise FailureError(f"{proof.name}: the verifier printed no result: {said[-300:]}")
    count, depth = int(states[1]), int(reached[1])
    if reached[2] != "0":
        events = counterexample(root, proof)
        text = scenario_of(proof, events, declared.proof_events)
        file = ""
        if text:
            path = root / SCENARIOS / f"{proof.name}.scenario"
            write_whole(path, text)
            file = str(path.relative_to(root))
        return ProofResult("false", count, depth, round(seconds, 1), events, file)
    limited = "max search depth too small" in said or "out of memory" in said
    verdict = "incomplete" if limited or "Search not completed" in said else "proven"
    return ProofResult(verdict, count, depth, round(seconds, 1))


def counterexample(root: Path, proof: ProofProperty) -> list[str]:
    """Returns the cycles, events and transitions that lead to the violation of a property."""
    folder = root / FOLDER / proof.name
    call(folder, proof, [COMPILER, *OPTIONS, "-DREACH", "-o", "pan", "pan.c"])
    for depth in SHORT:
        said = call(folder, proof, ["./pan", "-a", "-n", f"-m{depth}"])
        reached = REACHED.search(said)
        if reached and reached[2] != "0":
            break
    said = call(folder, proof, [SPIN, "-t", "model.pml"])
    steps = [match[1] or "the following steps repeat for ever:" for match in EVENT.finditer(said)]
    return steps or ["the counterexample has no event"]


def call(folder: Path, proof: ProofProperty, words: Sequence[str]) -> str:
    """Runs a program of a proof. Returns its output."""
    try:
        done = subprocess.run(
            words, cwd=folder, capture_output=True, text=True, timeout=SECONDS, check=False
        )
    except subprocess.TimeoutExpired as error:
        text = f"{proof.name}: {words[0]} did not end within {SECONDS} s"
        raise FailureError(text) from error
    said = done.stdout + done.stderr
    if done.returncode != 0 and words[0] != "./pan":
        errors = [line for line in said.splitlines() if "rror" in line]
        raise FailureError(f"{proof.name}: {words[0]}: {'; '.join(errors[:3]) or said[-300:]}")
    return said
