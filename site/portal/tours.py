"""Tours through the pages. A tour has stops in the order of reading, and an action at the end."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

TOURS = Path("design/tours.toml")


@dataclass
class Tour:
    """A tour; each stop has an address and a task."""

    id: str
    title: str
    action: dict[str, str]
    stops: list[dict[str, str]]


def tours_of(root: Path) -> list[Tour]:
    path = root / TOURS
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return [Tour(**entry) for entry in tomllib.loads(text).get("tour", [])]
