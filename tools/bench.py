"""./wr bench: measures the four scenarios of the paper with the firmware image of the robot."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from tools.bench_runs import keep
from tools.lock import only_one
from tools.steps import FailureError, MissingError, UsageError
from tools.tasks import graph
from traceability.reading import task_record
from traceability.reading.bench_record import (
    BENCH,
    FOLDER,
    MANUAL,
    PERIOD_MS,
    SCENARIOS,
    SLOW,
    Record,
    orders_in,
    spread,
)
from traceability.reading.results import read_record
from traceability.schema import BenchRun, BenchScenario
from weeding_robot_client.link import Link
from weeding_robot_client.messages import Quantity, Report
from weeding_robot_client.options import positive
from weeding_robot_client.orders import Orders as Sender
from weeding_robot_client.orders import arm, connect, not_connected
from weeding_robot_client.script import Wish

# ./wr bench also runs these tasks. They measure the baseline design. They also measure the time of
# the tests twice: with and without the recording of calls.
BESIDES = (task_record.BASELINE, task_record.TESTS_TRACE, task_record.TESTS_PLAIN)
CORE_PER_MS = 120_000
BOARD = "board"  # record of the run on a connected board


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "bench",
        description="Builds the firmware image for the K64, and runs this image on the virtual K64 "
        "in the simulated robot. Plays the four scenarios of the paper. Measures 1000 control "
        "cycles of each scenario: the number of instructions, the time from the clock pulse to the "
        "report, the processor load, the latencies, and the speed of the simulator. Compares the "
        "patterns with the baseline design, and measures the cost of recording the calls. With "
        "--port, sends the same orders to a connected board, and reads the counts of processor "
        "cycles in its reports. "
        "Lift the robot first, because its motors will turn at up to 300 rpm. The remote control "
        "may be off, because the PC sends all orders.",
    )
    parser.add_argument("--port", type=Path, help="serial port of a board with this firmware")
    parser.add_argument(
        "--seconds", type=positive, help="with --port: end each scenario after this time [s]"
    )
    parser.set_defaults(run=bench)


def bench(root: Path, options: argparse.Namespace) -> int:
    if options.seconds and not options.port:
        raise UsageError(f"--seconds {options.seconds} needs --port")
    if options.port:
        if not options.port.exists():
            raise MissingError(f"there is no port {options.port}: connect the board first")
        return on_board(root, options.port, options.seconds)
    with only_one(root, "bench"):
        ended = graph(root).run([task_record.BENCH, *BESIDES])
    if not ended.failed:
        print_bench(root)
    return 1 if ended.failed else 0


def print_bench(root: Path) -> None:
    """Prints a table with the times of each scenario."""
    record = read_record(root / BENCH, Record) or {}
    print(f"\n{'from clock pulse to report [ms]':44} {'mean':>8} {'max':>8}  slow flash")
    for paper in SCENARIOS:
        runs = record[paper.name].runs
        normal, slow = runs[MANUAL].report_ms, runs[SLOW].report_ms
        print(
            f"{paper.title:44} {normal.average:8.3f} {normal.maximum:8.3f}  "
            f"{slow.average:.3f} {slow.maximum:.3f}"
        )


# ---- on a board --------------------------------------------------------------


def wishes(scenario: str, seconds: float | None) -> Iterator[Wish]:
    """Yields an order for each cycle of 100 ms, until the scenario ends or ``seconds`` have
    passed."""
    orders = orders_in(scenario)
    end = orders[-1].last if seconds is None else orders[0].first + 1000 * seconds
    for order in orders:
        cycles = round((min(order.last, end) - order.first) / PERIOD_MS) + 1
        wish = Wish.of(Quantity.VELOCITY, order.velocity, order.steering)
        yield from [wish] * max(cycles, 0)


def on_board(root: Path, port: Path, seconds: float | None) -> int:
    """Sends the orders of the scenarios to a board, and adds its measurements to the record."""
    record = read_record(root / BENCH, Record) or {}
    for paper in SCENARIOS:
        text = (root / FOLDER / f"{paper.name}.scenario").read_text(encoding="utf-8")
        print(f"{paper.title} ... ", end="", flush=True)
        try:
            run = costs(drive(port, wishes(text, seconds)))
        except FailureError as error:
            print(f"FAILED: {error}")
            return 1
        scenario = record.get(paper.name, BenchScenario())
        record[paper.name] = replace(scenario, runs={**scenario.runs, BOARD: run})
        times = run.report_ms
        print(f"{times.average:.3f} ms, at most {times.maximum:.3f}, load "
              f"{run.load.average:.2f} %, {run.cycles} cycles")  # fmt: skip
    keep(root, BENCH, record)
    return 0


def drive(port: Path, plan: Iterator[Wish]) -> list[Report]:
    """Arms the robot, and sends each order for one cycle. Returns the reports."""
    try:
        link = Link(port)
    except OSError as error:
        said = f"cannot open {port}: {error.strerror or error}; connect the board first"
        raise MissingError(said) from error
    with link:
        sender = Sender(link)
        if not connect(sender):
            raise FailureError(not_connected(link))
        if reason := arm(sender):
            raise FailureError(f"the robot is not armed. {reason}")
        reports = []
        due = time.monotonic()
        wish = Wish()
        for wish in plan:
            sender.send(wish)
            due += PERIOD_MS / 1000
            while (left := due - time.monotonic()) > 0:
                reports += link.service(left)
            if not link.connected:
                raise FailureError("the connection was lost: check cable and power")
        sender.end(wish)
    return reports


def costs(reports: list[Report]) -> BenchRun:
    """Returns the times and the load that a board reports. The first two cycles are skipped,
    because they execute earlier orders."""
    measured = [report for report in reports if report.order_read][2:]
    if not measured:
        raise FailureError("the board read at most two orders, but a measurement needs three")
    if not any(report.awake_cycles for report in measured):
        raise FailureError(
            "the firmware at this port does not count processor cycles; choose the port of the "
            "board"
        )
    starts = [report.start_cycles for report in measured]
    return BenchRun(
        report_ms=spread([report.report_cycles / CORE_PER_MS for report in measured], 4),
        load=spread(
            [100 * report.awake_cycles / CORE_PER_MS / PERIOD_MS for report in measured], 3
        ),
        start_us=spread([1000 * cycles / CORE_PER_MS for cycles in starts], 2),
        jitter_us=round(1000 * (max(starts) - min(starts)) / CORE_PER_MS, 2),
        times_us=[round(1000 * report.report_cycles / CORE_PER_MS) for report in measured],
        cycles=len(measured),
    )
