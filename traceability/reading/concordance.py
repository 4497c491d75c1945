"""Reads the names in the paper (``paper.toml``) and their counterparts in this project
(``concordance.toml``)."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.reading.toml_reader import Entries
from traceability.schema import PaperElement, PaperPlace, PaperStatement, Place

PAPER = Path("design/paper.toml")
CONCORDANCE = Path("design/concordance.toml")
STATEMENTS = Path("design/statements.toml")


@dataclass
class Concordance:
    """The places of the paper, the names that the paper uses at these places, and the entries of
    the concordance."""

    places: list[PaperPlace] = field(default_factory=list)
    # element -> ids of the places that contain it
    named: dict[tuple[str, str], list[str]] = field(default_factory=dict)
    # element -> place of its name in paper.toml
    lines: dict[tuple[str, str], Place] = field(default_factory=dict)
    entries: list[PaperElement] = field(default_factory=list)
    statements: list[PaperStatement] = field(default_factory=list)


def read_concordance(root: Path, entries: Entries) -> Concordance:
    """Reads the concordance. Each entry receives the list of the places in the paper that contain
    its name."""
    if not (root / PAPER).exists() or not (root / CONCORDANCE).exists():
        return Concordance()
    concordance = _paper(root, entries)
    concordance.entries = [
        replace(entry, where=concordance.named.get((entry.kind, entry.name), []))
        for entry in _entries(root, entries)
    ]
    may, keys = ["deviation"], {"where": "place"}
    concordance.statements = entries.records(
        root / STATEMENTS, "statement", PaperStatement, "says", may=may, keys=keys
    )
    return concordance


def _paper(root: Path, entries: Entries) -> Concordance:
    concordance = Concordance()
    entries.value(root / PAPER, "source", "")
    lines = (root / PAPER).read_text(encoding="utf-8").splitlines()
    needs = {"id": str, "kind": str, "title": str}
    for item, header in entries.tables(root / PAPER, "place", needs, {"names": dict}, own="id"):
        start = header.line  # In the TOML file, the id is on a line below the header of the table.
        place = Place(str(PAPER), start + 1)
        concordance.places.append(PaperPlace(item["id"], item["kind"], item["title"], place))
        own = (item["kind"], item["id"])
        concordance.named[own] = []
        concordance.lines[own] = place
        for kind, names in item.get("names", {}).items():
            for name in names:
                concordance.named.setdefault((kind, name), []).append(item["id"])
                concordance.lines.setdefault(
                    (kind, name), Place(str(PAPER), _line(lines, name, start))
                )
    return concordance


def _entries(root: Path, entries: Entries) -> list[PaperElement]:
    path = root / CONCORDANCE
    lines = path.read_text(encoding="utf-8").splitlines()
    same = next((n for n, line in enumerate(lines) if line.startswith("[same]")), 0)
    elements = [
        PaperElement(
            kind, name, [f"{kind}:{name}"], place=Place(str(CONCORDANCE), _line(lines, name, same))
        )
        for kind, names in entries.value(path, "same", {}).items()
        for name in names
    ]
    written = entries.records(path, "entry", PaperElement, may=["alias", "deviation", "note"])
    return elements + written


def _line(lines: list[str], name: str, start: int) -> int:
    """Returns the number of the first line that contains a name. The search begins at a given
    line."""
    pattern = re.compile(rf'"{re.escape(name)}"')
    return next((n + 1 for n in range(start, len(lines)) if pattern.search(lines[n])), start + 1)
