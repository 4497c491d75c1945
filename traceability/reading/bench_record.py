"""The bench: four scenarios from the paper, with the times that the paper states and the times that
this project measures."""

from __future__ import annotations

import re
import statistics
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

from traceability.reading import task_record
from traceability.reading.products import DEFAULT, image_of
from traceability.reading.programs import source_lines
from traceability.reading.results import RESULTS, read_record
from traceability.reading.task_record import is_fresh
from traceability.schema import BenchRun, BenchScenario, ExceptionCost, Latency, Profile, Spread

BENCH = RESULTS / "bench.json"
# file with the measurements of the product without safety functions
PAPER_BENCH = RESULTS / "bench_paper.json"
FOLDER = Path("sim/scenario/bench")
IMAGE = image_of(DEFAULT, ".bin")
ELF = image_of(DEFAULT, ".elf")
MANUAL, SLOW = "no-wait-states", "slow-flash"
TIMINGS = {MANUAL: "no wait states", SLOW: "slow flash"}
CYCLES = 1000  # number of measured control cycles in a scenario
PERIOD_MS = 100
SPEED_GOAL = 100  # required speed of the simulation: simulated time divided by real time
SHARE = 10  # target: the measured time is at most the time in the paper divided by this number
LIBRARY = "C and C++ library"
ORDER = re.compile(r"from (\d+) to (\d+) every (\d+) order velocity (-?\d+)(?: steering (-?\d+))?$")
LINES = {
    31: "serial port to the PC",
    39: "first converter",
    48: "clock pulse",
    49: "tick of 1 ms",
    60: "remote control",
    62: "Hall sensors",
    64: "main thread",
    73: "second converter",
    75: "thread of wheel 0",
    76: "thread of wheel 1",
    77: "thread of wheel 2",
    78: "thread of wheel 3",
}
FIRST_LINE = 16  # number of the exception that belongs to interrupt line 0


@dataclass(frozen=True)
class Paper:
    """A scenario of the paper, with the text of the paper and the times [ms] that the paper
    states."""

    name: str
    title: str
    words: str
    average: float
    maximum: float


SCENARIOS = (
    Paper(
        "velocity",
        "0 rpm for 500 cycles, then 50 rpm",
        "During the first 500 cycles, the wheel velocity setpoints are equal to 0 rpm; after that, "
        "they are increased to 50 rpm.",
        2.12,
        3.28,
    ),
    Paper(
        "velocity_and_steering",
        "50 rpm, with the steering between the extremes",
        "During all cycles, the wheel velocity setpoints are equal to 50 rpm while the steering "
        "setpoints constantly go back and forth between the extreme left and right positions.",
        2.39,
        3.43,
    ),
    Paper(
        "steps",
        "0 to 300 rpm and back, in steps of 50",
        "The wheel velocity setpoints are increased by 50 rpm from 0 rpm to 300 rpm; after that, "
        "they are decreased by the same value until 0.",
        2.65,
        3.59,
    ),
    Paper(
        "steps_and_steering",
        "0 to 300 rpm and back, with the steering between the extremes",
        "The wheel velocity setpoints are as in the previous test while the steering setpoints "
        "constantly go back and forth between the extreme left and right positions.",
        2.67,
        3.72,
    ),
)


Record = dict[str, BenchScenario]


@dataclass(frozen=True)
class Order:
    """An order that a scenario sends in each cycle from the time ``first`` to the time ``last``
    [ms]. It sets the velocity of the wheels [rpm] and the steering angle [degree]."""

    first: int
    last: int
    velocity: float
    steering: float


def orders_in(text: str) -> list[Order]:
    matches = (ORDER.match(line.strip()) for line in text.splitlines())
    periods = [map(int, match.groups(default="0")) for match in matches if match]
    return [
        Order(first, last, velocity / 10, steering / 100)
        for first, last, _, velocity, steering in periods
    ]


def measured_orders(text: str) -> list[Order]:
    """Returns the order that the scenario sends in each measured cycle. Only the last ``CYCLES``
    cycles of a scenario are measured."""
    each = [
        order for order in orders_in(text) for _ in range(order.first, order.last + 1, PERIOD_MS)
    ]
    return each[-CYCLES:]


def read_bench(root: Path, path: Path = BENCH) -> Record | None:
    """Returns the measurements of the last run. Returns None if they do not belong to the present
    sources."""
    return read_record(root / path, Record) if is_fresh(root, task_record.BENCH) else None


def bench_metrics(record: Mapping[str, BenchScenario] | None) -> list[dict[str, Any]] | None:
    """Returns the times of each scenario in the form of build/metrics.json."""
    if record is None:
        return None
    return [
        {
            "name": name,
            "avg_ms": scenario.runs[MANUAL].report_ms.average,
            "max_ms": scenario.runs[MANUAL].report_ms.maximum,
            "bound_avg_ms": scenario.runs[SLOW].report_ms.average,
            "bound_max_ms": scenario.runs[SLOW].report_ms.maximum,
        }
        for name, scenario in record.items()
    ]


