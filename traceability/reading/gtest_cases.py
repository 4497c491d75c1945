"""Reads the GoogleTest cases in a source file: suite, name, line and body of each test. In the
tests, also finds loops that never run."""

from __future__ import annotations

import operator
import re
from collections.abc import Iterator
from dataclasses import dataclass

from traceability.reading.comments import code_of

MACROS = ("TEST", "TEST_F", "TEST_P", "TYPED_TEST", "TYPED_TEST_P")
HEAD = re.compile(rf"^(?:{'|'.join(MACROS)})\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
# Macros that only list parameters or types. They define no test.
LISTS = (
    *("INSTANTIATE_TEST_SUITE_P", "INSTANTIATE_TYPED_TEST_SUITE_P", "TYPED_TEST_SUITE"),
    *("TYPED_TEST_SUITE_P", "REGISTER_TYPED_TEST_SUITE_P"),
)
MACRO = re.compile(r"^([A-Z][A-Z0-9_]*TEST[A-Z0-9_]*|TEST[A-Z0-9_]*)\(", re.MULTILINE)
END = re.compile(r"^}|{}\s*$", re.MULTILINE)
# "for (int i = FIRST; i < LAST; ++i)", also with other comparisons and steps
LOOP = re.compile(
    r"^ *for \([\w:<> ]+ (\w+) = ([^;\n]+); \1 (<=?|>=?) ([^;\n]+); "
    r"(?:(\+\+|--)\1|\1 ([+-]=) [^;\n]+)\)",
    re.MULTILINE,
)
CONSTANT = re.compile(r"\bconst(?:expr)? [\w:<> ]*?(k\w+)(?: = |\{)(\d+)U?L?\}?;")
COMPARED = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}


@dataclass(frozen=True)
class Case:
    suite: str
    name: str
    line: int
    body: str  # source text of the test, including the line with the macro

    @property
    def id(self) -> str:
        return f"{self.suite}.{self.name}"

    @property
    def code(self) -> str:
        """Returns the body without comments and empty lines."""
        return code_of(self.body)


def read_tests(text: str) -> Iterator[Case]:
    line, at = 1, 0
    for match in HEAD.finditer(text):
        line, at = line + text.count("\n", at, match.start()), match.start()
        end = END.search(text, at)
        yield Case(match[1], match[2], line, text[at : end.end() if end else len(text)])


def empty_loops(text: str) -> Iterator[tuple[int, str]]:
    """Yields the line number and the head of each loop that never runs, or that counts away from
    its limit. A loop is examined only if its limits are numbers, or constants that the file
    defines with a number."""
    for match in LOOP.finditer(text):
        _, first, relation, last, step, leap = match.groups()
        away = ((step or leap)[0] == "+") == relation.startswith(">")
        constants: dict[str, str] = dict(CONSTANT.findall(text, 0, match.start()))
        ends = [constants.get(end, end).rstrip("U") for end in (first, last)]
        numbers = [int(end) for end in ends if end.isdecimal()]
        if away or (len(numbers) == 2 and not COMPARED[relation](*numbers)):
            yield text.count("\n", 0, match.start()) + 1, match[0].strip()


def unknown_macros(text: str) -> Iterator[tuple[int, str]]:
    """Yields the line number and the name of each unknown macro. An unknown macro has a name like a
    test macro, but this reader does not support it."""
    for match in MACRO.finditer(text):
        if match[1] not in (*MACROS, *LISTS):
            yield text.count("\n", 0, match.start()) + 1, match[1]
