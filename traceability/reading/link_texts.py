"""The texts that a requirement's links depend on, without what does not matter in them.

Each is found in the text of its file, so that an earlier version of the file gives the earlier
text: git keeps what was reviewed.
"""

from __future__ import annotations

import functools
import hashlib
import re
from collections.abc import Iterator

from traceability.reading.comments import read_comments
from traceability.reading.gtest_cases import read_tests

OF_LINKS = ("satisfies", "isr")  # no part of a specification
TOKENS = re.compile(r"""\d[\w.']*|"(?:\\.|[^"\\])*"|\w+|[^\s\w]""")
HASH_DIGITS = 16


def hash_of_text(text: str) -> str:
    """Of the words and signs alone: how they are laid out does not matter."""
    words = " ".join(TOKENS.findall(text))
    return hashlib.sha256(words.encode()).hexdigest()[:HASH_DIGITS]


@functools.cache
def requirements(text: str) -> list[tuple[str, str]]:
    """The id of each requirement, and all that is written below it."""
    return [
        (part.tags[0].argument, part.source())
        for comment in read_comments("", text)
        for part in comment.parts("requirement")
    ]


@functools.cache
def specifications(text: str) -> list[tuple[range, str, str]]:
    """The lines of each declaration with a comment, the declaration, and both as a text."""
    return list(_specifications(text))


@functools.cache
def tests(text: str) -> list[tuple[str, str]]:
    """The id of each test, and its body without comments."""
    return [(case.id, case.code) for case in read_tests(text)]


def _specifications(text: str) -> Iterator[tuple[range, str, str]]:
    lines = text.splitlines()
    for comment in read_comments("", text):
        first = comment.place.end or 0
        last = next((n for n in range(first, len(lines)) if re.search(r"[;{]", lines[n])), first)
        declaration = " ".join(line.strip() for line in lines[first : last + 1])
        declaration = re.split(r"[;{]", declaration)[0].strip()
        whole = "\n".join(filter(None, (comment.source(without=OF_LINKS), declaration)))
        yield range(first + 1, last + 2), declaration, whole


def texts_of_requirement(text: str, name: str) -> Iterator[str]:
    """All that is written below a requirement."""
    return (source for known, source in requirements(text) if known == name)


def texts_of_method(text: str, name: str) -> Iterator[str]:
    """Comment and declaration of each method of this name that has a comment."""
    named = re.compile(rf"(?<![\w.:>]){re.escape(name)}\(")
    return (whole for _, declaration, whole in specifications(text) if named.search(declaration))


def texts_of_test(text: str, name: str) -> Iterator[str]:
    """The body of the test ``Suite.Name``, without comments."""
    return (code for known, code in tests(text) if known == name)
