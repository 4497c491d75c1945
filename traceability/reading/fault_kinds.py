"""Reads the kinds of faults that the campaign injects, from the sources of the campaign and of the
simulated robot."""

from __future__ import annotations

import re
from pathlib import Path

from traceability.sources import text_of

KINDS = Path("sim/faults/InjectedFault.hpp")
CHOICES = Path("sim/faults/InjectedFault.cpp")
PLANT = Path("sim/plant/Robot.hpp")
_ENUMERATION = r"enum class {}\b[^{{]*{{\n(.*?)\n}};"
_ENUMERATOR = re.compile(r"\s*(?:(\w+),?\s*)?///<\s*(.*)")
# A choice such as {Fault::HallLosses, 1, 60}: the fault, its least value and its greatest value.
_CHOICE = re.compile(r"\{Fault::(\w+), (-?\d+), (-?\d+)\}")
_VALUE = "; value: "


def fault_kinds(root: Path) -> dict[str, str]:
    """Returns the explanation of each kind of fault. The names of the kinds are those of the
    record."""
    return {name.lower(): text for name, text in enumerators(root / KINDS, "Kind").items()}


def sensor_faults(root: Path) -> list[str]:
    """The campaign chooses from several faults of sensors. Returns these faults, each with the
    range of its value."""
    texts = enumerators(root / PLANT, "Fault")
    choices = _CHOICE.findall(text_of(root / CHOICES))
    return [_with_range(texts.get(name, name), *values) for name, *values in choices]


def _with_range(text: str, least: str, most: str) -> str:
    effect, _, unit = text.partition(_VALUE)
    return f"{effect} ({least} to {most}, in {unit})" if unit else effect


def enumerators(path: Path, name: str) -> dict[str, str]:
    """Returns the enumerators of a C++ enumeration, with their comments. The result is empty if the
    file does not exist."""
    text = text_of(path)
    found: dict[str, str] = {}
    last = ""
    for body in re.findall(_ENUMERATION.format(name), text, re.DOTALL):
        for match in filter(None, map(_ENUMERATOR.fullmatch, body.splitlines())):
            last = match[1] or last
            found[last] = f"{found[last]} {match[2]}" if last in found else match[2]
    return found
