"""Computes drawings of curves over time. The curves are SVG paths. Their width depends on the width
of the page. The labels are HTML text, and their size is constant.

The theme sets the colour and the width of a curve by its CSS class."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import ClassVar

from traceability.schema import HOST, Curve, LoopPlot

WIDTH, HEIGHT = 1000, 300
TICKS = 5
# Source of a curve from a recording. A curve from a simulation has the name of a target instead.
ROBOT = "robot"
SOURCES = {HOST: "host", ROBOT: "robot"}  # CSS classes of the curves
WORDS = {"set_point": "set-point", "measured": "measured", "truth": "truth"}


@dataclass
class Tick:
    """A value on an axis, and its position on the axis [per cent of the length of the axis]."""

    text: str
    at: float


@dataclass
class Axis:
    """An axis: the values at its two ends, and round values between them."""

    first: float
    last: float
    ticks: list[Tick]

    def place(self, value: float) -> float:
        """Returns the position of a value on the axis [per cent of the length of the axis]."""
        return 100 * (value - self.first) / (self.last - self.first)

    def across(self, value: float) -> float:
        """Returns the distance of a value from the left edge of the drawing."""
        return self.place(value) * WIDTH / 100

    def down(self, value: float) -> float:
        """Returns the distance of a value from the top of the drawing."""
        return HEIGHT - self.place(value) * HEIGHT / 100


@dataclass
class Line:
    """A curve: its class, its name, and its path in the drawing."""

    kind: str
    words: str
    path: str


@dataclass
class Mark:
    """A labelled point of a drawing: its position on both axes [per cent]."""

    words: str
    across: float
    up: float


@dataclass
class Drawing:
    title: str
    unit: str
    x: list[Tick]
    y: list[Tick]
    lines: list[Line]
    words: str  # description for readers who cannot see the drawing
    marks: list[Mark] = field(default_factory=list)
    width: ClassVar[int] = WIDTH
    height: ClassVar[int] = HEIGHT


def draw(plot: LoopPlot) -> Drawing | None:
    """Returns the drawing of a plot, or None if no curve has points. The host and
    the virtual K64 have equal curves of the set-point, so only the first of these curves is drawn.
    """
    curves = [curve for curve in plot.curves if curve.points]
    if not curves:
        return None
    times = [at for curve in curves for at, _ in curve.points]
    values = [value for curve in curves for _, value in curve.points]
    x = axis(0.0 if min(times) < 0.2 * max(times) else min(times), max(times), rounded=False)
    y = axis(min(0.0, *values), max(0.0, *values), rounded=True)
    shown = [
        curve
        for number, curve in enumerate(curves)
        if curve.kind != "set_point" or curve.kind not in {curve.kind for curve in curves[:number]}
    ]
    lines = [Line(class_of(curve), words_of(curve), path(curve, x, y)) for curve in shown]
    ends = "; ".join(
        f"{line.words} ends at {curve.points[-1][1]:g}"
        for line, curve in zip(lines, shown, strict=True)
    )
    text = f"{plot.title} in {plot.unit}, {x.first:g} s to {x.last:g} s: {ends}"
    return Drawing(plot.title, plot.unit, x.ticks, y.ticks, lines, text)


def draw_all(plots: Iterable[LoopPlot]) -> list[Drawing]:
    """Returns the drawings of the plots that have points."""
    return [drawing for drawing in map(draw, plots) if drawing]


def class_of(curve: Curve) -> str:
    if curve.kind == "set_point":
        return "set-point"
    return f"{curve.kind} {SOURCES.get(curve.binding, 'board')}"


def words_of(curve: Curve) -> str:
    words = WORDS[curve.kind]
    return words if curve.kind == "set_point" else f"{words}, {curve.binding}"


def axis(low: float, high: float, *, rounded: bool) -> Axis:
    """Returns an axis from ``low`` to ``high``, with some round values on it. If ``rounded`` is
    true, each end of the axis moves outwards to the next round value."""
    span = high - low or 1.0
    high = low + span
    rough = span / TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(step for step in (power, 2 * power, 5 * power, 10 * power) if step >= rough)
    before, after = math.floor(low / step), math.ceil(high / step)
    if rounded:
        after = max(after, before + 1)
        scale = Axis(before * step, after * step, [])
    else:
        scale = Axis(low, high, [])
        before, after = math.ceil(low / step), math.floor(high / step)
    for number in range(before, after + 1):
        value = number * step
        scale.ticks.append(Tick(f"{round(value, 6):g}", scale.place(value)))
    return scale


def path(curve: Curve, x: Axis, y: Axis) -> str:
    """Returns the path of a curve. A set-point applies until the next set-point; other values are
    joined by straight lines."""
    steps = curve.kind == "set_point"
    parts: list[str] = []
    for at, value in curve.points:
        across, down = x.across(at), y.down(value)
        if not parts:
            parts.append(f"M{across:.1f} {down:.1f}")
        elif steps:
            parts.append(f"H{across:.1f}V{down:.1f}")
        else:
            parts.append(f"L{across:.1f} {down:.1f}")
    return "".join(parts)
