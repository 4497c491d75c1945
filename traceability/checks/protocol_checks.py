"""doc-frame and doc-example: the numbers in the table of frames equal the numbers in the code, and
the bytes and the texts of the worked examples are right."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from cobs import cobs

from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.schema import Finding, Place
from traceability.sources import text_of
from weeding_robot_client.frames import crc16
from weeding_robot_client.layout import BY_QUANTITY, Layout, LayoutError, read_frames, value_name

FRAMES = "design/frames.toml"
EXAMPLES = "docs/protocol_examples.txt"
REASONS = "client/weeding_robot_client/reasons.py"
# A number in the text of an example, with the word before it and the unit and direction after it.
NUMBER = re.compile(
    r"(?:\b([a-z]+) )?(?<![\w.-])(?:(-?\d+(?:\.\d+)?) (degree|rpm|V|A|ms)s?\b"
    r"(?: to the (left|right))?|(\d\w*(?:\.\d+)*))"
)


def check(_model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _numbers(facts)
    yield from _examples(facts)


def _numbers(facts: Facts) -> Iterator[Finding]:
    """In design/frames.toml, finds types of frames and numbers of values that differ from the
    enumerators and constants of the firmware."""
    path = facts.root / FRAMES
    lines = text_of(path).splitlines()
    table = facts.declared.entries.whole(path)
    numbers = {constant.name: int(constant.number) for constant in facts.syntax.values}
    for pattern, text in [
        *_wrong_types(table, numbers),
        *_wrong_values(table, numbers),
        *_unnamed_causes(table, facts.root),
    ]:
        at = next((n for n, line in enumerate(lines, 1) if re.search(pattern, line)), 1)
        yield Finding(Place(FRAMES, at), "doc-frame", text)


def _wrong_types(table: dict[str, Any], numbers: dict[str, int]) -> Iterator[tuple[str, str]]:
    """Yields a pattern and the text of a finding for each frame with a wrong type. The pattern
    matches the line of the frame."""
    for frame in table.get("frame", []):
        name, kind = str(frame.get("name")), frame.get("type")
        right = numbers.get(f"FrameType::{name}", kind)
        if right != kind:
            text = f"the frame {name} has the type {right:#x} in FrameType, not {kind:#x}"
            yield f'^name = "{re.escape(name)}"$', text


def _wrong_values(table: dict[str, Any], numbers: dict[str, int]) -> Iterator[tuple[str, str]]:
    """Yields a pattern and the text of a finding for each value with a wrong number. The pattern
    matches the line of the value."""
    for enumeration in table.get("enumeration", []):
        firmware = str(enumeration.get("firmware", ""))
        for value in enumeration.get("values", []):
            name, number = value.get("name"), value.get("number")
            named = (value.get("firmware"), f"{firmware}::{value.get('firmware', name)}")
            right = next((numbers[one] for one in named if one in numbers), number)
            if right != number:
                pattern = rf'\b{number}, *name *= *"{re.escape(str(name))}"'
                yield pattern, f"{name} has the number {right} in {firmware}, not {number}"


def _unnamed_causes(table: dict[str, Any], root: Path) -> Iterator[tuple[str, str]]:
    """Yields a pattern and the text of a finding for each cause of a stop that has no text in the
    client. The pattern matches the line of the cause."""
    named = re.search(r"^CAUSES = \{(.*?)^\}", text_of(root / REASONS), re.DOTALL | re.MULTILINE)
    keys = set(re.findall(r'^    "([^"]+)":', named[1], re.MULTILINE)) if named else set()
    for enumeration in table.get("enumeration", []) if named else ():
        causes = enumeration["values"] if enumeration.get("firmware") == "StopCause" else ()
        for cause in [value["shown"] for value in causes if value["number"]]:
            if cause not in keys:
                yield rf'shown *= *"{re.escape(cause)}"', f"{REASONS} has no text for {cause}"


def _examples(facts: Facts) -> Iterator[Finding]:
    """Finds examples with a wrong check sum or wrong bytes on the serial line. The check computes
    the right values from the body of the frame. Also finds texts that do not match the body."""
    layouts = {}
    with suppress(LayoutError):  # The build reports a wrong table.
        frames = read_frames(text_of(facts.root / FRAMES)).frames.values()
        layouts = {layout.kind: layout for layout in frames}
    for place, line in lines_below(facts.root, (EXAMPLES,), ()):
        parts = [part.strip() for part in line.split(";")]
        if line.startswith("#") or len(parts) != 5:
            continue
        body, crc, coded = (bytes.fromhex(part) for part in parts[2:])
        right = {
            "check sum": crc16(body).to_bytes(2, "big") == crc,
            "bytes on the serial line": cobs.encode(body + crc[::-1]) + b"\0" == coded,
        }
        if wrong := [part for part, equal in right.items() if not equal]:
            text = f"wrong {' and '.join(wrong)} for the body of this example"
            yield Finding(place, "doc-example", text)
        for stated in not_in_body(body, parts[0], layouts):
            text = f"the text states '{stated}', but the body of this example does not contain it"
            yield Finding(place, "doc-example", text, "correct the text")


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
        else:  # An address is a value. The 2 in "wheel 2" is the end of the name of a value.
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
    """Returns those values of a frame that have a unit, each with its unit. The unit of a set-point
    is the unit of its quantity."""
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
