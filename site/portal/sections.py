"""The sections of the hand-written pages for the index of the search."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from docutils.nodes import make_id

from portal.navigation import Entry, is_underline

NAMED = re.compile(r"(?::[\w-]+:)?`([^`<]*?)\s*(?:<[^`]*>)?`_{0,2}")
# Directives, their options, labels, and the marks of tables and lists.
MARKS = re.compile(r"^\s*(?:\.\. .*|:[\w-]+:(?!`).*|[= ]+|\* - |- |\* )", re.MULTILINE)


# A term of a glossary, and its text.
TERM = re.compile(r"^   (\S.*)\n((?:\n? {6}.*\n)+)", re.MULTILINE)
TERM_MARKS = re.compile(r"[^A-Za-z0-9._]+")  # as Sphinx makes the anchor of a term


@dataclass
class Section:
    title: str
    address: str
    text: str


def sections_of(doc: Entry, source: str) -> Iterator[Section]:
    """Returns each section of a page. The text above the first section has the title of the
    page."""
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
    """The terms of a page that has a glossary."""
    for part in source.split(".. glossary::")[1:]:
        for title, text in TERM.findall(part):
            yield Section(title, f"{doc.address}#term-{TERM_MARKS.sub('-', title)}", plain(text))


def plain(source: str) -> str:
    """The words of a text, with little of its markup."""
    text = NAMED.sub(r"\1", MARKS.sub(" ", source))
    return re.sub(r"\s+", " ", text).strip()
