"""The names of the elements of a syntax tree, in the form that the model uses."""

from __future__ import annotations

import re

from clang.cindex import Cursor, CursorKind

NAMESPACE = "wr"
# In Clang, the name of a lambda contains the path of the source file. The folders are removed from
# the path, because they differ between computers.
FOLDERS_OF_LAMBDA = re.compile(r"(?<=\(lambda at )\S*/")
CLASSES = {
    CursorKind.CLASS_DECL,
    CursorKind.STRUCT_DECL,
    CursorKind.UNION_DECL,
    CursorKind.CLASS_TEMPLATE,
}
METHODS = {
    CursorKind.CXX_METHOD,
    CursorKind.CONSTRUCTOR,
    CursorKind.DESTRUCTOR,
    CursorKind.CONVERSION_FUNCTION,
}
FUNCTIONS = METHODS | {CursorKind.FUNCTION_DECL, CursorKind.FUNCTION_TEMPLATE}


def is_function(cursor: Cursor) -> bool:
    if cursor.kind in (CursorKind.FUNCTION_DECL, *METHODS):
        return True
    return bool(cursor.kind == CursorKind.FUNCTION_TEMPLATE)


def class_name(cursor: Cursor | None) -> str:
    """Returns the name of a class as ``Outer::Inner``, without the namespace. Returns "" if the
    node of the syntax tree is not a class."""
    parts: list[str] = []
    kinds = {*CLASSES, CursorKind.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION, CursorKind.ENUM_DECL}
    kinds |= {CursorKind.TYPE_ALIAS_DECL}
    while cursor is not None and cursor.kind in kinds:
        parts.insert(0, FOLDERS_OF_LAMBDA.sub("", cursor.spelling))
        cursor = cursor.semantic_parent
    return "::".join(parts)


def namespace_of(cursor: Cursor | None) -> str:
    """Returns the namespaces that enclose a node of the syntax tree. The namespace of the project
    is left out."""
    parts: list[str] = []
    while cursor is not None and cursor.kind != CursorKind.TRANSLATION_UNIT:
        if cursor.kind == CursorKind.NAMESPACE and not cursor.is_anonymous():
            parts.insert(0, cursor.spelling)
        cursor = cursor.semantic_parent
    return "::".join(parts[1:] if parts[:1] == [NAMESPACE] else parts)


def qualified_name(cursor: Cursor) -> str:
    return "::".join(filter(None, (NAMESPACE, namespace_of(cursor), class_name(cursor))))


def function_id(cursor: Cursor) -> str:
    owner = class_name(cursor.semantic_parent)
    name: str = (
        cursor.spelling.split("<")[0]
        if cursor.kind == CursorKind.CONSTRUCTOR
        else (cursor.spelling)
    )
    return f"{owner}::{name}" if owner else name
