"""Reads ``design/changes.toml``: the texts of the likely changes."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.toml_reader import Entries
from traceability.schema import Place

FILE = Path("design/changes.toml")


@dataclass
class Recipe:
    """The recipe of a pattern: the steps that make a likely change where this pattern is used.
    ``alters``, ``adds`` and ``derives`` name roles of the pattern."""

    pattern: str
    # Each module with one of these roles implements one variant. To change a variant, only its
    # module must be edited.
    alters: list[str]
    adds: str = ""  # role of the class that the change adds
    derives: str = ""  # the added class derives from a class with this role
    steps: list[str] = field(default_factory=list)
    place: Place = field(default_factory=lambda: Place(str(FILE), 1))


@dataclass
class Particular:
    """The texts about the likely change of one pattern application."""

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
    recipes = entries.named(path, "recipe", Recipe, "pattern", may=["adds", "derives", "steps"])
    may = ["derives", "examples", "steps"]
    return ChangeTexts(recipes, entries.named(path, "application", Particular, "id", may=may))
