"""The texts that a requirement's links depend on, without what does not matter in them.

Each is found in the lines of its file, so that an earlier version of the file gives the earlier
text: git keeps what was reviewed.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator

COMMENT = re.compile(r"\s*///\s?")
TAG = re.compile(r"[@\\](?:satisfies|isr)\b")
TOKENS = re.compile(r"""\d[\w.']*|"(?:\\.|[^"\\])*"|\w+|[^\s\w]""")
LINE_COMMENT = re.compile(r"""("(?:\\.|[^"\\])*")|\s*//.*""")
HASH_DIGITS = 16


def hash_of_text(text: str) -> str:
    """Of the words and signs alone: how they are laid out does not matter."""
    words = " ".join(TOKENS.findall(text))
    return hashlib.sha256(words.encode()).hexdigest()[:HASH_DIGITS]


def texts_of_requirement(text: str, name: str) -> Iterator[str]:
    """All that is written below a requirement."""
    blocks = re.split(r"(?=[@\\]requirement\s)", text)
    for block in blocks:
        if re.match(rf"[@\\]requirement\s+{name}\s", block):
            yield _joined(block.split("*/")[0].split("/**")[0])


def _joined(block: str) -> str:
    """Each paragraph on a line."""
    paragraphs = re.split(r"\n\s*\n", block.strip())
    return "\n".join(" ".join(paragraph.split()) for paragraph in paragraphs if paragraph.strip())


def texts_of_method(text: str, name: str) -> Iterator[str]:
    """Comment and declaration of each method of this name that has a comment."""
    lines = text.splitlines()
    for number, line in enumerate(lines):
        if COMMENT.match(line) or not re.search(rf"(?<![\w.:>]){re.escape(name)}\(", line):
            continue
        if number and COMMENT.match(lines[number - 1]):
            yield specification_at(lines, number + 1)


def specification_at(lines: list[str], line: int) -> str:
    """Comment and declaration of the method at a line, without the tags of requirements."""
    first = line - 1
    while first > 0 and COMMENT.match(lines[first - 1]):
        first -= 1
    words = (COMMENT.sub("", text) for text in lines[first : line - 1])
    comment = [text.rstrip() for text in words if text.strip() and not TAG.match(text)]
    declaration = ""
    for text in lines[line - 1 :]:
        declaration += f"{text.strip()} "
        if re.search(r"[;{]", text):
            break
    return "\n".join([*comment, re.split(r"[;{]", declaration)[0].strip()])


def texts_of_test(text: str, name: str) -> Iterator[str]:
    """The body of the test ``Suite.Name``, without comments."""
    suite, _, case = name.partition(".")
    head = re.compile(rf"^TEST(?:_F|_P)?\(\s*{suite}\s*,\s*{case}\s*\)", re.MULTILINE)
    for match in head.finditer(text):
        body = text[match.start() :]
        end = re.search(r"^}|{}\s*$", body, re.MULTILINE)
        lines = body[: end.end() if end else len(body)].splitlines()
        kept = (LINE_COMMENT.sub(lambda found: found[1] or "", line) for line in lines)
        yield "\n".join(line for line in kept if line.strip())
