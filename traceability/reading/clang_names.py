"""The names of the elements of a syntax tree, in the form that the model uses."""

from __future__ import annotations

import ctypes
import functools
import re
from typing import Any

from clang import cindex
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


@functools.cache
def library() -> Any:
    """Returns libclang. Declares the types of those functions that its Python module does not
    declare."""
    cursors = ctypes.POINTER(Cursor)
    types: dict[str, tuple[Any, ...]] = {  # name of a function -> its result and its arguments
        "clang_Cursor_getCommentRange": (cindex.SourceRange, Cursor),
        "clang_Cursor_isDynamicCall": (ctypes.c_int, Cursor),
        "clang_getOverriddenCursors": (
            *(None, Cursor, ctypes.POINTER(cursors), ctypes.POINTER(ctypes.c_uint)),
        ),
        "clang_disposeOverriddenCursors": (None, cursors),
        "clang_Cursor_Evaluate": (ctypes.c_void_p, Cursor),
        "clang_EvalResult_getKind": (ctypes.c_int, ctypes.c_void_p),
        "clang_EvalResult_getAsLongLong": (ctypes.c_longlong, ctypes.c_void_p),
        "clang_EvalResult_getAsDouble": (ctypes.c_double, ctypes.c_void_p),
        "clang_EvalResult_dispose": (None, ctypes.c_void_p),
    }
    for name, (result, *arguments) in types.items():
        function = getattr(cindex.conf.lib, name)
        function.restype, function.argtypes = result, arguments
    return cindex.conf.lib


def is_function(cursor: Cursor) -> bool:
    return cursor.kind in FUNCTIONS


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
    name: str = cursor.spelling
    if cursor.kind == CursorKind.CONSTRUCTOR:
        name = name.partition("<")[0]
    return f"{owner}::{name}" if owner else name
