"""The entries of the search, and the library that finds them."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path

from portal.navigation import Entry
from portal.search import synonyms
from portal.sections import terms_of

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


def test_words_that_mean_the_same_are_in_small_letters_and_in_one_line() -> None:
    words = [word for group in synonyms() for word in group]
    assert len(set(words)) == len(words)
    assert all(word == word.lower() for word in words)
    assert all(len(group) > 1 for group in synonyms())
