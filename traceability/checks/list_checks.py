"""doc-warning: if the sentence before a list states a number of items, the list has this number
of items."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path

from traceability.schema import Finding, Place
from traceability.sources import files_below

PAGES = ("README.md", "CONTRIBUTING.md", "docs", "changes", "ports")
WORDS = ("two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
NUMBERS = {word: number for number, word in enumerate(WORDS, 2)}
WORD = re.compile(rf"\b({'|'.join(NUMBERS)})\b", re.IGNORECASE)
ITEM = re.compile(r"( *)(?:[*-]|\d+\.|#\.) ")
SENTENCE = re.compile(r"(?<=[.?]) ")


def wrong_counts(root: Path) -> Iterator[Finding]:
    """Finds lists whose number of items differs from the number in the sentence before the list."""
    for path in files_below(root, PAGES, (".md", ".rst")):
        lines = path.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines):
            if line.endswith(":"):
                stated, items = _stated(lines[: number + 1]), _items(lines[number + 1 :])
                if items and len(stated) == 1 and NUMBERS[stated[0]] != items:
                    text = f"the text states {stated[0]} items, but the list has {items}"
                    place = Place(str(path.relative_to(root)), number + 1)
                    yield Finding(place, "doc-warning", text, "correct the number, or the list")


def _stated(lines: list[str]) -> list[str]:
    """Returns the words for numbers in the last sentence."""
    paragraph = reversed(list(takewhile(str.strip, reversed(lines))))
    sentence = SENTENCE.split(" ".join(map(str.strip, paragraph)))[-1]
    return [word.lower() for word in WORD.findall(sentence)]


def _items(lines: list[str]) -> int:
    """Returns the number of items of the list that begins with these lines, or 0."""
    written = [line for line in lines if line.strip()]
    first = ITEM.match(written[0]) if written else None
    if first is None:
        return 0
    indent = len(first[1])
    inside = takewhile(
        lambda line: ITEM.match(line) or line.startswith(" " * (indent + 1)), written
    )
    return sum(bool(item) and len(item[1]) == indent for item in map(ITEM.match, inside) if item)
