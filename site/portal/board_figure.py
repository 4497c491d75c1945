"""The drawing of the pin headers of the board FRDM-K64F, with the pins that the firmware uses. The
pin table of the firmware lists these pins."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup, escape

from portal.pin_map import HEADER, entries, roles

PITCH = 35
SIZE = 26  # size of a pin
LABEL = 205  # space for a vertical label of a pin of the robot
SHORT = 112  # space for a short vertical label
MARGIN = 8
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


def headers() -> list[Row]:
    """Returns the rows of all headers as a reader sees the board from above, in the Arduino R3
    layout. The pins with even numbers are at the edges of the board."""
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
        # reader, the label shows the effect of the pin instead.
        named = self.signal.islower()
        return self.signal.replace("_", " ") if named else self.effect.rstrip(".")


def used_pins(root: Path) -> dict[str, Used]:
    """Returns the pins of the headers that the firmware uses. The key is the header and the number
    of the pin, as in "J1-4"."""
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
    width = 20 * PITCH + 2 * MARGIN
    height = max(row.top for row in rows) + SIZE + LABEL
    parts = [part for row in rows for part in _row(row, used)]
    title = "Headers of the FRDM-K64F with the pins of the firmware; the table lists the same pins"
    return str(
        Markup(
            '<figure class="fig board"><div class="scroll" tabindex="0" role="region"'
            ' aria-label="Headers of the board">'
            '<svg width="{w}" height="{h}" viewBox="0 0 {w} {h}" style="--width: {w}px" '
            'role="group" aria-label="{title}">{parts}</svg></div>\n'
            "<figcaption>The headers seen from above, in the order of the Arduino R3 layout. "
            "Sockets and distances are not drawn. Nobody has compared this drawing with a real "
            "board. Use the pin numbers that are printed on your board.</figcaption>\n{legend}"
            "</figure>\n"
        ).format(w=width, h=height, title=title, parts=Markup("").join(parts), legend=_legend(used))
    )


def _legend(used: dict[str, Used]) -> Markup:
    """Returns the legend: a button for each part of the robot. When the reader presses a button,
    the script app.js marks the pins of this part."""
    parts = [part for part in dict.fromkeys(pin.part for pin in used.values()) if part[0]]
    buttons = (
        Markup('<button type="button" class="btn {}" data-part="{}">{}</button>').format(
            f"pin-{kind}", kind, name
        )
        for name, kind in parts
    )
    return Markup('<p class="parts">{}</p>\n').format(Markup(" ").join(buttons))


def _row(row: Row, used: dict[str, Used]) -> Iterator[Markup]:
    left = MARGIN + row.left * PITCH
    wide = len(row.pins) * PITCH
    # Only one row of a header shows the name of the header.
    if row.pins[0] % 2 == (row.header not in ("J1", "J2")):
        yield Markup('<text x="{}" y="{}" class="b">{}</text>').format(
            left + wide + 2, row.top + SIZE + 4, row.header
        )
    for column, number in enumerate(row.pins):
        place = f"{row.header}-{number}"
        yield _pin(place, number, left + column * PITCH, row, used.get(place))


def _pin(place: str, number: int, x: int, row: Row, used: Used | None) -> Markup:
    """Returns the drawing of the pin with its number and its label. A free pin has no label,
    unless it is a supply pin."""
    middle = x + SIZE // 2
    y = row.top - 6 if row.above else row.top + SIZE + 6
    label = used.label if used else SUPPLY.get(place, "")
    text = Markup(
        '<text transform="translate({} {}) rotate(-90)" text-anchor="{}">{}</text>'
    ).format(middle + 4, y, "start" if row.above else "end", label)
    box = Markup(
        '<rect x="{}.5" y="{}.5" width="{}" height="{}" rx="3"/>'
        '<text x="{}" y="{}" class="m">{}</text>'
    ).format(x, row.top, SIZE, SIZE, middle + 0.5, row.top + 18, number)
    if used is None:
        return Markup('<g class="pin free">{}{}</g>').format(box, text if label else "")
    title = escape(f"{place}, {used.pin}, {used.signal}: {used.effect}")
    return Markup(
        '<g class="pin pin-{}" data-pin="{}" data-part="{}"><title>{}</title>{}{}</g>'
    ).format(used.part[1], used.pin, used.part[1], title, box, text)
