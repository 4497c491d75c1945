"""Reads ``design/changes.toml``: the texts of the likely changes."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.toml_reader import Entries
from traceability.schema import Place

FILE = Path("design/changes.toml")


@dataclass
class Recipe:
    """The steps that change an application of a pattern. The roles belong to the pattern."""

    alters: list[str]  # roles; each of their modules hides one variant
    adds: str = ""  # role of a new class
    derives: str = ""  # role from which a new class derives
    steps: list[str] = field(default_factory=list)
    place: Place = field(default_factory=lambda: Place(str(FILE), 1))


@dataclass
class Particular:
    """The data of one application."""

    derives: list[str] = field(default_factory=list)
    examples: list[str] = field(default_factory=list)
    steps: list[str] = field(default_factory=list)
    place: Place = field(default_factory=lambda: Place(str(FILE), 1))


@dataclass
class ChangeTexts:
    recipes: dict[str, Recipe] = field(default_factory=dict)
    particulars: dict[str, Particular] = field(default_factory=dict)


def read_change_texts(root: Path, entries: Entries) -> ChangeTexts:
    path = root / FILE
    recipes = entries.tables(
        path,
        "recipe",
        {"pattern": str, "alters": list},
        {"adds": str, "derives": str, "steps": list},
        own="pattern",
    )
    particulars = entries.tables(
        path,
        "application",
        {"id": str},
        {"derives": list, "examples": list, "steps": list},
        own="id",
    )
    return ChangeTexts(
        {item.pop("pattern"): Recipe(place=place, **item) for item, place in recipes},
        {item.pop("id"): Particular(place=place, **item) for item, place in particulars},
    )
