"""Finds the operands in the condition of a branch: called operations, members and comparisons."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from clang.cindex import Cursor, CursorKind

from traceability.reading.clang_names import FUNCTIONS, class_name, function_id
from traceability.reading.flow import COMPARISONS, JOINED, operator_of

NUMBERS = {CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL}
# function that returns whether a declaration belongs to the project
IsOwn = Callable[[Cursor | None], bool]


def questions(condition: Cursor, is_own: IsOwn) -> list[str]:
    """Returns the operands of a condition, such as ``Class::operation`` or ``Class::member >= 3``.
    If the condition is a local variable, returns the operands in the initialiser of this
    variable."""
    variable = _local(condition)
    if variable is not None:
        return questions(variable, is_own)
    parts = list(condition.get_children())
    words = [token.spelling for token in condition.get_tokens()]
    if len(parts) == 1 and condition.kind in (CursorKind.UNEXPOSED_EXPR, CursorKind.PAREN_EXPR):
        return questions(parts[0], is_own)
    if condition.kind == CursorKind.UNARY_OPERATOR and words[:1] in (["!"], ["not"]):
        return questions(parts[0], is_own)
    two = condition.kind == CursorKind.BINARY_OPERATOR and len(parts) > 1
    if two and operator_of(condition, parts[0]) in JOINED:
        return [*questions(parts[0], is_own), *questions(parts[1], is_own)]
    names = list(_names(condition, is_own))
    sign = next((word for word in words if word in COMPARISONS), "")
    return [f" {sign} ".join(names)] if sign and len(names) > 1 else names


def _local(cursor: Cursor) -> Cursor | None:
    """Returns the initialiser of a local variable if the expression names such a variable."""
    while cursor.kind in (CursorKind.UNEXPOSED_EXPR, CursorKind.PAREN_EXPR):
        inner = list(cursor.get_children())
        if len(inner) != 1:
            return None
        cursor = inner[0]
    target = cursor.referenced if cursor.kind == CursorKind.DECL_REF_EXPR else None
    if target is None or target.kind != CursorKind.VAR_DECL or class_name(target.semantic_parent):
        return None
    inside = target.semantic_parent is not None and target.semantic_parent.kind in FUNCTIONS
    values = [part for part in target.get_children() if part.kind.is_expression()]
    return values[-1] if values and inside else None


def _names(cursor: Cursor, is_own: IsOwn) -> Iterator[str]:
    """Yields the operands of an expression in the order of the source text. Arguments of calls are
    left out."""
    variable = _local(cursor)
    if variable is not None:
        yield from _names(variable, is_own)
        return
    target = cursor.referenced
    if cursor.kind == CursorKind.CALL_EXPR and is_own(target) and target is not None:
        if target.kind == CursorKind.CXX_METHOD and not target.spelling.startswith("operator"):
            yield function_id(target)
            return
    elif cursor.kind == CursorKind.MEMBER_REF_EXPR and target is not None:
        if target.kind == CursorKind.FIELD_DECL:
            yield f"{class_name(target.semantic_parent)}::{cursor.spelling}"
            return
    elif cursor.kind in NUMBERS:
        digits = next((token.spelling for token in cursor.get_tokens()), "").rstrip("uUlL")
        # The compiler can read a < b as (a <=> b) < 0. This 0 has no digits in the source text, and
        # is no operand.
        if digits[:1].isdigit():
            yield digits
        return
    for part in cursor.get_children():
        yield from _names(part, is_own)
