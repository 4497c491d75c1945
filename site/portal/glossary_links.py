"""Links the first use of each term of the glossary on a page."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from html import escape
from pathlib import Path

from portal.links import ROOT
from portal.navigation import Entry
from portal.sections import Section, terms_of

GLOSSARY = Entry("docs/glossary", "Glossary", "docs/glossary.html")
OTHER_SENSES = {"function", "target"}  # words that texts use in a second sense as well
# Where a link would be in a link, in code, in a picture, or in a control.
APART = (
    "a button code h1 h2 h3 h4 input kbd label option pre script select style summary svg th title"
)
ELEMENTS = re.compile(
    rf"<({APART.replace(' ', '|')})\b[^>]*(?<!/)>.*?</\1\s*>|<!--.*?-->", re.DOTALL
)
NO_START = re.compile(r"[\w.:/@-]")
END = re.compile(r"s?(?![\w-])", re.IGNORECASE)


class GlossaryLinks:
    """The terms by their words in lower case; the plural of a term belongs to the term."""

    def __init__(self, root: Path) -> None:
        path = root / f"{GLOSSARY.id}.rst"
        source = path.read_text(encoding="utf-8") if path.exists() else ""
        terms = {term.title.lower(): term for term in terms_of(GLOSSARY, source)}
        self.terms = {words: term for words, term in terms.items() if words not in OTHER_SENSES}
        self.longer = {
            words: [(one, one.find(words)) for one in terms if words in one and words != one]
            for words in self.terms
        }

    def link(self, html: str, prefix: str = ROOT) -> str:
        """The page with a link at the first use of each term in its text."""
        parts, done = [], 0
        for start, end, words in sorted(self._first_uses(html)):
            parts += [html[done:start], anchor(self.terms[words], html[start:end], prefix)]
            done = end
        return "".join([*parts, html[done:]])

    def _first_uses(self, html: str) -> Iterator[tuple[int, int, str]]:
        text = html.lower()
        apart = [(0, 0), *(element.span() for element in ELEMENTS.finditer(html))]
        for words in self.terms:
            at = text.find(words)
            while at >= 0:
                end = END.match(text, at + len(words))
                if end and self._stands_alone(text, at, words) and is_text(html, at, apart):
                    yield at, end.end(), words
                    break
                at = text.find(words, at + 1)

    def _stands_alone(self, text: str, at: int, words: str) -> bool:
        """Whether the words begin here and are not part of a longer term."""
        if at and NO_START.match(text, at - 1):
            return False
        return not any(text.startswith(one, at - offset) for one, offset in self.longer[words])


def is_text(html: str, at: int, apart: list[tuple[int, int]]) -> bool:
    """Whether a place is outside of tags, and of elements in which links are not allowed."""
    _, end = apart[bisect_right(apart, (at, len(html))) - 1]
    return at >= end and html.rfind("<", 0, at) <= html.rfind(">", 0, at)


def anchor(term: Section, words: str, prefix: str) -> str:
    gist = escape(term.text.split(". ")[0].rstrip("."))
    return f'<a class="term" href="{prefix}{term.address}" title="{gist}">{words}</a>'
