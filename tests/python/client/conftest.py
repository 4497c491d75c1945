"""Fixtures for the tests of the client: a robot in Python, and its control socket."""

import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

HERE = Path(__file__).parent


def load_fake() -> Any:
    """Imports fake_robot.py, which is not part of a package."""
    name = "weeding_robot_fake"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, HERE / "fake_robot.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    return sys.modules[name]


@pytest.fixture
def mcu() -> Iterator[Any]:
    robot = load_fake().FakeRobot()
    yield robot
    robot.end()


@pytest.fixture
def control(mcu: Any, tmp_path: Path) -> Iterator[Path]:
    """Returns the path of a control socket of the robot."""
    path = tmp_path / "control"
    server = load_fake().FakeControl(path, mcu)
    yield path
    server.end()
