"""./wr bench: the paper's four scenarios, measured on the image that is flashed."""

from __future__ import annotations

import argparse
import json
import re
import resource
import subprocess
import time
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TextIO

from weeding_robot_client.link import Link
from weeding_robot_client.messages import Quantity, Report
from weeding_robot_client.options import positive
from weeding_robot_client.orders import Orders as Sender
from weeding_robot_client.orders import arm, connect, not_connected
from weeding_robot_client.script import Wish

from traceability.commands.builds import (
    BOARD_PROGRAM,
    build_for_board,
    require_counts,
    run_tests,
)
from traceability.commands.firmware import build_k64
from traceability.commands.steps import FailureError, Steps
from traceability.commands.usual_design import compare
from traceability.model.bench import (
    BENCH,
    FOLDER,
    MANUAL,
    PAPER_BENCH,
    PERIOD_MS,
    SCENARIOS,
    SLOW,
    SPEED_LEAST,
    TIMINGS,
    Paper,
    figures,
    measured_with,
    profile,
    read_bench,
    read_paper_bench,
    spread,
)
from traceability.model.results import PLAIN
from traceability.products import DEFAULT, PAPER, image_of

SECONDS = 600  # for one run
CORE_PER_MS = 120_000
ORDER = re.compile(r"from (\d+) to (\d+) every (\d+) order velocity (-?\d+)(?: steering (-?\d+))?$")


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "bench",
        help="measure the control cycle in the paper's four scenarios",
        description="Builds the image for the K64 and plays the paper's four scenarios with it on "
        "the virtual K64 in the simulated robot, 1000 control cycles each: instructions, time from "
        "the clock pulse to the report, load, latencies, and the speed of the simulator. Compares "
        "the patterns with the usual design, and what it costs to record the calls of each test. "
        "With --port, gives the same orders to a connected board and takes the cycles that its "
        "reports tell. Lift the robot: its wheels will turn with up to 300 rpm. The orders are "
        "those of a PC: no remote control is needed, it may be off.",
    )
    parser.add_argument("--port", type=Path, help="serial port of a board that has the image")
    parser.add_argument(
        "--seconds", type=positive, help="with --port: end each scenario after this time"
    )
    parser.set_defaults(run=lambda root, options: bench(root, options, parser))


def bench(root: Path, options: argparse.Namespace, parser: argparse.ArgumentParser) -> int:
    if options.seconds and not options.port:
        parser.error(f"--seconds {options.seconds} needs --port")
    if options.port:
        return on_board(root, options.port, options.seconds)
    steps = Steps(root, 6 + len(SCENARIOS))
    build_k64(root, steps)
    steps.run("virtual K64", lambda log: build_for_board(root, log, BOARD_PROGRAM))
    if steps.failed:
        return 1
    record: dict[str, Any] = {**measured_with(root), "scenarios": {}}
    for paper in SCENARIOS:
        steps.run(paper.title, partial(measure, root, paper, record))
    steps.run("the paper's design alone", partial(measure_paper, root))
    steps.run("the usual design beside the patterns", partial(compare, root))
    if len(record["scenarios"]) == len(SCENARIOS):
        keep(root, BENCH, record)
    for name in ("trace", PLAIN):
        steps.run(f"tests ({name})", partial(run_counted, root, name))
    return 1 if steps.failed else 0


def run_counted(root: Path, name: str, log: TextIO) -> str:
    """Runs the tests of a preset: what the records of the one cost beside the other is a figure."""
    return require_counts(*run_tests(root, name, log))


def add_bench(root: Path, steps: Steps) -> None:
    """The bench as two steps of a longer run, which measure what has changed."""
    if "firmware (K64)" in steps.failed:
        steps.skip("bench", "there is no image")
        steps.skip("bench of the usual design", "there is no image")
    else:
        steps.run("bench", partial(measure_all, root))
        steps.run("bench of the usual design", partial(compare, root))


