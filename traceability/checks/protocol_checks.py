"""doc-frame and doc-example: the numbers in the table of frames equal the numbers in the code, and
the bytes of the worked examples are right."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from traceability.model.design_model import Model
from traceability.reading.comments import code_of
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place

FRAMES = "design/frames.toml"
EXAMPLES = "docs/protocol_examples.txt"
ENUMERATOR = re.compile(r"(\w+)\s*(?:=\s*(0[xX][\da-fA-F]+|\d+))?\s*(?:,|$)")


def check(_model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _numbers(facts)
    yield from _examples(facts)


def _numbers(facts: Facts) -> Iterator[Finding]:
    """Finds types of frames and numbers of values in design/frames.toml that differ from the
    enumerators with the same name in the firmware."""
    path = facts.root / FRAMES
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    table = facts.declared.entries.whole(path)
    for pattern, text in [*_wrong_types(table, facts), *_wrong_values(table, facts)]:
        at = next((n for n, line in enumerate(lines, 1) if re.search(pattern, line)), 1)
        yield Finding(Place(FRAMES, at), "doc-frame", text)


def _wrong_types(table: dict[str, Any], facts: Facts) -> Iterator[tuple[str, str]]:
    """Yields for each frame with a wrong type: a pattern that matches its line, and the text of
    the finding."""
    numbers = _enumerators("FrameType", facts)
    for frame in table.get("frame", []):
        name, kind = str(frame.get("name")), frame.get("type")
        if name in numbers and numbers[name] != kind:
            text = f"the frame {name} has the type {numbers[name]:#x} in FrameType, not {kind:#x}"
            yield f'^name = "{re.escape(name)}"$', text


def _wrong_values(table: dict[str, Any], facts: Facts) -> Iterator[tuple[str, str]]:
    """Yields for each value with a wrong number: a pattern that matches its line, and the text of
    the finding."""
    for enumeration in table.get("enumeration", []):
        firmware = str(enumeration.get("firmware", ""))
        numbers = _enumerators(firmware, facts)
        for value in enumeration.get("values", []):
            name, number = value.get("name"), value.get("number")
            common = {name, value.get("firmware")} & numbers.keys()
            right = numbers[next(iter(common))] if common else number
            if right != number:
                pattern = rf'\b{number}, *name *= *"{re.escape(str(name))}"'
                yield pattern, f"{name} of {firmware} is {right}, not {number}"


def _enumerators(name: str, facts: Facts) -> dict[str, int]:
    """Returns the number of each enumerator of an enumeration, by name."""
    fact = facts.classes.get(name)
    if fact is None or fact.kind != "enum":
        return {}
    lines = (facts.root / fact.place.file).read_text(encoding="utf-8").splitlines()
    text = code_of("\n".join(lines[fact.place.line - 1 : fact.end]))
    body = text.partition("{")[2].partition("}")[0]
    numbers: dict[str, int] = {}
    following = 0
    for written, number in ENUMERATOR.findall(body):
        numbers[written] = int(number, 0) if number else following
        following = numbers[written] + 1
    return numbers


def _examples(facts: Facts) -> Iterator[Finding]:
    """Finds examples with a wrong check sum or wrong bytes on the serial line. Both are computed
    from the body of the frame."""
    path = facts.root / EXAMPLES
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    for number, line in enumerate(lines, 1):
        parts = [part.strip() for part in line.split(";")]
        if line.startswith("#") or len(parts) != 5:
            continue
        body, crc, coded = (bytes.fromhex(part) for part in parts[2:])
        wrong = [
            *(["check sum"] if _crc(body).to_bytes(2, "big") != crc else []),
            *(["bytes on the serial line"] if _stuffed(body + crc[::-1]) + b"\0" != coded else []),
        ]
        if wrong:
            text = f"the {' and the '.join(wrong)} of this example do not belong to its body"
            yield Finding(Place(EXAMPLES, number), "doc-example", text)


def _crc(data: bytes) -> int:
    """Returns the check sum CRC-16/CCITT-FALSE of the bytes."""
    value = 0xFFFF
    for byte in data:
        value ^= byte << 8
        for _ in range(8):
            value = (value << 1 ^ 0x1021 if value & 0x8000 else value << 1) & 0xFFFF
    return value


def _stuffed(data: bytes) -> bytes:
    """Encodes at most 253 bytes with COBS."""
    return b"".join(bytes([len(part) + 1]) + part for part in data.split(b"\0"))
