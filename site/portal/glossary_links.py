"""Links the first use of each term of the glossary on a page."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape
from pathlib import Path

from portal.links import ROOT
from portal.navigation import Entry
from portal.sections import Section, terms_of

GLOSSARY = Entry("docs/glossary", "Glossary", "docs/glossary.html")
PARTS = re.compile(r"<(/?)([a-zA-Z][\w-]*)([^>]*)>|<!--.*?-->|[^<]+", re.DOTALL)
OTHER_SENSES = {"function", "target"}  # words that texts use in a second sense as well
# Where a link would be in a link, in code, in a picture, or in a control.
APART = {
    *("a", "button", "code", "h1", "h2", "h3", "h4", "input", "kbd", "label", "option", "pre"),
    *("script", "select", "style", "summary", "svg", "th", "title"),
}


class GlossaryLinks:
    """The terms by their words in lower case; the plural of a term is the term too."""

    def __init__(self, root: Path) -> None:
        path = root / f"{GLOSSARY.id}.rst"
        source = path.read_text(encoding="utf-8") if path.exists() else ""
        terms = {term.title.lower(): term for term in terms_of(GLOSSARY, source)}
        self.terms = {words: term for words, term in terms.items() if words not in OTHER_SENSES}
        words = sorted(map(re.escape, self.terms), key=len, reverse=True)
        self.pattern = re.compile(rf"(?<![\w.:/@-])({'|'.join(words)})(s?)(?![\w-])", re.IGNORECASE)

    def link(self, html: str, prefix: str = ROOT) -> str:
        """The page with a link at the first use of each term in its text."""
        return "".join(self._linked(html, prefix)) if self.terms else html

    def _linked(self, html: str, prefix: str) -> Iterator[str]:
        left = set(self.terms)
        apart: list[str] = []
        for part in PARTS.finditer(html):
            end, tag, rest = part[1], part[2], part[3]
            if tag and tag.lower() in APART and not (rest or "").endswith("/"):
                apart = apart[:-1] if end else [*apart, tag]
            yield part[0] if tag or apart else self._text(part[0], left, prefix)

    def _text(self, text: str, left: set[str], prefix: str) -> str:
        def link(match: re.Match[str]) -> str:
            term = self.terms.get(match[1].lower())
            if term is None or term.title.lower() not in left:
                return match[0]
            left.discard(term.title.lower())
            return anchor(term, match[0], prefix)

        return self.pattern.sub(link, text)


def anchor(term: Section, words: str, prefix: str) -> str:
    gist = escape(term.text.split(". ")[0].rstrip("."))
    return f'<a class="term" href="{prefix}{term.address}" title="{gist}">{words}</a>'
