"""doc-example: the worked examples of the protocol contain the frames and the numbers of their
texts."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place
from traceability.sources import text_of
from weeding_robot_client.layout import BY_QUANTITY, Layout, LayoutError, read_frames, value_name

FRAMES = "design/frames.toml"
EXAMPLES = "docs/protocol_examples.txt"

# A number in the text of an example, with the word before it and the unit and direction after it.
NUMBER = re.compile(
    r"(?:\b([a-z]+) )?(?<![\w.-])(?:(-?\d+(?:\.\d+)?) (degree|rpm|V|A|ms)s?\b"
    r"(?: to the (left|right))?|(\d\w*(?:\.\d+)*))"
)


def check(_model: Model, facts: Facts) -> Iterator[Finding]:
    layouts = {}
    with suppress(LayoutError):  # The build reports a wrong table.
        frames = read_frames(text_of(facts.root / FRAMES)).frames.values()
        layouts = {layout.kind: layout for layout in frames}
    for number, line in enumerate(text_of(facts.root / EXAMPLES).splitlines(), 1):
        parts = [part.strip() for part in line.split(";")]
        if line.startswith("#") or len(parts) != 5:
            continue
        for stated in not_in_body(bytes.fromhex(parts[2]), parts[0], layouts):
            text = f"the text states '{stated}', but the body of this example does not contain it"
            yield Finding(Place(EXAMPLES, number), "doc-example", text, "correct the text")


def not_in_body(body: bytes, text: str, layouts: dict[int, Layout]) -> Iterator[str]:
    """Yields the parts of the text of an example that differ from the body of the frame: the name
    of the frame, and the numbers."""
    layout = layouts.get(body[1])
    if layout is None or len(body) != 3 + layout.size:
        return
    if not text.replace(" ", "").startswith(layout.name.lower()):
        yield text.split(" ", maxsplit=1)[0]
    values = layout.decode(body[3:])
    with_unit = _with_units(layout, body[3:], values)
    for match in NUMBER.finditer(text):
        word, amount, unit, side, number = match.groups()
        of_word = [str(value) for name, value in values.items() if word and name.startswith(word)]
        if unit:
            right = (float(amount) * (-1 if side == "right" else 1), unit) in with_unit
        elif of_word:
            right = number in (*of_word, ".".join(of_word))
        else:  # For example "wheel 2" or an address: a value, or the end of the name of a value.
            shown = str(int(number, 16)) if number.startswith("0x") else number
            right = any(
                str(value) == shown or (value and name.endswith(number))
                for name, value in values.items()
            )
        if not right:
            yield match[0].strip()


def _with_units(
    layout: Layout, payload: bytes, values: dict[str, Any]
) -> set[tuple[float | None, str]]:
    """Returns the values of a frame that have a unit, with their units. The unit of a set-point is
    the unit of its quantity."""
    numbers = layout.unpack(payload)
    result = set()
    for one in layout.fields:
        unit = one.unit
        if unit == BY_QUANTITY:
            quantity = layout.of(f"{BY_QUANTITY}{one.wheel}")
            entry = quantity.values.find(numbers[quantity.name]) if quantity.values else None
            unit = entry.unit if entry else ""
        if unit:
            result.add((values.get(value_name(one)), unit))
    return result
