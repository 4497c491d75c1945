"""Linear inequalities, such as ``edges <= entries``. They limit the numbers of executions of the
marked source lines."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

ENTRIES = "entries"  # this counter is the number of calls of the method


@dataclass(frozen=True)
class Inequality:
    """An inequality in this form: the sum of the counters, each multiplied by its factor, is at
    most ``most``."""

    # counter -> factor; negative if the counter is on the right side of the inequality in the text
    factors: Mapping[str, int]
    most: int


def read_inequality(text: str, counters: Iterable[str], value: Callable[[str], int]) -> Inequality:
    """Reads an inequality between two sums. ``value`` is a function that returns the number of a
    constant expression."""
    left, sign, right = text.partition("<=")
    if not sign:
        raise ValueError(f"no inequality: {text}")
    names = frozenset((*counters, ENTRIES))
    factors: dict[str, int] = {}
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
