"""Links the first use of each glossary term on a page to the glossary."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping
from html import escape
from pathlib import Path

from portal.glossary_terms import Term, terms_of
from portal.links import ROOT
from portal.navigation import Entry
from traceability.sources import text_of

GLOSSARY = Entry("docs/glossary", "Glossary", "docs/glossary.html")
# Terms without links, because the pages also use these words with another meaning.
OTHER_SENSES = {"function", "target", "verdict"}
# Terms that are linked only in these words, because the pages also use the terms with another
# meaning. These words and OTHER_WORDS are compared with the HTML text.
OWN_SENSE = {
    "brake": (
        *("wheel brakes", "wheels brake", "wheels then brake", "brakes the wheel"),
        *("motor brakes", "motors brake", "brakes the motor"),
    ),
    "hold": ("hold the steering", "holds the steering", "order to hold", "a hold"),
    "message": (
        *("message arrives", "message can be read", "as a message"),
        *("has a message", "reads a message", "read the message", "without a message"),
        *("no message", "last message"),
    ),
    "stop": ("a stop", "the stop", "this stop", "each stop", "no stop", "stop order"),
}
# Words that contain a term but have another meaning.
OTHER_WORDS = (
    *("stop bit", "after a stop that is longer", "halts the core"),
    *("product of voltage", ">product in "),
    *("order in which", "reason in the order", "in this order"),
    *("random order", "same order", "other order", "order and the number"),
    *("order of the tree", "order of the modes", "order of the decorators"),
    *("order of the interrupts", "order of the calls"),
    *("order of calls", "have no message"),
    *("code host", "secret key", "findings of a code review", "neutral value", "neutral range"),
)
# HTML elements in which no term is linked, such as links, headings, code, pictures and controls.
APART = (
    "a button code h1 h2 h3 h4 input kbd label option pre script select style summary svg th title"
)
ELEMENTS = re.compile(
    rf"<({APART.replace(' ', '|')})\b[^>]*(?<!/)>.*?</\1\s*>|<!--.*?-->", re.DOTALL
)
NO_START = re.compile(r"[\w.:/@-]")
NAME = re.compile(r"(?:&amp;|&gt;|</span>) $")  # matches the text in front of a parameter name
END = re.compile(r"s?(?![\w(-]|::)", re.IGNORECASE)


class GlossaryLinks:
    """The glossary terms in lower case. The plural of a term is also linked to the term. The link
    shows the first sentence of the explanation. ``constants`` contains the numbers in this
    sentence."""

    def __init__(self, root: Path, constants: Mapping[str, str]) -> None:
        source = text_of(root / f"{GLOSSARY.id}.rst")
        terms = {term.title.lower(): term for term in terms_of(GLOSSARY, source, constants)}
        self.terms = {words: term for words, term in terms.items() if words not in OTHER_SENSES}
        self.longer = {words: phrases_of(words, (*terms, *OTHER_WORDS)) for words in self.terms}
        self.own = {words: phrases_of(words, OWN_SENSE[words]) for words in OWN_SENSE}

    def link(self, html: str, prefix: str = ROOT) -> str:
        """Returns the page with a link at the first use of each term in its text."""
        parts, done = [], 0
        for start, end, words in sorted(self._first_uses(html)):
            parts += [html[done:start], anchor(self.terms[words], html[start:end], prefix)]
            done = end
        return "".join([*parts, html[done:]])

    def _first_uses(self, html: str) -> Iterator[tuple[int, int, str]]:
        text, starts, shifts = without_apart(html)
        for words in self.terms:
            at = text.find(words)
            while at >= 0:
                end = END.match(text, at + len(words))
                if end and self._means_term(text, at, words) and is_text(text, at):
                    shift = shifts[bisect_right(starts, at) - 1]
                    yield at + shift, end.end() + shift, words
                    break
                at = text.find(words, at + 1)

    def _means_term(self, text: str, at: int, words: str) -> bool:
        """Returns true if ``words`` begins at the start of a word of the text, is not a part of a
        longer term, and has the meaning of the term."""
        if (at and NO_START.match(text, at - 1)) or NAME.search(text[max(0, at - 8) : at]):
            return False
        own = self.own.get(words)
        return not is_in(text, at, self.longer[words]) and (own is None or is_in(text, at, own))


def phrases_of(words: str, phrases: Iterable[str]) -> list[tuple[str, int]]:
    """Returns the phrases that contain ``words``. Each phrase has the position of ``words`` in the
    phrase."""
    return [(one, one.find(words)) for one in phrases if words in one and words != one]


def is_in(text: str, at: int, phrases: list[tuple[str, int]]) -> bool:
    """Returns true if the words at a position in the text are a part of one of the phrases."""
    return any(text.startswith(phrase, at - offset) for phrase, offset in phrases)


def without_apart(html: str) -> tuple[str, list[int], list[int]]:
    """Returns the text of the page in lower case, without the elements in which no term is linked.
    A line break counts as a space. The removed elements divide the text into parts.

    Also returns two lists with a number for each part: the position of the part in the text, and an
    offset. The sum of this position and the offset is the position of the part on the page."""
    parts, starts, shifts, done, length = [], [], [], 0, 0
    for begin, end in [*(match.span() for match in ELEMENTS.finditer(html)), (len(html), 0)]:
        parts.append(html[done:begin])
        starts.append(length)
        shifts.append(done - length)
        length += begin - done + 1
        done = end
    return "\0".join(parts).lower().replace("\n", " "), starts, shifts


def is_text(text: str, at: int) -> bool:
    """Returns true if a position in the text is outside of HTML tags."""
    return text.rfind("<", 0, at) <= text.rfind(">", 0, at)


def anchor(term: Term, words: str, prefix: str) -> str:
    gist = escape(term.text.split(". ")[0].rstrip("."))
    return f'<a class="term" href="{prefix}{term.address}" title="{gist}">{words}</a>'
