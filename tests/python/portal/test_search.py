"""The entries of the search, and the library that finds them."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

import pytest

from portal.navigation import Entry
from portal.page_words import parts_of
from portal.search import listed
from portal.sections import terms_of

pytestmark = pytest.mark.reads("site", "setup/vendored.txt", "tests/python")

ROOT = Path(__file__).parents[3]
VENDORED = re.compile(r"^([0-9a-f]{64})  (\S+)$", re.MULTILINE)


def test_a_vendored_file_is_the_published_one() -> None:
    listed = VENDORED.findall((ROOT / "setup" / "vendored.txt").read_text(encoding="utf-8"))
    assert listed
    for digest, path in listed:
        assert hashlib.sha256((ROOT / path).read_bytes()).hexdigest() == digest, path


def test_a_term_of_the_glossary_is_found() -> None:
    source = ".. glossary::\n\n   coast\n      Of a wheel: its driver is off\n      for now.\n"
    (term,) = terms_of(Entry("docs/glossary", "Glossary", "docs/glossary.html"), source)
    assert (term.title, term.address) == ("coast", "docs/glossary.html#term-coast")
    assert term.text == "Of a wheel: its driver is off for now."


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
