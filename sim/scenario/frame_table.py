"""Writes the table of frames as C++: a header for the scenarios, and a file for the test of the
layout in the firmware.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "client"))

# The import needs the path that was added above.
from weeding_robot_client.layout import FRAMES, WHEEL_COUNT, Field, Layout  # noqa: E402 - its folder is added first

TYPES = {
    "u8": "std::uint8_t",
    "i8": "std::int8_t",
    "u16": "std::uint16_t",
    "i16": "std::int16_t",
    "u32": "std::uint32_t",
    "i32": "std::int32_t",
    "char8": "std::array<char, 8>",
}
HEAD = """\
// Made by sim/scenario/frame_table.py from design/frames.toml.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sim/scenario/Payload.hpp"

namespace wr::scenario {
"""


def camel(name: str) -> str:
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


def stems(layout: Layout) -> dict[str, list[Field]]:
    """Returns the members of the C++ structure. The fields of the four wheels are one member."""
    members: dict[str, list[Field]] = {}
    for one in layout.fields:
        members.setdefault(one.stem, []).append(one)
    return members


def struct(layout: Layout) -> Iterator[str]:
    """Yields the source lines of a C++ structure that reads and writes the payload of a frame."""
    yield f"struct {layout.name}Payload {{"
    yield f"  static constexpr std::uint8_t kType = {layout.kind:#04x};"
    for stem, fields in stems(layout).items():
        form = TYPES[fields[0].type]
        array = fields[0].wheel is not None
        yield f"  {f'std::array<{form}, {WHEEL_COUNT}>' if array else form} {camel(stem)}{{}};"
    for one in layout.fields:
        for bit in one.bits:
            test = f"({camel(one.name)} >> {bit.number}U & 1U) != 0"
            yield f"  [[nodiscard]] bool {camel(bit.name)}() const {{ return {test}; }}"
    places = [(member(one), one.offset) for one in layout.fields]
    name = "body" if places else "/*body*/"
    yield f"  [[nodiscard]] static {layout.name}Payload from(const Bytes& {name}) {{"
    yield f"    {layout.name}Payload payload;"
    yield from (f"    readAt(body, {offset}, payload.{place});" for place, offset in places)
    yield "    return payload;\n  }"
    yield "  [[nodiscard]] Bytes bytes() const {"
    yield "    Bytes result;"
    yield from (f"    append(result, {place});" for place, _ in places)
    yield "    return result;\n  }\n};\n"


def member(one: Field) -> str:
    index = "" if one.wheel is None else f"[{one.wheel}]"
    return camel(one.stem) + index


def readable() -> Iterator[str]:
    """Yields the numbers and bits that scenarios read from the robot's frames."""
    for layout in FRAMES.frames.values():
        for one in layout.fields if layout.sender == "MCU" else ():
            place = f"{layout.kind:#04x}, {one.offset}, FrameField::Form"
            if one.bits:
                for bit in one.bits:
                    yield f'{{"{bit.name}", {place}::Bit, {bit.number}}}'
            elif one.type != "char8":
                yield f'{{"{one.name}", {place}::{one.type.upper()}, 0}}'


def words() -> Iterator[str]:
    """Yields the words that scenarios use for the numbers of the readable fields."""
    for layout in FRAMES.frames.values():
        for one in layout.fields if layout.sender == "MCU" else ():
            for entry in one.values.entries if one.values else ():
                yield f'{{"{one.name}", "{entry.name}", {entry.number}}}'
            if one.none is not None:
                yield f'{{"{one.name}", "none", {one.none}}}'


def rows() -> Iterator[str]:
    for layout in FRAMES.frames.values():
        for one in layout.fields:
            yield f'{{"{layout.name}", "{one.name}", "{one.type}", {one.offset}, {one.size}}}'


def limits() -> Iterator[str]:
    for one in FRAMES.frames["Order"].fields:
        if one.limit is not None:
            yield f'{{"{one.name}", {one.limit}}}'
    for entry in FRAMES.enumerations["quantity"].entries:
        yield f'{{"{entry.name}", {entry.limit}}}'


def array(form: str, name: str, items: Iterator[str]) -> str:
    lines = ",\n    ".join(items)
    return f"inline constexpr auto {name} = std::to_array<{form}>({{\n    {lines},\n}});\n"


def table() -> str:
    """Returns the header for the scenarios."""
    parts = [HEAD, f"inline constexpr std::uint32_t kTableHash = {FRAMES.schema_hash:#010x};\n"]
    parts += ["\n".join(struct(layout)) for layout in FRAMES.frames.values()]
    parts += [
        array("FrameField", "kFrameFields", readable()),
        array("FrameWord", "kFrameWords", words()),
        array("FrameRow", "kFrameRows", rows()),
        array("FrameLimit", "kFrameLimits", limits()),
    ]
    return "\n".join(parts) + "\n}  // namespace wr::scenario\n"


def firmware() -> str:
    """Returns a C++ table for a test. A row contains a name in the firmware and its number."""
    names = {f"FrameType::{one.name}": one.kind for one in FRAMES.frames.values()}
    for enumeration in FRAMES.enumerations.values():
        names |= {entry.firmware: entry.number for entry in enumeration.entries}
    lines = (f'  {{"{name}", static_cast<unsigned>({name}), {n}}},' for name, n in names.items())
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    out = Path(sys.argv[1])
    for file, text in (("FrameTable.hpp", table()), ("FirmwareNumbers.inc", firmware())):
        (out / file).write_text(text, encoding="utf-8")
