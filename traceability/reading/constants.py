"""Reads the values of constants from the syntax tree. A constant can be a variable, an enumerator,
or an operation that only returns a constant."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from clang.cindex import Cursor, CursorKind, SourceLocation, SourceRange, TokenKind, TypeKind

from traceability.reading.clang_names import class_name, library

UNIT = re.compile(r"\[([^\]]+)\]")
RANGE = " to "  # If square brackets contain this text, they state a range and not a unit.
UNSIGNED = {TypeKind.UCHAR, TypeKind.USHORT, TypeKind.UINT, TypeKind.ULONG, TypeKind.ULONGLONG}
INTEGER, FLOATING = 1, 2  # numbers by which libclang reports the kind of a result
DIGITS_OF_FLOAT = 7  # significant decimal digits of the type float


def constant_names(cursor: Cursor, file: str) -> list[str]:
    """Returns the names by which a text can refer to a constant. A constant of a class has the name
    ``Class::name``. Any other constant has the names ``name`` and ``File::name``."""
    owner = class_name(cursor.semantic_parent)
    if owner:
        return [f"{owner}::{cursor.spelling}"]
    return [cursor.spelling, f"{Path(file).stem}::{cursor.spelling}"]


def constants_of(cursor: Cursor) -> Iterator[tuple[str, float, str]]:
    """Yields the constants that a declaration defines. Each result consists of a suffix of the
    name, the value, and the unit. The suffix is ``.member`` for a member of a constant object, and
    otherwise empty."""
    if cursor.kind == CursorKind.ENUM_CONSTANT_DECL:
        bits = 8 * cursor.semantic_parent.enum_type.get_size()
        unsigned = cursor.semantic_parent.enum_type.get_canonical().kind in UNSIGNED
        yield "", cursor.enum_value % (1 << bits) if unsigned else cursor.enum_value, ""
        return
    value = value_of(cursor)
    if value is None:
        return
    parsed = number_of(value)
    if parsed is not None:
        number, unit = parsed
        yield "", number, unit or unit_in(cursor.raw_comment) or unit_on_line(cursor)
        return
    for member, part in members_of(value):
        parsed = number_of(part)
        if parsed is not None:
            number, unit = parsed
            unit = unit or unit_on_line(cursor) or unit_in(member.referenced.raw_comment)
            yield f".{member.spelling}", number, unit


def value_of(cursor: Cursor) -> Cursor | None:
    """Returns the expression that defines a constant. For an operation with a single `return`
    statement, returns the expression of this statement."""
    if cursor.kind == CursorKind.VAR_DECL:
        return last_expression(cursor) if cursor.type.is_const_qualified() else None
    body = next((c for c in cursor.get_children() if c.kind == CursorKind.COMPOUND_STMT), None)
    statements = list(body.get_children()) if body is not None else []
    if len(statements) != 1 or statements[0].kind != CursorKind.RETURN_STMT:
        return None
    return last_expression(statements[0])


def last_expression(cursor: Cursor) -> Cursor | None:
    expressions = [child for child in cursor.get_children() if child.kind.is_expression()]
    return expressions[-1] if expressions else None


def number_of(value: Cursor) -> tuple[float, str] | None:
    """Returns the value of an expression and its unit. The unit is that of the type, or that of the
    factory function that the expression calls. If neither of them has a unit, the unit is empty."""
    if value.type.get_canonical().kind != TypeKind.RECORD:
        number = evaluated_number(value)
        return None if number is None else (number, "")
    parts = [child for child in value.get_children() if child.kind.is_expression()]
    function = value.referenced if value.kind == CursorKind.CALL_EXPR else None
    if function is not None and function.kind == CursorKind.FUNCTION_DECL:
        made = unit_in(function.raw_comment)  # the unit of the parameter of a factory function
        if made and parts:
            number = evaluated_number(parts[-1])
            return None if number is None else (number, made)
    unit = unit_in(value.type.get_declaration().raw_comment)
    parsed = number_of(parts[0]) if len(parts) == 1 else None
    return (parsed[0], parsed[1] or unit) if parsed is not None else None


def members_of(value: Cursor) -> Iterator[tuple[Cursor, Cursor]]:
    """Yields the members that a designated initialiser sets, such as ``{.low = 1}``."""
    while value.kind == CursorKind.UNEXPOSED_EXPR and len(list(value.get_children())) == 1:
        value = next(value.get_children())
    for part in value.get_children() if value.kind == CursorKind.INIT_LIST_EXPR else ():
        inner = list(part.get_children())
        if len(inner) == 2 and inner[0].kind == CursorKind.MEMBER_REF:
            yield inner[0], inner[1]


def unit_on_line(cursor: Cursor) -> str:
    """Returns the unit that a comment at the end of the source line states for a constant."""
    unit, file, line = cursor.translation_unit, cursor.location.file, cursor.extent.end.line
    start = SourceLocation.from_position(unit, file, line, 1)
    end = SourceLocation.from_position(unit, file, line + 1, 1)
    tokens = unit.get_tokens(extent=SourceRange.from_locations(start, end))
    texts = [
        token.spelling
        for token in tokens
        if token.kind == TokenKind.COMMENT and token.location.line == line
    ]
    return unit_in(texts[0] if texts else None)


def unit_in(comment: str | None) -> str:
    match = UNIT.search(comment or "")
    return match[1] if match and RANGE not in match[1] else ""


def evaluated(expression: Cursor) -> int | None:
    """Returns the value of an integer expression. Returns None if the compiler cannot compute
    it."""
    number = evaluated_number(expression)
    return number if isinstance(number, int) else None


def evaluated_number(expression: Cursor) -> float | None:
    """Returns the value of an expression: an int for an integer type, a float for the types float
    and double. Returns None if the compiler cannot compute it."""
    clang = library()
    result = clang.clang_Cursor_Evaluate(expression)
    if not result:
        return None
    try:
        kind = clang.clang_EvalResult_getKind(result)
        if kind == INTEGER:
            return int(clang.clang_EvalResult_getAsLongLong(result))
        if kind != FLOATING:
            return None
        number = float(clang.clang_EvalResult_getAsDouble(result))
        single = expression.type.get_canonical().kind == TypeKind.FLOAT
        return float(f"{number:.{DIGITS_OF_FLOAT}g}") if single else number
    finally:
        clang.clang_EvalResult_dispose(result)
