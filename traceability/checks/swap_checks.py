"""module-swapped: no part is initialised with another part of the same kind, such as a left part
with a right part."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.reading.comments import comment_blanked
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import place_at, texts_below
from traceability.schema import Finding
from traceability.sources import DESIGN

FOLDERS = (*DESIGN, "ports")
# Words that distinguish two parts of the same kind.
PAIRS = (
    ("left", "right"),
    ("front", "rear"),
    ("inner", "outer"),
    ("forward", "backward"),
    ("upper", "lower"),
    ("first", "second"),
    ("a", "b"),
    ("step", "direction"),
    ("velocity", "direction"),
)
OTHERS = {
    word: {other for pair in PAIRS if word in pair for other in pair if other != word}
    for word in itertools.chain(*PAIRS)
}
STATEMENT = re.compile(r"[^;]+")
_INNER = r"\((?:[^;(){}]|\([^;(){}]*\))*\)"  # the arguments of a call, which may contain a call
_VALUE = rf"([^,;(){{}}]*(?:{_INNER})?)"
MEMBER = re.compile(rf"\.(\w+) = {_VALUE}(?=[,}}])")  # a member of an aggregate
OBJECT = re.compile(rf"(?<![\w.>:])(\w+)[({{]{_VALUE}[,)}}]")  # a variable, or a member of a class
PATH = re.compile(r"(?:\w+(?:\.|->))*(\w+?)_?")
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+")


def check(_model: Model, facts: Facts) -> Iterator[Finding]:
    for file, text in texts_below(facts.root, FOLDERS, (".hpp", ".cpp")):
        code = comment_blanked(text)
        for at, name, value in _swapped(code):
            said = f"{name} is initialised with {value}"
            yield Finding(place_at(file, code, at), "module-swapped", said)


def _swapped(code: str) -> Iterator[tuple[int, str, str]]:
    """Yields the position, the name and the value of each initialiser that names another part."""
    for statement in STATEMENT.finditer(code):
        members = list(MEMBER.finditer(statement[0]))
        names = {member[1] for member in members}
        for match in members:
            named = PATH.fullmatch(match[2])
            other = named is not None and named[1] != match[1] and named[1] in names
            if other or _is_other(match[1], match[2]):
                yield statement.start() + match.start(), match[1], match[2]
        for match in OBJECT.finditer(statement[0]):
            if _is_other(match[1], match[2]):
                yield statement.start() + match.start(), match[1], match[2]


def _is_other(name: str, value: str) -> bool:
    """Returns whether a name and a value have a common word, and differ in the words of a pair."""
    of_name, of_value = _words(name), _words(value)
    other = any(OTHERS.get(word, set()) & of_value - of_name for word in of_name - of_value)
    return other and bool(of_name & of_value)


def _words(text: str) -> set[str]:
    return {word.lower() for word in WORD.findall(text)}
