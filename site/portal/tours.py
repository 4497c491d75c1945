"""Guided tours. A tour leads the reader from page to page. After the last page, it proposes an
action."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

from traceability.sources import text_of

TOURS = Path("design/tours.toml")


@dataclass
class Tour:
    """A tour through the pages. Each stop has the address of a page, and a task for the reader.
    ``action`` is a command to try at the end, with its effect."""

    id: str
    title: str
    action: dict[str, str]
    stops: list[dict[str, str]]


def tours_of(root: Path) -> list[Tour]:
    return [Tour(**entry) for entry in tomllib.loads(text_of(root / TOURS)).get("tour", [])]