def measure_all(root: Path, log: TextIO) -> str:
    """Plays the scenarios, unless they were measured with these sources and this image."""
    note = f"{len(SCENARIOS)} scenarios"
    if read_bench(root) is not None and read_paper_bench(root) is not None:
        return f"{note} (unchanged)"
    (root / BENCH).unlink(missing_ok=True)
    build_for_board(root, log, BOARD_PROGRAM)
    record: dict[str, Any] = {**measured_with(root), "scenarios": {}}
    for paper in SCENARIOS:
        measure(root, paper, record, log)
    keep(root, BENCH, record)
    measure_paper(root, log)
    return note


def measure_paper(root: Path, log: TextIO) -> str:
    """Plays the scenarios with the product without safety functions."""
    (root / PAPER_BENCH).unlink(missing_ok=True)
    record: dict[str, Any] = {**measured_with(root, PAPER), "scenarios": {}}
    for paper in SCENARIOS:
        raw, _ = play(root, log, paper.name, MANUAL, product=PAPER)
        record["scenarios"][paper.name] = {MANUAL: figures(raw)}
    keep(root, PAPER_BENCH, record)
    most = max(runs[MANUAL]["report_ms"]["maximum"] for runs in record["scenarios"].values())
    return f"at most {most:.3f} ms"


def keep(root: Path, path: Path, record: dict[str, Any]) -> None:
    (root / path).parent.mkdir(parents=True, exist_ok=True)
    (root / path).write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def measure(root: Path, paper: Paper, record: dict[str, Any], log: TextIO) -> str:
    """Plays a scenario with each model of time, and once more to count each instruction."""
    runs: dict[str, Any] = {}
    for timing in TIMINGS:
        raw, user = play(root, log, paper.name, timing)
        runs[timing] = figures(raw)
        runs[timing]["speed"] = round(raw["simulated_ns"] / 1e9 / user, 1)
    counted, _ = play(root, log, paper.name, MANUAL, "--profile")
    if figures(counted)["instructions"] != runs[MANUAL]["instructions"]:
        raise FailureError("two runs of the same scenario executed not the same instructions")
    runs["profile"] = profile(counted, root)
    record["scenarios"][paper.name] = runs
    manual, slow, speed = runs[MANUAL], runs[SLOW], runs[MANUAL]["speed"]
    if speed < SPEED_LEAST:
        raise FailureError(f"the simulator has {speed} times real time, not {SPEED_LEAST}")
    return (
        f"{manual['report_ms']['average']:.3f} ms, at most {manual['report_ms']['maximum']:.3f}; "
        f"slow flash {slow['report_ms']['average']:.3f} and {slow['report_ms']['maximum']:.3f}; "
        f"{speed} times real time"
    )


def play(
    root: Path, log: TextIO, name: str, timing: str, *more: str, product: str = DEFAULT
) -> tuple[dict[str, Any], float]:
    """What the board program measured, and the seconds of one core that it took."""
    output = root / "build" / "bench" / f"{product}-{name}-{timing}.json"
    output.parent.mkdir(parents=True, exist_ok=True)
    output.unlink(missing_ok=True)
    program = root / "build" / "host" / "sim" / BOARD_PROGRAM
    words = [
        *(str(program), "--image", str(root / image_of(product, ".bin"))),
        *("--elf", str(root / image_of(product, ".elf"))),
        *("--scenario", str(root / FOLDER / f"{name}.scenario"), "--timing", timing),
        *("--bench", str(output), *more),
    ]
    log.write(f"$ {' '.join(words)}\n")
    log.flush()
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    try:
        ended = subprocess.run(
            words, stdout=log, stderr=subprocess.PIPE, timeout=SECONDS, check=False, text=True
        )
    except subprocess.TimeoutExpired as error:
        raise FailureError(f"{name} did not end within {SECONDS} s") from error
    user = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    log.write(ended.stderr)
    if ended.returncode != 0:
        reason = (ended.stderr.splitlines() or ["no expectation failed"])[0]
        raise FailureError(f"{product} in {name} ended with exit code {ended.returncode}: {reason}")
    raw: dict[str, Any] = json.loads(output.read_text(encoding="utf-8"))
    return raw, user


