"""Generates tables of the PC protocol from design/frames.toml. Hand-written pages include them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from portal.tables import list_table
from portal.templates import TEMPLATES
from traceability.reading.results import LIVE_MODULE
from weeding_robot_client.layout import (
    BY_QUANTITY,
    WHEEL_COUNT,
    Enumeration,
    Field,
    FrameTable,
    Layout,
    read_frames,
)

TABLE = Path("design/frames.toml")
# Number of columns of a table of values -> widths of these columns [per cent].
VALUES_WIDTHS = {4: (12, 22, 24, 42), 5: (8, 16, 16, 28, 32), 6: (8, 14, 14, 22, 16, 26)}


def frame_tables(root: Path) -> dict[str, str]:
    """Returns the text of each table that a page can include. The key is the file name."""
    if not (root / TABLE).exists():
        return {}
    frames = read_frames((root / TABLE).read_text(encoding="utf-8"))
    files = {"frame_types.inc": types_table(frames)}
    for layout in frames.frames.values():
        files[f"frame_{layout.name.lower()}.inc"] = fields_table(layout)
    for enumeration in frames.enumerations.values():
        name = f"values_{enumeration.name.replace(' ', '_')}.inc"
        files[name] = values_table(enumeration)
    files["counters.inc"] = counters_table(frames)
    return files


def types_table(frames: FrameTable) -> str:
    rows = [
        (
            f"{layout.kind:#04x}",
            layout.name,
            "PC to MCU" if layout.sender == "PC" else "MCU to PC",
            f"{layout.size} bytes" if layout.size != 1 else "1 byte",
            layout.use,
        )
        for layout in frames.frames.values()
    ]
    return list_table((12, 18, 18, 12, 40), ("type", "name", "from, to", "payload", "use"), rows)


def fields_table(layout: Layout) -> str:
    """Returns the table of the fields of a frame. A field that exists once for each wheel has a
    single row for all wheels."""
    fields = list(layout.fields)
    rows = []
    while fields:
        field = fields.pop(0)
        rows.append(field_row(field, [other for other in fields if other.stem == field.stem]))
        if field.wheel is not None:
            fields = [other for other in fields if other.stem != field.stem]
    heads = ("offset", "type", "name", "unit", "meaning")
    return list_table((12, 8, 22, 14, 44), heads, rows)


def field_row(field: Field, of_other_wheels: Iterable[Field]) -> tuple[str, ...]:
    offsets = [field.offset, *(other.offset for other in of_other_wheels)]
    where = ", ".join(map(str, offsets))
    return where, field.type, shown_name(field), unit_of(field), ". ".join(meanings(field))


def shown_name(field: Field) -> str:
    """Returns the name of a field. If each wheel has such a field, returns the first name and the
    last number."""
    name = field.name if field.wheel is None else f"{field.stem}0`` to ``{WHEEL_COUNT - 1}"
    return f"``{name}``"


def counters_table(frames: FrameTable) -> str:
    """Returns the table of the counters. It shows the counted events and the first check of each
    counter. The counters of all wheels have a single row."""
    fields = (field for layout in frames.frames.values() for field in layout.fields)
    rows = (
        (shown_name(field), field.meaning, field.check)
        for field in fields
        if field.counter and not field.wheel
    )
    return list_table((20, 36, 44), ("counter", "counted events", "check first"), rows)


def unit_of(field: Field) -> str:
    if field.unit == BY_QUANTITY:
        return "of the quantity"
    if not field.unit:
        return ""
    unit = shown_unit(field.unit, field.scale)
    return f"{unit}, -{field.limit} to {field.limit}" if field.limit else unit


def meanings(field: Field) -> Iterator[str]:
    """Yields the meaning of a field, then the meanings of its values and bits."""
    yield field.meaning
    if field.values:
        yield f"See :ref:`{field.values.page}`" if field.values.page else in_line(field.values)
    if field.none is not None:
        yield f"{field.none} none"
    if field.bits:
        yield "; ".join(f"bit {bit.number} ``{bit.name}``: {bit.meaning}" for bit in field.bits)
    if field.bits_of:
        yield "bit n: the source whose number is n"
    if field.valid:
        bits = ", ".join(f"{number} ``{name}``" for number, name in enumerate(field.valid))
        yield f"A bit is set when its value is valid: {bits}"


def in_line(enumeration: Enumeration) -> str:
    """Returns the numbers of an enumeration with their names, as the text of a table cell."""
    return ", ".join(
        f"{entry.number} {entry.name}"
        + (f" ({entry.meaning})" if entry.meaning else "")
        + (
            f" in {shown_unit(entry.unit, entry.scale)}, -{entry.limit} to {entry.limit}"
            if entry.limit
            else ""
        )
        for entry in enumeration.entries
    )


def shown_unit(unit: str, scale: float) -> str:
    """Returns the unit of the integer that a frame carries, such as mV or 0.1 rpm."""
    if scale == 0.001:
        return f"m{unit}"
    return unit if scale == 1 else f"{scale:g} {unit}"


def values_table(enumeration: Enumeration) -> str:
    """Returns the table of the numbers of an enumeration, with the text that the client shows for
    each number."""
    has_checks = any(entry.check for entry in enumeration.entries)
    heads = [enumeration.name, "in scenarios", "shown as", "meaning"]
    heads += [enumeration.detail] if enumeration.detail else []
    heads += ["check first"] if has_checks else []
    rows = []
    for entry in enumeration.entries:
        row = [str(entry.number), f"``{entry.name}``", entry.shown.replace("{number}", "n")]
        row += [entry.meaning]
        row += [entry.detail] if enumeration.detail else []
        row += [entry.check] if has_checks else []
        rows.append(tuple(row))
    return list_table(VALUES_WIDTHS[len(heads)], heads, rows)


def live_frames(root: Path) -> str:
    """Returns the HTML element that shows the frames while the simulated robot runs in the page. If
    the WebAssembly module was not built, returns a sentence that reports this."""
    if not (root / LIVE_MODULE).exists():
        return "<p>The WebAssembly module was not built. This module runs the robot.</p>\n"
    return (TEMPLATES / "live_frames.html").read_text(encoding="utf-8")
