"""Splits the hand-written pages into sections for the search index."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from docutils.nodes import make_id

from portal.navigation import Entry, is_underline

NAMED = re.compile(r"(?::[\w-]+:)?`([^`<]*?)\s*(?:<[^`]*>)?`_{0,2}")
# Matches directives, their options, labels, and the markup of tables and lists.
MARKS = re.compile(r"^\s*(?:\.\. .*|:[\w-]+:(?!`).*|[= ]+|\* - |- |\* )", re.MULTILINE)


# Matches a term of a glossary and its explanation.
TERM = re.compile(r"^   (\S.*)\n((?:\n? {6}.*\n)+)", re.MULTILINE)
# Characters that Sphinx replaces by "-" in the anchor of a term.
TERM_MARKS = re.compile(r"[^A-Za-z0-9._]+")


@dataclass
class Section:
    title: str
    address: str
    text: str


def sections_of(doc: Entry, source: str) -> Iterator[Section]:
    """Yields each section of a page. The first heading is the title of the page; the text below
    this heading is also a section.
    """
    lines = [*source.splitlines(), ""]
    heads = [
        number
        for number, (above, line) in enumerate(pairwise(lines))
        if above.strip() and is_underline(line)
    ]
    for first, end in pairwise([*heads, len(lines)]):
        title = plain(lines[first])
        anchor = "" if first == heads[0] else f"#{make_id(title)}"
        text = plain("\n".join(lines[first + 2 : end]))
        yield Section(title, f"{doc.address}{anchor}", text)


def terms_of(doc: Entry, source: str) -> Iterator[Section]:
    """Yields the terms of a page that has a glossary."""
    for part in source.split(".. glossary::")[1:]:
        for title, text in TERM.findall(part):
            yield Section(title, f"{doc.address}#term-{TERM_MARKS.sub('-', title)}", plain(text))


def plain(source: str) -> str:
    """Returns a text without most of its reStructuredText markup, for the search."""
    text = NAMED.sub(r"\1", MARKS.sub(" ", source))
    return re.sub(r"\s+", " ", text).strip()
