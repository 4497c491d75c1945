"""doc-warning: if the sentence before a list states a number of items, the list has this number of
items. If a text states the number of all scenarios, of all hazards or of all other parts of one
kind, this number is right."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path

from traceability.model.requirement_numbers import WORDS
from traceability.reading.bench_record import FOLDER as BENCH
from traceability.reading.source_lines import place_at, texts_below
from traceability.schema import Finding, Place
from traceability.sources import files_below, text_of

PAGES = ("README.md", "CONTRIBUTING.md", "docs", "changes", "ports")
TEXTS = (*PAGES, "design/questions.toml", "requirements", "site/templates")
SUFFIXES = (".md", ".rst", ".toml", ".dox", ".html")
NUMBERS = WORDS | {"thirteen": 13}
WORD = re.compile(rf"\b({'|'.join(NUMBERS)})\b", re.IGNORECASE)
ITEM = re.compile(r"( *)(?:[*-]|\d+\.|#\.) ")
# Part of the project -> the texts that mean all parts of this kind. {} is the number.
TOTALS = {
    "scenario": r"(?:{} scenarios of the paper|[Tt]he {} scenarios)",
    "assumption": r"(?:{} assumptions of use|[Tt]he {} assumptions)",
    "hazard": r"[Tt](?:here are|he) {} hazards",
    "goal": r"[Tt](?:here are|he) {} (?:safety )?goals",
    "product": r"(?:[Tt]here are|[Aa]ll) {} products",
    "application": r"(?:{} applications of patterns|[Tt]he {} (?:pattern )?applications)",
    "pattern": r"{} design patterns",
    "machine": r"(?:[Tt]here are|[Tt]he) {} state machines",
    "module": r"[Tt]he {} (?:design )?modules",
}
SOME = r"(?! (?:above|below|that|with|without)\b)"  # These words begin a limitation.
NUMBER = rf"(\d+|{'|'.join(NUMBERS)}|{'|'.join(map(str.capitalize, NUMBERS))})"
SENTENCE = re.compile(r"(?<=[.?]) ")


def wrong_counts(root: Path) -> Iterator[Finding]:
    """Finds lists whose number of items differs from the number in the sentence before the list."""
    for file, text in texts_below(root, PAGES, (".md", ".rst")):
        lines = text.splitlines()
        for number, line in enumerate(lines):
            if line.endswith(":"):
                stated, items = _stated(lines[: number + 1]), _items(lines[number + 1 :])
                if items and len(stated) == 1 and NUMBERS[stated[0]] != items:
                    said = f"the text states {stated[0]} items, but the list has {items}"
                    fix = "correct the number, or the list"
                    yield Finding(Place(file, number + 1), "doc-warning", said, fix)


def wrong_totals(root: Path) -> Iterator[Finding]:
    """Finds texts that state a wrong number of scenarios, hazards or other parts of the project."""
    totals = {part: total for part, total in _totals(root).items() if total}
    patterns = {
        part: re.compile(rf"\b{TOTALS[part].replace('{}', NUMBER)}\b{SOME}") for part in totals
    }
    for file, text in texts_below(root, TEXTS, SUFFIXES) if totals else ():
        in_one_line = re.sub(r"\s", " ", text)
        for part, pattern in patterns.items():
            for match in pattern.finditer(in_one_line):
                stated = next(filter(None, match.groups())).lower()
                if NUMBERS.get(stated, stated) not in (totals[part], str(totals[part])):
                    said = f"the text states '{match[0]}', but there are {totals[part]}"
                    place = place_at(file, text, match.start())
                    yield Finding(place, "doc-warning", said, "correct the number")


def _totals(root: Path) -> dict[str, int]:
    """Returns the number of parts of each kind."""

    def lines(file: str, start: str) -> list[str]:
        text = text_of(root / "design" / file)
        return [line for line in text.splitlines() if line.startswith(start)]

    return {
        "scenario": len(files_below(root, (str(BENCH),), (".scenario",))),
        **{
            part: len(lines("safety_case.toml", f"[[{part}]]"))
            for part in ("assumption", "hazard", "goal")
        },
        "product": len(lines("products.toml", "[[product]]")),
        "application": len(lines("applications.toml", "[[application]]")),
        "pattern": len(set(lines("applications.toml", "pattern ="))),
        "machine": len(files_below(root, ("design/fsm",), (".toml",))),
        "module": sum(int(line.split("=")[1]) for line in lines("modules.toml", "total =")),
    }


def _stated(lines: list[str]) -> list[str]:
    """Returns the words for numbers in the last sentence of these lines."""
    paragraph = reversed(list(takewhile(str.strip, reversed(lines))))
    sentence = SENTENCE.split(" ".join(map(str.strip, paragraph)))[-1]
    return [word.lower() for word in WORD.findall(sentence)]


def _items(lines: list[str]) -> int:
    """Returns the number of items of the list with which these lines begin. Returns 0 if they do
    not begin with a list."""
    written = [line for line in lines if line.strip()]
    first = ITEM.match(written[0]) if written else None
    if first is None:
        return 0
    indent = len(first[1])
    inside = takewhile(
        lambda line: ITEM.match(line) or line.startswith(" " * (indent + 1)), written
    )
    return sum(bool(item) and len(item[1]) == indent for item in map(ITEM.match, inside) if item)
