"""The drawing of the pin headers of the board FRDM-K64F, with the pins that the firmware uses. The
pin table of the firmware lists these pins."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from portal.pin_map import HEADER, entries, roles
from portal.templates import environment

PITCH = 35
SIZE = 26  # size of a pin
LABEL = 205  # space for a vertical label of a pin of the robot
SHORT = 112  # space for a short vertical label
MARGIN = 8
TIMER = "FTM"  # begin of the names of the PWM outputs
PLACE = re.compile(r"(J\d)-(\d+)")  # the header J199 of the Bluetooth module is not drawn
# Supply pins. The firmware does not use them, but the reader needs them for the measurements in
# step 7 of the page that contains this drawing.
SUPPLY = {"J3-8": "3.3 V", "J3-12": "ground", "J3-14": "ground"}
# For each part of the robot: a pattern that matches the text of its pins, the name of the part, and
# the CSS class of its colour.
PARTS = (
    (r"emergency", "emergency stop", "stop"),
    (r"front left", "front left wheel", "fl"),
    (r"front right", "front right wheel", "fr"),
    (r"rear left", "rear left wheel", "rl"),
    (r"rear right", "rear right wheel", "rr"),
    (r"steering|end stop", "steering", "steering"),
    (r"remote control", "remote control", "rc"),
)


@dataclass(frozen=True)
class Row:
    """A row of pins of a header, with the position of the row in the drawing."""

    header: str
    pins: tuple[int, ...]
    left: int  # number of columns to the left of the header
    top: int
    above: bool  # true: the labels are above the pins

    @property
    def is_named(self) -> bool:
        """Returns whether the name of the header is next to this row. A header has two rows, and
        its name is next to only one of them."""
        return self.pins[0] % 2 == (self.header not in ("J1", "J2"))


def headers() -> list[Row]:
    """Returns the rows of all headers in the Arduino R3 layout. The reader sees the board from
    above. The pins with even numbers are at the edges of the board."""
    outer, inner = LABEL, LABEL + SIZE + 4
    low_inner = inner + SIZE + LABEL + SHORT
    low_outer = low_inner + SIZE + 4
    middle = inner + SIZE + SHORT
    return [
        Row("J2", tuple(range(20, 0, -2)), 0, outer, above=True),
        Row("J2", tuple(range(19, 0, -2)), 0, inner, above=False),
        Row("J1", tuple(range(16, 0, -2)), 11, outer, above=True),
        Row("J1", tuple(range(15, 0, -2)), 11, inner, above=False),
        Row("J3", tuple(range(1, 17, 2)), 4, low_inner, above=True),
        Row("J3", tuple(range(2, 17, 2)), 4, low_outer, above=False),
        Row("J4", tuple(range(1, 13, 2)), 13, low_inner, above=True),
        Row("J4", tuple(range(2, 13, 2)), 13, low_outer, above=False),
        Row("J6", (1, 3, 5, 7), 0, middle, above=True),
        Row("J6", (2, 4, 6, 8), 0, middle + SIZE + 4, above=False),
    ]


@dataclass(frozen=True)
class Used:
    """A pin that the firmware uses."""

    pin: str
    signal: str
    effect: str

    @property
    def part(self) -> tuple[str, str]:
        """Returns the name and the CSS class of the part of the robot that is connected to this
        pin."""
        matches = (
            (name, kind)
            for words, name, kind in PARTS
            if re.search(words, f"{self.signal.replace('_', ' ')} {self.effect}".lower())
        )
        return next(matches, ("", ""))

    @property
    def label(self) -> str:
        # A signal in capital letters is the name of a peripheral. Because this name does not help a
        # reader, the label shows the part or the effect of the pin instead.
        if self.signal.startswith(TIMER):
            return f"PWM of the {self.part[0]}"
        named = self.signal.islower()
        return self.signal.replace("_", " ") if named else self.effect.rstrip(".")


def used_pins(root: Path) -> dict[str, Used]:
    """Returns each pin that is on a header and is used by the firmware. The key is the header and
    the number of the pin, as in "J1-4"."""
    text = (root / HEADER).read_text(encoding="utf-8")
    return {
        place: Used(pin, signal, effect)
        for pin, _, _, signal, place, effect in entries(text, roles(text))
        if PLACE.fullmatch(place)
    }


def board_figure(root: Path) -> str:
    """Returns the drawing with its legend, as HTML for the page."""
    used, rows = used_pins(root), headers()
    drawn = {f"{row.header}-{pin}" for row in rows for pin in row.pins}
    if lost := sorted(used.keys() - drawn):
        raise ValueError(f"{HEADER}: these pins are on no header of the drawing: {lost}")
    parts = [part for part in dict.fromkeys(pin.part for pin in used.values()) if part[0]]
    return (
        environment()
        .get_template("board.html")
        .render(
            rows=rows,
            used=used,
            supply=SUPPLY,
            parts=parts,
            pitch=PITCH,
            size=SIZE,
            margin=MARGIN,
            width=20 * PITCH + 2 * MARGIN,
            height=max(row.top for row in rows) + SIZE + LABEL,
        )
    )
