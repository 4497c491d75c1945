"""link-doc: a pin in a page or in a text of design/ has the signal and the connector that
src/k64/pins.hpp lists."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from traceability.reading.source_lines import place_at, texts_below
from traceability.schema import Finding
from traceability.sources import text_of

PINS = "src/k64/pins.hpp"
PAGES = ("README.md", "docs", "design")
ROW = re.compile(
    r'\{\{Port::([A-E]), (\d+), \w+::\w+, \w+::\w+\}, "([^"]*)", "([^"]*)", "([^"]*)"\}'
)
PIN = re.compile(r"\bPT[A-E]\d+\b")
LABEL = re.compile(r"([A-Za-z][A-Za-z ]*)[:,]? $")  # words before a pin
AFTER = re.compile(r"\s\(([^)]*)\)|, (J\d+-\d+)")  # words or a connector after a pin
CONNECTOR = re.compile(r"J\d+-\d+")
NEXT = re.compile(r"(?: \([^)]*\))?(?:,| and| to)* ")  # text between two pins that share a label
# Words that are not part of the name of a signal.
OTHERS = {
    *("a", "and", "at", "from", "in", "of", "the", "to", "when", "while", "with"),
    *("high", "is", "it", "low"),
}


@dataclass
class _Pin:
    connector: str
    words: set[str]  # words in the row of the pin


def wrong_pins(root: Path) -> Iterator[Finding]:
    """Finds pins for which a text names the connector or the signal of another pin."""
    pins = _pins(root)
    for file, text in texts_below(root, PAGES, (".md", ".rst", ".toml")) if pins else ():
        label, end = "", 0
        for match in PIN.finditer(text):
            if not (end and NEXT.fullmatch(text[end : match.start()])):
                before = LABEL.search(text[: match.start()].rpartition("\n")[2])
                label = before[1] if before else ""
            end = match.end()
            after = AFTER.match(text, match.end())
            behind = (after[1] or after[2]) if after else ""
            pin = pins.get(match[0])
            wrong = [words for words in (label, behind) if pin and _is_other(words, pin, pins)]
            for words in wrong:
                said = f"{match[0]} is not the pin of '{' '.join(words.split())}'"
                yield Finding(place_at(file, text, match.start()), "link-doc", said)


def _pins(root: Path) -> dict[str, _Pin]:
    rows = ROW.findall(text_of(root / PINS))
    return {
        f"PT{port}{number}": _Pin(header, _words(f"{signal} {header} {text}"))
        for port, number, signal, header, text in rows
    }


def _is_other(text: str, pin: _Pin, pins: dict[str, _Pin]) -> bool:
    """Returns whether a text names a connector or a signal of another pin. If no pin has all words
    of the text, the text names no signal."""
    if CONNECTOR.fullmatch(text):
        return text != pin.connector
    words = _words(text)
    return bool(words) and not words <= pin.words and any(words <= p.words for p in pins.values())


def _words(text: str) -> set[str]:
    words = (word.lower().removesuffix("s") for word in re.findall(r"[A-Za-z]+", text))
    return {word for word in words if word not in OTHERS}
