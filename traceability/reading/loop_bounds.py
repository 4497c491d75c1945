"""Reads the maximum number of iterations of each loop. The number is in a comment of the source
file, or in the head of the loop."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from traceability.sources import text_of

PASSES = re.compile(r"//\s*passes:\s*([^;]+?)\s*(?:;|$)")
COUNTS = re.compile(r"//\s*counts:\s*(\w+)\s*(?:;|$)")
DECLARED = re.compile(r"//\s*bound:\s*([^;]+?)(\s+in all)?\s*(?:;|$)")
HEAD = re.compile(r"for \(std::size_t (\w+) = \d+; \1 < ([\w:]+);")
OPERATIONS: dict[type, Callable[[int, int], int]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.floordiv,
}

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
            # If the bound contains an unknown name, the loop counts as a loop without a bound.
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
        """Returns the value of a constant expression."""
        return self._of(ast.parse(text.replace("::", "__"), mode="eval").body)

    def _before(self, place: Place) -> str:
        """Returns the line before a source line, without its indentation."""
        lines = self._lines(place[0])
        return lines[place[1] - 2].strip() if 1 < place[1] <= len(lines) else ""

    def _lines(self, file: str) -> list[str]:
        if file not in self.lines:
            self.lines[file] = text_of(self.root / file).splitlines()
        return self.lines[file]

    def _of(self, node: ast.expr) -> int:
        if isinstance(node, ast.Constant) and isinstance(node.value, int):
            return node.value
        if isinstance(node, ast.Name):
            return self.values[node.id.replace("__", "::")]
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATIONS:
            return OPERATIONS[type(node.op)](self._of(node.left), self._of(node.right))
        raise ValueError(f"the bound of this loop cannot be computed: {ast.unparse(node)}")
