"""Reads the terms of the glossary."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from portal.navigation import Entry
from traceability.reading.constant_texts import ROLE

NAMED = re.compile(r"(?::[\w-]+:)?`([^`<]*?)\s*(?:<[^`]*>)?`_{0,2}")
TAG = re.compile(r"<[^>]+>")


# Matches a term of a glossary and its explanation.
TERM = re.compile(r"^   (\S.*)\n((?:\n? {6}.*\n)+)", re.MULTILINE)
# Characters that Sphinx replaces by "-" in the anchor of a term.
TERM_MARKS = re.compile(r"[^A-Za-z0-9._]+")


@dataclass
class Term:
    title: str
    address: str
    text: str


def terms_of(doc: Entry, source: str, constants: Mapping[str, str]) -> Iterator[Term]:
    """Yields the terms of a page that has a glossary. ``constants`` contains the HTML of each
    constant."""
    for part in source.split(".. glossary::")[1:]:
        for title, text in TERM.findall(part):
            address = f"{doc.address}#term-{TERM_MARKS.sub('-', title)}"
            yield Term(title, address, plain(text, constants))


def plain(source: str, constants: Mapping[str, str]) -> str:
    """Returns a text without its reStructuredText markup and without line breaks."""

    def value(match: re.Match[str]) -> str:
        name = " ".join(match[1].split())
        return html.unescape(TAG.sub("", constants.get(name, name)))

    text = NAMED.sub(r"\1", ROLE.sub(value, source))
    return " ".join(text.replace("*", "").split())
