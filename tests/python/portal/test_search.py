"""The entries of the search, and the library that finds them."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

import pytest

from portal.glossary_terms import terms_of
from portal.navigation import Entry
from portal.page_words import parts_of
from portal.search import listed

pytestmark = pytest.mark.reads("site", "setup/vendored.txt", "tests/python")

ROOT = Path(__file__).parents[3]
VENDORED = re.compile(r"^([0-9a-f]{64})  (\S+)$", re.MULTILINE)


def test_a_vendored_file_is_the_published_one() -> None:
    listed = VENDORED.findall((ROOT / "setup" / "vendored.txt").read_text(encoding="utf-8"))
    assert listed
    for digest, path in listed:
        assert hashlib.sha256((ROOT / path).read_bytes()).hexdigest() == digest, path


def test_a_term_of_the_glossary_is_found() -> None:
    text = "      Of a *wheel*: :constant:`kEdges` edges,\n      see `it`.\n"
    source = f".. glossary::\n\n   hall edge\n{text}"
    entry = Entry("docs/glossary", "Glossary", "docs/glossary.html")
    (term,) = terms_of(entry, source, {"kEdges": '<a href="a">60</a>'})
    assert (term.title, term.address) == ("hall edge", "docs/glossary.html#term-hall-edge")
    assert term.text == "Of a wheel: 60 edges, see it."


def test_words_that_mean_the_same_are_in_small_letters() -> None:
    words = [word for group in listed("synonyms.txt", ",") for word in group]
    assert all(word == word.lower() for word in words)
    assert all(len(set(group)) == len(group) > 1 for group in listed("synonyms.txt", ","))


def test_a_part_of_a_page_has_the_words_below_its_heading() -> None:
    body = (
        "<h1>Execution</h1><p class=lead>All contexts.</p><section id=stack><h2>Stack</h2><p>Bytes"
        "<br>used</p></section><section><p>more</p></section>"
    )
    assert [(p.anchor, p.title, p.text) for p in parts_of(body)] == [
        ("", "Execution", "All contexts. more"),
        ("stack", "Stack", "Bytes used"),
    ]


def test_a_hand_written_page_is_read_without_its_layout() -> None:
    page = (
        "<body><nav>All pages</nav><main id=main><section id=tour>"
        "<h1>Tour<a class=headerlink>#</a></h1><p><strong>No report.</strong> "
        "See <code><span class=pre>a::b</span></code>, (<a><span class=ref>the way</span></a>), "
        "<a>A</a><span class=dc>::</span><a>go</a>, <span>2 s</span>.</p>"
        "<section id=in-design><h2>2. In <code>design/</code><a class=headerlink>#</a></h2>"
        "<ul><li>save<wbr>Mode</li><li>two</li></ul></section></section></main>"
        "<footer>Legend</footer>"
    )
    assert [(part.title, part.text) for part in parts_of(page)] == [
        ("Tour", "No report. See a::b, (the way), A::go, 2 s."),
        ("2. In design/", "saveMode two"),
    ]


def test_a_mark_before_a_heading_is_no_part_of_the_title() -> None:
    heading = "<h2><span aria-hidden=true>R</span>Scores<span class=more>of all</span></h2>"
    body = f"<section id=r>{heading}</section>"
    assert [(part.title, part.text) for part in parts_of(body)] == [("Scores", "of all")]