# ---- on a board --------------------------------------------------------------


@dataclass(frozen=True)
class Orders:
    """The same order every 100 ms in a stretch of time [s]."""

    first: float
    last: float
    wish: Wish


def orders_of(text: str) -> list[Orders]:
    """The orders of a scenario of the bench."""
    found = []
    for line in text.splitlines():
        if match := ORDER.match(line.strip()):
            first, last, _, velocity, steering = match.groups(default="0")
            wish = Wish.of(Quantity.VELOCITY, int(velocity) / 10, int(steering) / 100)
            found.append(Orders(int(first) / 1000, int(last) / 1000, wish))
    return found


def wishes(orders: list[Orders], seconds: float | None) -> Iterator[Wish]:
    """One wish for each cycle of 100 ms, to the end or so many seconds."""
    end = orders[-1].last if seconds is None else min(orders[-1].last, orders[0].first + seconds)
    for one in orders:
        cycles = round((min(one.last, end) - one.first) * 1000 / PERIOD_MS) + 1
        for _ in range(max(cycles, 0)):
            yield one.wish


def on_board(root: Path, port: Path, seconds: float | None) -> int:
    """Gives the orders of the scenarios to a board, and adds what it measured to the record."""
    path = root / BENCH
    try:
        record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        record = {**measured_with(root), "scenarios": {}}
    for paper in SCENARIOS:
        text = (root / FOLDER / f"{paper.name}.scenario").read_text(encoding="utf-8")
        print(f"{paper.title} ... ", end="", flush=True)
        try:
            found = costs(drive(port, wishes(orders_of(text), seconds)))
        except FailureError as error:
            print(f"FAILED: {error}")
            return 1
        record["scenarios"].setdefault(paper.name, {})["board"] = found
        times = found["report_ms"]
        print(f"{times['average']:.3f} ms, at most {times['maximum']:.3f}, load "
              f"{found['load']['average']:.2f} %, {found['cycles']} cycles")  # fmt: skip
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    return 0


def drive(port: Path, wanted: Iterator[Wish]) -> list[Report]:
    """Arms the robot and orders each wish for a cycle; returns the reports."""
    try:
        link = Link(port)
    except OSError as error:
        raise FailureError(str(error)) from error
    with link:
        sender = Sender(link)
        if not connect(sender):
            raise FailureError(not_connected(link))
        if reason := arm(sender):
            raise FailureError(f"the robot is not armed. {reason}")
        reports = []
        due = time.monotonic()
        wish = Wish()
        for wish in wanted:
            sender.send(wish)
            due += PERIOD_MS / 1000
            while (left := due - time.monotonic()) > 0:
                reports += link.service(left)
            if not link.connected:
                raise FailureError("the connection was lost")
        sender.end(wish)
    return reports


def costs(reports: list[Report]) -> dict[str, Any]:
    """The figures that a board tells of itself. The first cycles belong to what was before."""
    told = [report for report in reports if report.order_read][2:]
    if not told:
        raise FailureError("no report of a cycle that read an order")
    if not any(report.awake_cycles for report in told):
        raise FailureError("what answers counts no processor cycles")
    starts = [report.start_cycles for report in told]
    return {
        "cycles": len(told),
        "report_ms": spread([report.report_cycles / CORE_PER_MS for report in told], 4),
        "load": spread([100 * report.awake_cycles / CORE_PER_MS / PERIOD_MS for report in told], 3),
        "start_us": spread([1000 * cycles / CORE_PER_MS for cycles in starts], 2),
        "jitter_us": round(1000 * (max(starts) - min(starts)) / CORE_PER_MS, 2),
        "times_us": [round(1000 * report.report_cycles / CORE_PER_MS) for report in told],
    }
