"""The page "Use the data in other tools" contains a program that publishes reports in ROS 2. In
these tests, the program runs without ROS: simple classes replace the modules of ROS, and one report
replaces the robot."""

from __future__ import annotations

import math
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
from mcap_ros2._vendor.rosidl_adapter.parser import parse_message_string

from weeding_robot_client import link
from weeding_robot_client.messages import Report
from weeding_robot_client.ros_messages import messages

PAGE = Path(__file__).parents[3] / "docs" / "other_tools.rst"
NONE = 255


def program() -> str:
    _, _, rest = PAGE.read_text(encoding="utf-8").partition("   import math\n")
    lines = rest.splitlines()
    end = next(n for n, line in enumerate(lines) if line and not line.startswith("   "))
    return textwrap.dedent("   import math\n" + "\n".join(lines[:end]))


def empty_message() -> Any:
    """Returns a message of Report.msg. As in ROS, each field has a value of its type."""
    fields = parse_message_string("p", "Report", messages()["Report.msg"]).fields
    kinds = {"bool": False, "float64": 0.0, "string": ""}
    return SimpleNamespace(**{one.name: kinds.get(one.type.type, 0) for one in fields})


@pytest.fixture
def published(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[Any]]:
    found: list[Any] = []
    node = SimpleNamespace(create_publisher=lambda *_: SimpleNamespace(publish=found.append))
    ros, types = ModuleType("rclpy"), ModuleType("weeding_robot_msgs.msg")
    vars(ros).update(init=lambda: None, create_node=lambda _: node, ok=lambda: not found)
    vars(types).update(Report=empty_message)
    monkeypatch.setitem(sys.modules, "rclpy", ros)
    monkeypatch.setitem(sys.modules, "weeding_robot_msgs", ModuleType("weeding_robot_msgs"))
    monkeypatch.setitem(sys.modules, "weeding_robot_msgs.msg", types)
    yield found


class OneReport:
    """A link that receives one report."""

    def __init__(self, _path: Path) -> None:
        layout = Report.layout
        numbers = dict.fromkeys(layout.names, 0) | {"source": NONE, "stop_wheel": NONE}
        self.report = Report.from_payload(layout.pack(**numbers))

    def __enter__(self) -> OneReport:
        return self

    def __exit__(self, *_: object) -> None: ...

    def service(self, _timeout_s: float) -> list[Report]:
        return [self.report]


def test_a_report_without_source_and_without_stopped_wheel_is_published(
    published: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(link, "Link", OneReport)
    exec(program(), {})
    (message,) = published
    assert (message.source, message.stop_wheel) == (NONE, NONE)
    assert math.isnan(message.velocity0_rpm)
