"""Values that were chosen by hand for the present value of another constant. If this other constant
changes, these values must be chosen again."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.constant_texts import constant_text
from traceability.reading.plain_constants import plain_constants
from traceability.reading.source_lines import place_of
from traceability.schema import Constant, Place, Tuned


def chosen_values(
    root: Path, model: Model, tuned: Tuned
) -> dict[str, list[tuple[str, str, Place | None]]]:
    """Returns the constants that must be chosen again, grouped by module. For each constant, the
    result contains the name, the value with its unit, and the place. The value is empty if the
    model does not contain it."""
    values: dict[str, list[tuple[str, str, Place | None]]] = {}
    for name in tuned.constants:
        module, _, own = name.partition("::")
        parts = dict(parts_of(model, name))
        numbers = [f"{part} {shown(value)}".strip() for part, value in parts.items()]
        place = next((value.place for value in parts.values()), None)
        value = own, ", ".join(numbers), place or declared_at(root, model, name)
        values.setdefault(module, []).append(value)
    return values


def parts_of(model: Model, name: str) -> Iterator[tuple[str, Constant]]:
    """Yields the value of a constant, or the values of its members with their names."""
    for key, constant in model.constants.items():
        own, _, part = key.partition(".")
        if own == name:
            yield part, constant


def shown(constant: Constant) -> str:
    """Returns the value with its unit, such as ``17.6 rpm`` or ``2094 uV per 0.1 rpm``."""
    if " per " in constant.unit:
        return f"{constant.number:.12g} {constant.unit}"
    return constant_text(constant)


def declared_at(root: Path, model: Model, name: str) -> Place | None:
    """Returns the first place that names a constant, in the files of the constant's module."""
    owner, _, own = name.partition("::")
    module = model.modules.get(owner)
    files = (module.source, module.header) if module else ()
    places = (place_of(root, f"{file}: {own}") for file in files if file)
    return next((place for place in places if place), None)


def other_lines(root: Path, tuned: Tuned) -> list[tuple[Place, str]]:
    """Returns other source lines that must be edited together with the constants. Each line has its
    place."""
    lines = []
    for line in tuned.lines:
        place = place_of(root, line)
        if place:
            text = (root / place.file).read_text(encoding="utf-8").splitlines()[place.line - 1]
            lines.append((place, text.strip()))
    return lines


def constant_named(root: Path, model: Model, name: str) -> Constant | None:
    """Returns a constant of the firmware or of the simulator."""
    return model.constants.get(name) or plain_constants(root).get(name)
