"""Random drives of robots whose parts vary. The tests play some of these drives. If the robot has
no fault, the firmware does not stop the robot. If the robot has a fault, the firmware stops the
robot within 0.3 m.

``python tests/python/programs/test_random_drives.py [SERIES ...]`` plays whole series. It prints
the number of drives that did not end with a stop, the number of drives that stopped after more than
0.3 m, the longest distance until a stop, and the greatest velocity. A series is a set of drives
with the same fault. The name of a series is the text with which a scenario orders this fault, such
as "leads 0". The series "none" has drives without a fault. The exceptions in
design/safety_case.toml are the results of these series.
"""

import csv
import itertools
import math
import random
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PROGRAM = ROOT / "build/host/sim/weeding_robot_host"
WHEELBASE, TRACK = 1.582, 1.054  # m
PROTECTIVE_STOP = "4"
SPEEDS = (0, 200, 500, 1000, 2000, 3000, -300, -1000)  # 0.1 rpm
ANGLES = (0, 0, 5, -5, 12, -12, 20, -20)  # degrees
FAULT_AT, DRIVE_END = 6040, 16040  # in ms; the fault occurs between two cycles
LIMIT = 3300  # greatest permitted velocity, in 0.1 rpm
WITHOUT_FAULT = (*range(1, 81), *range(1000, 1120))  # seeds
SERIES = tuple(itertools.product((100, 200, 500, 1000, 2000, 3000), (0, 20), (-10, 0, 10)))


@dataclass(frozen=True)
class Outcome:
    """The result of a drive: the distance until the stop [mm] and the greatest velocity [0.1
    rpm]."""

    way: float | None
    fastest: float


def wheels(velocity: int, degrees: int) -> str:
    """Returns the set-points of the four wheels. In a curve, each wheel rolls on its own circle."""
    if degrees == 0:
        return str(velocity)
    middle = WHEELBASE / math.tan(math.radians(abs(degrees)))
    inner, outer = middle - TRACK / 2, middle + TRACK / 2
    radii = [math.hypot(inner, WHEELBASE), math.hypot(outer, WHEELBASE), inner, outer]
    if degrees < 0:
        radii = [radii[1], radii[0], radii[3], radii[2]]
    return " ".join(str(round(velocity * radius / max(radii))) for radius in radii)


def play(lines: list[str]) -> list[dict[str, str]]:
    with tempfile.TemporaryDirectory() as folder:
        scenario, table = Path(folder) / "drive.scenario", Path(folder) / "reports.csv"
        scenario.write_text("\n".join(lines) + "\n")
        words = [PROGRAM, "--scenario", scenario, "--reports", table]
        subprocess.run(words, check=True, timeout=60, stdout=subprocess.DEVNULL)
        with table.open() as rows:
            return list(csv.DictReader(rows))


def outcome(rows: list[dict[str, str]]) -> Outcome:
    stops = (abs(float(row["way"])) for row in rows if row["inhibit"] == PROTECTIVE_STOP)
    return Outcome(next(stops, None), max(float(row["max_velocity"]) for row in rows))


def without_fault(seed: int) -> Outcome:
    """Drives for a minute with changing orders on changing slopes."""
    chance = random.Random(seed)
    lines = [f"seed {seed}", "plant varied", "at 50 arm"]
    changes: Iterator[int] = iter(())
    slope_at, velocity, degrees = 5000, 0, 0
    for now in range(1550, 60_000, 100):
        if next(changes, None) is None:
            velocity, degrees = chance.choice(SPEEDS), chance.choice(ANGLES)
            changes = iter(range(chance.choice((20, 30, 60))))
        if now > slope_at:
            lines.append(f"at {now} slope {chance.choice((-10, -5, 0, 5, 10))}")
            slope_at = now + chance.choice((4000, 6000, 9000))
        lines.append(f"at {now} order velocity {wheels(velocity, degrees)} steering {degrees}00")
    return outcome(play([*lines, "at 60000 end"]))


def with_fault(fault: str, seed: int, velocity: int, degrees: int, slope: int) -> Outcome:
    """Drives a varied robot with a constant order. A part fails during the drive."""
    order = f"order velocity {wheels(velocity, degrees)} steering {degrees}00"
    lines = [f"seed {seed}", "plant varied", f"at 20 slope {slope}", "at 50 arm"]
    lines += [f"from 1550 to {DRIVE_END} every 100 {order}", f"at {FAULT_AT} mark"]
    lines += [f"at {FAULT_AT} fault {fault}", f"at {DRIVE_END} end"]
    return outcome(play(lines))


@pytest.fixture(scope="module", autouse=True)
def built(build: Callable[..., None]) -> None:
    build("host", "weeding_robot_host")


def test_a_robot_without_fault_is_not_stopped() -> None:
    with ThreadPoolExecutor() as pool:
        for seed, drive in enumerate(pool.map(without_fault, range(1, 13)), 1):
            assert drive.way is None, f"seed {seed}"
            assert drive.fastest <= LIMIT, f"seed {seed}"


@pytest.mark.parametrize("velocity", [200, 500, 1000, 2000, 3000])
def test_swapped_leads_stop_the_robot_within_0_3_m(velocity: int) -> None:
    for degrees, slope in itertools.product((0, 20), (-10, 0, 10)):
        drive = with_fault("leads 0", 1, velocity, degrees, slope)
        assert drive.way is not None, (degrees, slope)
        assert drive.way <= 300, (degrees, slope)


@pytest.mark.parametrize("fault", ["hall 2", "hall-a 1", "hall-swapped 0", "current 3", "block 1"])
def test_a_broken_part_stops_the_robot_within_0_3_m(fault: str) -> None:
    for velocity, degrees, slope in SERIES[::5]:
        drive = with_fault(fault, 1, velocity, degrees, slope)
        assert drive.way is not None, (velocity, degrees, slope)
        assert drive.way <= 300, (velocity, degrees, slope)
        assert drive.fastest <= LIMIT, (velocity, degrees, slope)


def print_series(name: str, drives: list[Outcome]) -> None:
    ways = [end.way for end in drives if end.way is not None]
    late = sum(way > 300 for way in ways)
    fastest = max(end.fastest for end in drives) / 10
    print(
        f"{name}: {len(drives)} drives, {len(drives) - len(ways)} not stopped,"
        f" {late} after more than 0.3 m, at most {max(ways, default=0):.0f} mm, {fastest:.0f} rpm"
    )


def play_faults(fault: str) -> None:
    jobs = [(fault, seed, *case) for seed in range(1, 13) for case in SERIES]
    with ThreadPoolExecutor() as pool:
        drives = list(pool.map(lambda job: with_fault(*job), jobs))
    for velocity in dict.fromkeys(case[0] for case in SERIES):
        of_it = [end for job, end in zip(jobs, drives, strict=True) if job[2] == velocity]
        print_series(f"{fault} at {velocity / 10:.0f} rpm", of_it)


def main(series: list[str]) -> None:
    for name in series or ["leads 0"]:
        if name == "none":
            with ThreadPoolExecutor() as pool:
                print_series("without a fault", list(pool.map(without_fault, WITHOUT_FAULT)))
        else:
            play_faults(name)


if __name__ == "__main__":
    main(sys.argv[1:])
