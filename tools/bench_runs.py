"""Plays the scenarios of the paper on the virtual K64, and records the cost of the runs."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any, TextIO

from tools.cmake_build import board_words
from tools.steps import FailureError, run
from traceability.reading.bench_record import (
    BENCH,
    FOLDER,
    MANUAL,
    PAPER_BENCH,
    SCENARIOS,
    SLOW,
    TIMINGS,
    Paper,
    Record,
    bench_run,
    profile,
)
from traceability.reading.products import DEFAULT, PAPER, image_of
from traceability.schema import BenchRun, BenchScenario
from traceability.whole_file import write_json

SECONDS = 600  # time limit of a run


def measure_all(root: Path, log: TextIO) -> str:
    """Plays the scenarios of the paper with the firmware image of the robot, and with a firmware
    image without extensions."""
    record: Record = {}
    notes = [f"{paper.title}: {measure(root, paper, record, log)}" for paper in SCENARIOS]
    keep(root, BENCH, record)
    notes.append(f"the paper's design alone: {measure_paper(root, log)}")
    log.write("\n".join(notes) + "\n")
    return f"{len(SCENARIOS)} scenarios"


def measure_paper(root: Path, log: TextIO) -> str:
    """Plays the scenarios with the firmware image of the product that has no safety functions. A
    comparison with the times of the robot shows the cost of these functions."""
    record: Record = {}
    for paper in SCENARIOS:
        raw, _ = play(root, log, paper.name, MANUAL, product=PAPER)
        record[paper.name] = BenchScenario({MANUAL: bench_run(raw)})
    keep(root, PAPER_BENCH, record)
    most = max(scenario.runs[MANUAL].report_ms.maximum for scenario in record.values())
    return f"at most {most:.3f} ms"


def keep(root: Path, path: Path, record: Record) -> None:
    write_json(root / path, {name: asdict(scenario) for name, scenario in record.items()})


def measure(root: Path, paper: Paper, record: Record, log: TextIO) -> str:
    """Plays a scenario with each timing model of the memory. Then plays the scenario again, and
    counts each instruction."""
    runs: dict[str, BenchRun] = {}
    for timing in TIMINGS:
        raw, user = play(root, log, paper.name, timing)
        runs[timing] = bench_run(raw, round(raw["simulated_ns"] / 1e9 / user, 1))
    counted, _ = play(root, log, paper.name, MANUAL, "--profile")
    if bench_run(counted).instructions != runs[MANUAL].instructions:
        raise FailureError("two runs of the same scenario did not execute the same instructions")
    record[paper.name] = BenchScenario(runs, profile(counted, root))
    normal, slow, speed = runs[MANUAL].report_ms, runs[SLOW].report_ms, runs[MANUAL].speed
    return (
        f"report after {normal.average:.3f} ms on average, at most {normal.maximum:.3f} ms; "
        f"with slow flash {slow.average:.3f} ms, at most {slow.maximum:.3f} ms; "
        f"the simulation ran {speed} times as fast as real time"
    )


def play(
    root: Path, log: TextIO, name: str, timing: str, *more: str, product: str = DEFAULT
) -> tuple[dict[str, Any], float]:
    """Returns the measurements of the board program, and the time that the program needed on one
    processor core [s]."""
    output = root / "build" / "bench" / f"{product}-{name}-{timing}.json"
    output.parent.mkdir(parents=True, exist_ok=True)
    output.unlink(missing_ok=True)
    words = [
        *board_words(root, image_of(product, ".bin")),
        *("--scenario", str(root / FOLDER / f"{name}.scenario"), "--timing", timing),
        *("--bench", str(output), *more),
    ]
    try:
        user = run(log, ["timeout", str(SECONDS), *words])
    except FailureError as error:
        raise FailureError(f"{product} in {name}: {error}") from error
    raw: dict[str, Any] = json.loads(output.read_text(encoding="utf-8"))
    return raw, user
