"""The times of the bench, computed from the measurements of the board program."""

from dataclasses import replace
from pathlib import Path

import pytest

from traceability.reading.bench_record import (
    CYCLES,
    LIBRARY,
    MANUAL,
    SLOW,
    bench_metrics,
    bench_run,
    owner,
    spread,
)
from traceability.schema import BenchScenario, Latency, Spread

ROOT = Path(__file__).parents[3]


def raw(**changes: object) -> dict[str, object]:
    """Returns a run of 1000 cycles at 120 MHz. The last cycle is twice as long as each of the
    previous cycles."""
    twice = [1] * (CYCLES - 1) + [2]
    one = {
        "clock_hz": 120_000_000,
        "reported": [1] * CYCLES,
        "report_cycles": [24_000 * times for times in twice],
        "report_instructions": [12_000 * times for times in twice],
        "awake_cycles": [120_000 * times for times in twice],
        "instructions": [60_000 * times for times in twice],
        "start_cycles": [600 * times for times in twice],
        "exceptions": {},
    }
    return one | changes


def exception(priority: int, requests: int, latency: int, cycles: int = 0) -> dict[str, int]:
    return {
        "priority": priority,
        "entries": requests,
        "requests": requests,
        "worst_latency": latency,
        "cycles": cycles,
        "instructions": cycles,
        "report_cycles": 0,
        "report_instructions": 0,
    }


def test_times_are_in_ms_and_the_load_in_per_cent_of_100_ms() -> None:
    found = bench_run(raw())
    assert found.report_ms == Spread(average=0.2002, minimum=0.2, maximum=0.4)
    assert found.load.maximum == 2.0
    assert found.instructions is not None
    assert found.instructions.maximum == 120_000
    assert found.start_us.minimum == 5.0
    assert found.jitter_us == 5.0
    assert found.times_us[-2:] == [200, 400]


@pytest.mark.parametrize("reported", [[1] * (CYCLES - 1), [1] * (CYCLES - 1) + [0]])
def test_each_of_the_cycles_must_have_reported(reported: list[int]) -> None:
    with pytest.raises(ValueError, match="999 cycles have a report"):
        bench_run(raw(reported=reported))


def test_the_worst_latency_of_each_priority_names_its_interrupt() -> None:
    found = bench_run(
        raw(
            exceptions={
                "64": exception(2, 1000, 240),
                "65": exception(2, 1000, 120),
                "78": exception(1, 10, 60),
                "80": exception(12, 0, 0, 5000),
            }
        )
    )
    assert found.latency == {"1": Latency(0.5, "Hall sensors"), "2": Latency(2.0, "clock pulse")}
    assert found.exceptions[0].who == "main thread"


def test_an_instruction_belongs_to_the_innermost_part_of_the_project() -> None:
    inlined = [
        ("std::copy", "/usr/include/c++/bits/stl_algo.h"),
        ("wr::Crc16::add", "/b/src/communication/Crc16.cpp"),
        ("wr::FrameEncoder::encode", "src/communication/FrameEncoder.cpp"),
    ]
    assert owner(inlined) == ("Crc16", "wr::Crc16::add")
    assert owner([("memcpy", "newlib/memcpy.c")]) == (LIBRARY, "memcpy")
    arming = ("wr::Arming::follow", "/b/extensions/safety/Arming.cpp")
    assert owner([arming]) == ("Arming", "wr::Arming::follow")


def test_the_metrics_have_the_times_of_both_models() -> None:
    run = bench_run(raw())
    times = {MANUAL: spread([1.0, 3.0], 1), SLOW: spread([2.0, 6.0], 1)}
    runs = {timing: replace(run, report_ms=found) for timing, found in times.items()}
    assert bench_metrics({"steps": BenchScenario(runs)}) == [
        {"name": "steps", "avg_ms": 2.0, "max_ms": 3.0, "bound_avg_ms": 4.0, "bound_max_ms": 6.0}
    ]
    assert bench_metrics(None) is None
