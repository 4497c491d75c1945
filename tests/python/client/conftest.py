"""Fixtures for the tests of the client: a robot in Python, and its control socket."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.python.client.fake_robot import FakeControl, FakeRobot


@pytest.fixture
def mcu() -> Iterator[FakeRobot]:
    robot = FakeRobot()
    yield robot
    robot.end()


@pytest.fixture
def control(mcu: FakeRobot, tmp_path: Path) -> Iterator[Path]:
    """Returns the path of a control socket of the robot."""
    path = tmp_path / "control"
    server = FakeControl(path, mcu)
    yield path
    server.end()
