"""The drawing of the board's pin headers shows each pin of the firmware at its position."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from portal.board_figure import SUPPLY, board_figure, headers, used_pins
from portal.pin_map import HEADER

pytestmark = pytest.mark.reads("src/k64/pins.hpp", "site/templates/board.html")

ROOT = Path(__file__).parents[3]
PIN = re.compile(r'<g class="pin[^"]*" data-pin="(\w+)" data-part="(\w*)"><title>([^<]*)</title>')


def test_each_pin_of_the_firmware_on_a_header_is_drawn_once_with_its_task() -> None:
    used = used_pins(ROOT)
    drawn = PIN.findall(board_figure(ROOT))
    assert sorted(pin for pin, _, _ in drawn) == sorted(one.pin for one in used.values())
    assert all(used[title.partition(",")[0]].pin == pin for pin, _, title in drawn)


def test_a_wheel_has_its_pins() -> None:
    """The pins of a wheel are: voltage, orientation, enable, two Hall sensors and the current."""
    parts = [part for _, part, _ in PIN.findall(board_figure(ROOT))]
    assert {part: parts.count(part) for part in ("fl", "fr", "rl", "rr")} == dict.fromkeys(
        ("fl", "fr", "rl", "rr"), 6
    )
    assert parts.count("") == 0


def test_no_two_pins_have_the_same_place() -> None:
    places = [f"{row.header}-{pin}" for row in headers() for pin in row.pins]
    assert len(set(places)) == len(places)
    assert set(SUPPLY) <= set(places)
    points = [(row.left + column, row.top) for row in headers() for column in range(len(row.pins))]
    assert len(set(points)) == len(points)


def test_a_pin_on_an_unknown_header_is_an_error(tmp_path: Path) -> None:
    text = (ROOT / HEADER).read_text(encoding="utf-8").replace('"J1-5"', '"J1-99"')
    (tmp_path / HEADER).parent.mkdir(parents=True)
    (tmp_path / HEADER).write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match="J1-99"):
        board_figure(tmp_path)
