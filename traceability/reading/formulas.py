"""Computes formulas of numbers and constants, such as ``2 * Times::kCycle [ms]``. The constants
have the units of the code, and the unit of the result is in square brackets."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping
from typing import Protocol

NAME = re.compile(r"SG-\d+\.\w+|[A-Za-z_]\w*(?:(?:::|\.)\w+)*")
UNIT = re.compile(r" \[([^\]]+)\]$")
Operations = Mapping[type[ast.operator], Callable[[float, float], float]]
OPERATIONS: Operations = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
# round(number, digits) has a fixed number of decimal places.
FUNCTIONS: dict[str, Callable[..., float]] = {"ceil": math.ceil, "round": round}
PI = "pi"


class Value(Protocol):
    """A constant with its value."""

    @property
    def number(self) -> float: ...


def value_of(formula: str, constants: Mapping[str, Value]) -> float | None:
    """Returns the value of a formula. Returns None if the formula contains an unknown name, or is
    not valid."""
    try:
        return float(evaluated(formula, lambda name: float(constants[name].number)))
    except (KeyError, SyntaxError, TypeError, ValueError, ZeroDivisionError):
        return None


def evaluated(
    formula: str, number_of: Callable[[str], float], operations: Operations = OPERATIONS
) -> float:
    """Returns the value of a formula. Raises KeyError, SyntaxError or ValueError if the formula has
    no value. ``number_of`` returns the value of a name."""
    names: list[str] = []

    def replaced(match: re.Match[str]) -> str:
        if match[0] in (*FUNCTIONS, PI):
            return match[0]
        names.append(match[0])
        return f"_{len(names) - 1}"

    text = NAME.sub(replaced, UNIT.sub("", formula))
    values = [number_of(name) for name in names]
    return _value(ast.parse(text, mode="eval").body, values, operations)


def _value(node: ast.expr, values: list[float], operations: Operations) -> float:
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return node.value
    if isinstance(node, ast.Name):
        return math.pi if node.id == PI else values[int(node.id[1:])]
    if isinstance(node, ast.BinOp) and type(node.op) in operations:
        left, right = (_value(side, values, operations) for side in (node.left, node.right))
        return operations[type(node.op)](left, right)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        parts = (_value(part, values, operations) for part in node.args)
        return FUNCTIONS[node.func.id](*parts)
    raise ValueError(f"this is not a formula: {ast.unparse(node)}")
