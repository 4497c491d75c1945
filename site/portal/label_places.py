"""Moves the labels of a state diagram away from the lines of other edges."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

ASCENT, DESCENT = 11, 3  # distances from the baseline of a text to its top and to its bottom
# Vertical moves of a label, the smallest first. A positive number moves the label down.
MOVES = (0, 8, -8, 14, -14, 20, -20, 28, -28)
STEPS = 24  # number of steps in which a curve is sampled
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")

Point = tuple[float, float]


@dataclass(frozen=True)
class Box:
    left: float
    top: float
    right: float
    bottom: float

    def moved(self, down: float) -> Box:
        return Box(self.left, self.top + down, self.right, self.bottom + down)

    def holds(self, point: Point) -> bool:
        return self.left < point[0] < self.right and self.top < point[1] < self.bottom

    def meets(self, other: Box) -> bool:
        across = self.left < other.right and other.left < self.right
        return across and self.top < other.bottom and other.top < self.bottom


def box_of(text: ET.Element) -> Box:
    """Returns the box around a text line. PlantUML computed the width of this box."""
    x, y = float(text.get("x", "0")), float(text.get("y", "0"))
    return Box(x, y - ASCENT, x + float(text.get("textLength", "0")), y + DESCENT)


def points(path: str) -> Iterator[Point]:
    """Yields points on an SVG path of cubic curves. In such a path, ``M`` has one point, and each
    curve ``C`` has three points."""
    numbers = [float(match) for match in NUMBER.findall(path)]
    corners = list(zip(numbers[::2], numbers[1::2], strict=True))
    for first in range(0, len(corners) - 3, 3):
        a, b, c, d = corners[first : first + 4]
        for step in range(STEPS + 1):
            t = step / STEPS
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
            near = list(zip(weights, (a, b, c, d), strict=True))
            yield sum(w * p[0] for w, p in near), sum(w * p[1] for w, p in near)


def best_move(lines: list[Box], paths: Iterable[str], taken: list[Box]) -> float:
    """Returns the best vertical move of a label. After the best move, the label covers the fewest
    other texts. If several moves cover equally few texts, the best of these moves covers the fewest
    points of the edges. If several moves also cover equally few points, the smallest of these moves
    is the best.
    """
    dots = [point for path in paths for point in points(path)]

    def price(down: float) -> tuple[int, int, float]:
        moved = [line.moved(down) for line in lines]
        texts = sum(line.meets(other) for line in moved for other in taken)
        hits = sum(line.holds(dot) for line in moved for dot in dots)
        return texts, hits, abs(down)

    return min(MOVES, key=price)


def move(text: ET.Element, down: float) -> None:
    text.set("y", f"{float(text.get('y', '0')) + down:g}")