# ---- from the measurements of the board program --------------------------------


def bench_run(raw: dict[str, Any], speed: float | None = None) -> BenchRun:
    """Computes the numbers of a run from the measurements of the board program."""
    if len(raw["reported"]) != CYCLES or not all(raw["reported"]):
        raise ValueError(
            f"{sum(raw['reported'])} cycles have a report, but {CYCLES} cycles must have a report"
        )
    per_ms = raw["clock_hz"] / 1000
    times = [cycles / per_ms for cycles in raw["report_cycles"]]
    starts = raw["start_cycles"]
    return BenchRun(
        report_ms=spread(times, 4),
        load=spread([100 * cycles / per_ms / PERIOD_MS for cycles in raw["awake_cycles"]], 3),
        start_us=spread([1000 * cycles / per_ms for cycles in starts], 2),
        jitter_us=round(1000 * (max(starts) - min(starts)) / per_ms, 2),
        times_us=[round(1000 * time) for time in times],
        cycles=CYCLES,
        instructions=spread(raw["instructions"], 0),
        report_instructions=spread(raw["report_instructions"], 0),
        latency=latencies(raw["exceptions"], per_ms),
        exceptions=exceptions(raw["exceptions"], per_ms),
        speed=speed,
    )


def spread(values: Sequence[float], digits: int) -> Spread:
    average_least_most = (statistics.fmean(values), min(values), max(values))
    return Spread(*(round(value, digits) for value in average_least_most))


def latencies(raw: dict[str, dict[str, int]], per_ms: float) -> dict[str, Latency]:
    """Returns two results for each priority: the longest time from an interrupt request to the
    start of the handler, and the name of this interrupt."""
    requested = [(int(number), latency) for number, latency in raw.items() if latency["requests"]]
    requested.sort(key=lambda item: item[1]["priority"])
    longest = {}
    for priority, group in groupby(requested, key=lambda item: item[1]["priority"]):
        number, worst = max(group, key=lambda item: item[1]["worst_latency"])
        us = round(1000 * worst["worst_latency"] / per_ms, 2)
        longest[str(priority)] = Latency(us, who(number))
    return longest


def exceptions(raw: dict[str, dict[str, int]], per_ms: float) -> list[ExceptionCost]:
    """Returns the average cost of each interrupt and thread in a control cycle. The highest cost is
    the first."""
    rows = [
        ExceptionCost(
            who(int(number)),
            entries=round(cost["entries"] / CYCLES, 2),
            instructions=round(cost["instructions"] / CYCLES),
            us=round(1000 * cost["cycles"] / per_ms / CYCLES, 2),
            report_us=round(1000 * cost["report_cycles"] / per_ms / CYCLES, 2),
        )
        for number, cost in raw.items()
    ]
    return sorted(rows, key=lambda row: -row.us)


def who(exception: int) -> str:
    if exception == 0:
        return "idle, and entry and exit of interrupts"
    return LINES.get(exception - FIRST_LINE, f"exception {exception}")


# ---- which module executed the instructions ----------------------------------


# the functions at an instruction, as pairs of function and file; the innermost inlined function is
# the first
Frames = list[tuple[str, str]]


def profile(raw: dict[str, Any], root: Path) -> Profile:
    """Returns two mean numbers of instructions for each module and each function: in the whole
    cycle, and from the clock pulse to the report."""
    counts = {int(address): tuple(pair) for address, pair in raw["profile"].items()}
    return profile_of(counts, frames_of(root / ELF, counts))


def profile_of(counts: dict[int, tuple[int, ...]], frames: dict[int, Frames]) -> Profile:
    def rows(place: int) -> list[tuple[str, float, float]]:
        whole: Counter[str] = Counter()
        report: Counter[str] = Counter()
        for address, (other, to_report) in counts.items():
            name = owner(frames[address])[place]
            whole[name] += other + to_report
            report[name] += to_report
        return [
            (name, round(count / CYCLES, 1), round(report[name] / CYCLES, 1))
            for name, count in sorted(whole.items(), key=lambda item: (-item[1], item[0]))
        ]

    return Profile(rows(0), rows(1))


def owner(frames: Frames) -> tuple[str, str]:
    """Returns the module and the function to which an instruction belongs. If the compiler has
    inlined functions into each other, the instruction belongs to the innermost function of the
    project."""
    for function, file in frames:
        if {"src", "extensions", "tests"}.intersection(Path(file).parts):
            return Path(file).name.split(".")[0], function
    return LIBRARY, frames[-1][0] if frames else "?"


def frames_of(elf: Path, addresses: Iterable[int]) -> dict[int, Frames]:
    """Returns a map from each instruction to the functions that contain it. The innermost inlined
    function is the first."""
    return {
        address: [
            (function, place.rsplit(":", 1)[0])
            for function, place in zip(lines[::2], lines[1::2], strict=True)
        ]
        for address, lines in source_lines(elf, addresses, "-f", "-C").items()
    }
