"""Reads the maximum number of iterations of each loop. The number is in a comment of the source
file, or in the head of the loop.

Also reads linear inequalities, such as ``edges <= entries``. They limit the numbers of executions
of the marked source lines."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from traceability.reading.formulas import OPERATIONS, evaluated
from traceability.sources import text_of

PASSES = re.compile(r"//\s*passes:\s*([^;]+?)\s*(?:;|$)")
COUNTS = re.compile(r"//\s*counts:\s*(\w+)\s*(?:;|$)")
DECLARED = re.compile(r"//\s*bound:\s*([^;]+?)(\s+in all)?\s*(?:;|$)")
HEAD = re.compile(r"for \(std::size_t (\w+) = \d+; \1 < ([\w:]+);")
OF_INTEGERS = {**OPERATIONS, ast.Div: operator.floordiv}

ENTRIES = "entries"  # this counter of an inequality is the number of calls of the method

Place = tuple[str, int]


@dataclass(frozen=True)
class Bound:
    """The maximum number of iterations of a loop. If ``in_all`` is true, ``rounds`` is the maximum
    for one call of the function. Otherwise, ``rounds`` is the maximum for each time that the
    program enters the loop."""

    rounds: int
    in_all: bool


class Bounds:
    """A reader of the bounds that the source files declare."""

    def __init__(self, root: Path, values: Mapping[str, int]) -> None:
        self.root, self.values = root, values
        self.lines: dict[str, list[str]] = {}

    def at(self, place: Place) -> Bound | None:
        """Returns the bound that is declared for the loop or the call on a source line. Returns
        None if there is no valid bound."""
        lines = self._lines(place[0])
        if not 0 < place[1] <= len(lines):
            return None
        text = lines[place[1] - 1]
        match = DECLARED.search(text) or DECLARED.match(self._before(place))
        head = HEAD.search(text)
        if not match and not head:
            return None
        try:
            rounds = self.value(match[1] if match else head[2] if head else "")
        except (KeyError, SyntaxError, ValueError):
            # If the bound contains an unknown name, the loop is regarded as a loop without a bound.
            return None
        return Bound(rounds, match is not None and match[2] is not None)

    def passes(self, place: Place) -> int | None:
        """Returns the declared maximum number of executions of a source line in one call of its
        function."""
        match = PASSES.match(self._before(place))
        return self.value(match[1]) if match else None

    def counter(self, place: Place) -> str | None:
        """Returns the name by which the flow facts refer to the number of executions of a source
        line."""
        match = COUNTS.match(self._before(place))
        return match[1] if match else None

    def value(self, text: str) -> int:
        """Returns the value of a constant expression. Raises ValueError if it is not an integer."""
        number = evaluated(text.replace("__", "::"), self.values.__getitem__, OF_INTEGERS)
        if not isinstance(number, int):
            raise ValueError(f"{text} is not an integer")
        return number

    def _before(self, place: Place) -> str:
        """Returns the line before a source line, without its indentation."""
        lines = self._lines(place[0])
        return lines[place[1] - 2].strip() if 1 < place[1] <= len(lines) else ""

    def _lines(self, file: str) -> list[str]:
        if file not in self.lines:
            self.lines[file] = text_of(self.root / file).splitlines()
        return self.lines[file]


@dataclass(frozen=True)
class Inequality:
    """An inequality in this form: the sum of the numbers of executions, each multiplied by its
    factor, is at most ``most``."""

    # counter or address of a block -> factor; negative if the counter is on the right side of the
    # inequality in the text
    factors: Mapping[int | str, int]
    most: int


def read_inequality(text: str, counters: Iterable[str], value: Callable[[str], int]) -> Inequality:
    """Reads an inequality between two sums. ``value`` is a function that returns the number of a
    constant expression."""
    left, sign, right = text.partition("<=")
    if not sign:
        raise ValueError(f"no inequality: {text}")
    names = frozenset((*counters, ENTRIES))
    factors: dict[int | str, int] = {}
    most = 0
    for side, direction in ((left, 1), (right, -1)):
        for term in _terms(ast.parse(side.strip().replace("::", "__"), mode="eval").body):
            name, factor = _split(term, names, value)
            if name is None:
                most -= direction * factor
            else:
                factors[name] = factors.get(name, 0) + direction * factor
    return Inequality(factors, most)


def _terms(node: ast.expr) -> list[ast.expr]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return [*_terms(node.left), *_terms(node.right)]
    return [node]


def _split(
    term: ast.expr, names: frozenset[str], value: Callable[[str], int]
) -> tuple[str | None, int]:
    """Returns the counter and the factor of a term. The counter is None for a constant number."""
    if isinstance(term, ast.Name) and term.id in names:
        return term.id, 1
    if isinstance(term, ast.BinOp) and isinstance(term.op, ast.Mult):
        counter = ast.unparse(term.right)
        if counter in names:
            return counter, value(ast.unparse(term.left))
    return None, value(ast.unparse(term))
