"""Reads ``design/changes.toml``: the texts of the likely changes."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.toml_reader import Entries
from traceability.schema import Place

FILE = Path("design/changes.toml")


@dataclass
class Recipe:
    """The steps that change an application of a pattern. The roles are roles of this pattern."""

    pattern: str
    alters: list[str]  # Each module with one of these roles hides a variant.
    adds: str = ""  # role of a new class
    derives: str = ""  # role from which a new class derives
    steps: list[str] = field(default_factory=list)
    place: Place = field(default_factory=lambda: Place(str(FILE), 1))


@dataclass
class Particular:
    """The texts about the change of one application."""

    id: str
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
    recipes = entries.records(path, "recipe", Recipe, "pattern", may=["adds", "derives", "steps"])
    particulars = entries.records(
        path, "application", Particular, "id", may=["derives", "examples", "steps"]
    )
    return ChangeTexts(
        {each.pattern: each for each in recipes}, {each.id: each for each in particulars}
    )
