"""The drawing of the board's pin headers shows each pin of the firmware at its position."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from portal.board_figure import MARGIN, PITCH, SIZE, SUPPLY, board_figure, headers, used_pins
from portal.pin_map import HEADER

pytestmark = pytest.mark.reads("src/k64/pins.hpp", "site/templates/board.html")

ROOT = Path(__file__).parents[3]
PIN = re.compile(r'<g class="pin[^"]*" data-pin="(\w+)" data-part="(\w*)"><title>([^<]*)</title>')
RECT = re.compile(r'<rect x="([\d.]+)" y="([\d.]+)"')
LABEL = re.compile(r'translate\((\d+) (\d+)\) rotate\(-90\)" text-anchor="(\w+)">([^<]+)<')
LETTER = 6.2  # average width of a letter, rounded up


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


def test_each_label_has_its_place() -> None:
    """A label is inside the drawing, and covers no pin and no other label of its column."""
    figure = board_figure(ROOT)
    height = float(re.findall(r'<svg [^>]*height="(\d+)"', figure)[0])
    columns: dict[float, list[tuple[float, float]]] = {}
    for x, y in RECT.findall(figure):
        columns.setdefault((float(x) - MARGIN) // PITCH, []).append((float(y), float(y) + SIZE))
    for x, y, anchor, text in LABEL.findall(figure):
        end = float(y) + len(text) * LETTER * (-1 if anchor == "start" else 1)
        columns[(float(x) - MARGIN) // PITCH].append((min(float(y), end), max(float(y), end)))
    for spans in columns.values():
        ends = [0.0, *(end for _, end in sorted(spans))]
        starts = [*(start for start, _ in sorted(spans)), height]
        assert all(end <= start for end, start in zip(ends, starts, strict=True)), spans


def test_the_labels_of_two_pins_differ() -> None:
    labels = [text for *_, text in LABEL.findall(board_figure(ROOT)) if text not in SUPPLY.values()]
    assert len(set(labels)) == len(labels)


def test_a_pin_on_an_unknown_header_is_an_error(tmp_path: Path) -> None:
    text = (ROOT / HEADER).read_text(encoding="utf-8").replace('"J1-5"', '"J1-99"')
    (tmp_path / HEADER).parent.mkdir(parents=True)
    (tmp_path / HEADER).write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match="J1-99"):
        board_figure(tmp_path)
