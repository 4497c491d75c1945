"""The tests of a file: the macro of each, its line and its body."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from traceability.reading.comments import code_of

HEAD = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
END = re.compile(r"^}|{}\s*$", re.MULTILINE)


@dataclass(frozen=True)
class Case:
    suite: str
    name: str
    line: int
    body: str  # with its macro

    @property
    def id(self) -> str:
        return f"{self.suite}.{self.name}"

    @property
    def code(self) -> str:
        """The body without comments and empty lines."""
        return code_of(self.body)


def read_tests(text: str) -> Iterator[Case]:
    line, at = 1, 0
    for match in HEAD.finditer(text):
        line, at = line + text.count("\n", at, match.start()), match.start()
        end = END.search(text, at)
        yield Case(match[1], match[2], line, text[at : end.end() if end else len(text)])
