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
OPERATIONS: dict[type[ast.operator], Callable[[float, float], float]] = {
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
    names: list[str] = []

    def replaced(match: re.Match[str]) -> str:
        if match[0] in (*FUNCTIONS, PI):
            return match[0]
        names.append(match[0])
        return f"_{len(names) - 1}"

    text = NAME.sub(replaced, UNIT.sub("", formula))
    try:
        values = [float(constants[name].number) for name in names]
        return _value(ast.parse(text, mode="eval").body, values)
    except (KeyError, SyntaxError, TypeError, ValueError, ZeroDivisionError):
        return None


def _value(node: ast.expr, values: list[float]) -> float:
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return node.value
    if isinstance(node, ast.Name):
        return math.pi if node.id == PI else values[int(node.id[1:])]
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATIONS:
        left, right = _value(node.left, values), _value(node.right, values)
        return float(OPERATIONS[type(node.op)](left, right))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return FUNCTIONS[node.func.id](*(_value(part, values) for part in node.args))
    raise ValueError(f"this is not a formula: {ast.unparse(node)}")
