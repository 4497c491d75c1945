"""The steps of the page "Values to tune" find the parameters of the simulated robot.

The expected values are the values of the simulated robot in docs/plant.rst. The assumptions of the
firmware about the robot are not used.
"""

import csv
import itertools
import statistics
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
BOARD = ROOT / "build/host/sim/weeding_robot_board"
IMAGE = ROOT / "build/k64/weeding_robot.bin"
ORDERS = """\
seed 1
at 50 arm
from 1650 to 6050 every 100 order tension 3000
from 6150 to 10050 every 100 order tension 4000
from 10150 to 13050 every 100 order velocity 0 steering 0
from 13150 to 17050 every 100 order velocity 0 steering -2500
from 17150 to 22050 every 100 order velocity 0 steering 2500
at 22100 end
"""
WINDING = 1.42  # [ohm]
MOTOR_CONSTANT = 0.52 * 10.472  # induced voltage at 100 rpm [V]
STEP_RATE = 500  # greatest number of steps of the steering motor in a second

Rows = list[dict[str, str]]


@pytest.fixture(scope="module")
def reports(build: Callable[..., None], tmp_path_factory: pytest.TempPathFactory) -> Rows:
    build("host", "weeding_robot_board")
    build("k64", "weeding_robot")
    folder = tmp_path_factory.mktemp("drive")
    (folder / "drive.scenario").write_text(ORDERS)
    words = [BOARD, "--image", IMAGE, "--scenario", folder / "drive.scenario"]
    subprocess.run([*words, "--reports", folder / "drive.csv"], check=True, timeout=120)
    with (folder / "drive.csv").open(newline="") as table:
        return list(csv.DictReader(table))


def with_tension(reports: Rows, millivolts: int) -> Rows:
    return [row for row in reports if int(row["tension0"]) == millivolts]


def test_the_motor_constant_is_the_induced_voltage_at_100_rpm(reports: Rows) -> None:
    steady = with_tension(reports, 4000)[-5:]
    volts = 4 - WINDING * statistics.mean(int(row["current0"]) for row in steady) / 1000
    velocity = statistics.mean(int(row["velocity0"]) for row in steady) / 10  # [rpm]
    assert volts / velocity * 100 == pytest.approx(MOTOR_CONSTANT, rel=0.02)


def test_a_step_of_1_volt_shows_the_time_constant(reports: Rows) -> None:
    velocities = [int(row["velocity0"]) for row in with_tension(reports, 4000)]
    left = [velocities[-1] - one for one in velocities[2:7]]
    ratios = [after / before for before, after in itertools.pairwise(left)]
    # The difference from the final velocity is 0.637 times the difference in the previous cycle.
    # docs/wheel_control.rst derives this number.
    assert statistics.mean(ratios) == pytest.approx(0.637, abs=0.03)


def test_the_greatest_change_of_the_angle_shows_the_step_of_the_steering(reports: Rows) -> None:
    angles = [int(row["steering"]) for row in reports]
    in_a_second = max(later - angle for angle, later in zip(angles, angles[10:], strict=False))
    assert in_a_second / STEP_RATE == pytest.approx(5, rel=0.03)
