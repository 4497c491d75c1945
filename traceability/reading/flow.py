"""Finds the objects to which the references in the code can refer. The search follows a reference
through members, parameters and results.

In this module, a place is a location that can contain a reference. A string names each place:
``field Class::name``, ``param function 0``, ``var file:name``, ``result function``, ``this Class``,
``function name`` or ``constant Enum::name``. An expression without a name has the name ``value``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from clang.cindex import Cursor, CursorKind, LinkageKind, TypeKind

from traceability.reading.clang_names import FUNCTIONS, class_name, function_id, is_function
from traceability.schema import Place

PlaceOf = Callable[[Cursor], Place | None]

LOOPS = {CursorKind.FOR_STMT, CursorKind.WHILE_STMT, CursorKind.CXX_FOR_RANGE_STMT}
CHANCES = {CursorKind.IF_STMT, CursorKind.SWITCH_STMT, CursorKind.CONDITIONAL_OPERATOR, *LOOPS}
# A condition can begin with such a declaration, as in ``if (int x = f(); x > 0)``.
DECLARATIONS = {CursorKind.DECL_STMT, CursorKind.VAR_DECL}
# functions of the standard library that store their arguments
KEEPS = {"store", "exchange", "push_back", "operator="}
ASSIGNMENTS = {CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR}
COMPARISONS = ("==", "!=", "<=", ">=", "<", ">")
JOINED = ("&&", "||", "and", "or")
INDEXED = {CursorKind.ARRAY_SUBSCRIPT_EXPR, CursorKind.CALL_EXPR}
CASTS = {
    CursorKind.CXX_STATIC_CAST_EXPR,
    CursorKind.CXX_FUNCTIONAL_CAST_EXPR,
    CursorKind.CSTYLE_CAST_EXPR,
}
EXPRESSIONS_APART = {CursorKind.TYPE_REF, CursorKind.NAMESPACE_REF, CursorKind.LAMBDA_EXPR}


@dataclass
class FlowFact:
    """A flow of references. If a place in ``sources`` refers to an object, the place ``into`` can
    refer to the same object."""

    into: str
    sources: list[str]
    file: str


class FlowReader:
    """A reader that records the flows of references in one translation unit."""

    def __init__(self, place: PlaceOf) -> None:
        self.place = place
        self.flows: list[FlowFact] = []

    # ---- names of places ------------------------------------------------------

    def node(self, cursor: Cursor | None) -> str:
        """Returns the name of the place that a declaration defines. Returns "" for a declaration
        outside the project."""
        at = self.place(cursor) if cursor is not None else None
        parent = cursor.semantic_parent if cursor is not None else None
        if cursor is None or at is None or parent is None or cursor.spelling.startswith("__"):
            return ""
        number = parameter_number(cursor) if cursor.kind == CursorKind.PARM_DECL else None
        first = self.place(cursor.canonical) or at
        scope = f"{self.function(parent)} " if is_function(parent) else f"{first.file}:"
        names = {
            CursorKind.FIELD_DECL: f"field {class_name(parent)}::{cursor.spelling}",
            CursorKind.PARM_DECL: "" if number is None else f"param {scope}{number}",
            CursorKind.VAR_DECL: f"var {scope}{cursor.spelling}",
            CursorKind.FUNCTION_DECL: f"function {function_id(cursor)}",
            CursorKind.ENUM_CONSTANT_DECL: f"constant {class_name(parent)}::{cursor.spelling}",
        }
        return names.get(cursor.kind, "")

    def function(self, cursor: Cursor) -> str:
        """Returns the id of a function. The id contains the file if the function is local to a
        file."""
        name = function_id(cursor)
        if "::" in name or cursor.linkage == LinkageKind.EXTERNAL:
            return name
        at = self.place(cursor)
        return f"{at.file}:{name}" if at else name

    def sources(self, cursor: Cursor) -> list[str]:
        """Returns the variables, members and results of functions to which an expression can refer.
        For ``a.b().c``, this is only the member c."""
        return list(dict.fromkeys(self._sources(cursor)))

    def _sources(self, cursor: Cursor) -> Iterator[str]:
        kind = cursor.kind
        if kind in EXPRESSIONS_APART:
            return
        if kind == CursorKind.CXX_THIS_EXPR:
            yield f"this {class_name(cursor.type.get_pointee().get_declaration())}"
            return
        if kind in (CursorKind.MEMBER_REF_EXPR, CursorKind.DECL_REF_EXPR):
            name = self.node(cursor.referenced)
            if name:
                yield name
                return
        if kind == CursorKind.CALL_EXPR and self.is_own(cursor.referenced):
            target = cursor.referenced
            if target.kind != CursorKind.CONSTRUCTOR:
                yield f"result {self.function(target)}"
                return
            if not target.is_copy_constructor() and not target.is_move_constructor():
                # A constructor makes a new object. The place that stores the object also identifies
                # the object.
                return
        for child in cursor.get_children():
            yield from self._sources(child)

    def is_own(self, target: Cursor | None) -> bool:
        return target is not None and target.kind in FUNCTIONS and self.place(target) is not None

    # ---- flows ----------------------------------------------------------------

    def add(self, into: str, sources: list[str], place: Place) -> None:
        if into and sources:
            self.flows.append(FlowFact(into, sources, place.file))

    def given(self, member: Cursor, value: Cursor, place: Place) -> None:
        """Records the flow into a member that a constructor or a designated initialiser sets."""
        self.add(self.node(member.referenced), self.sources(value) or ["value"], place)

    def arguments(self, call: Cursor, target: Cursor, place: Place) -> list[list[str]]:
        """Records the flow from each argument of a call to its parameter. Returns the sources of
        each argument."""
        named = [self.sources(value) for value in call.get_arguments()]
        for number, sources in enumerate(named):
            self.add(f"param {self.function(target)} {number}", sources, place)
        return named

    def receiver(self, call: Cursor) -> list[str]:
        """Returns the places that refer to the object whose method is called. Returns an empty list
        if the caller calls a method of its own object."""
        callee = next(call.get_children(), None)
        if callee is None or callee.kind != CursorKind.MEMBER_REF_EXPR:
            return []
        base = next(callee.get_children(), None)
        return self.sources(base) if base is not None else []

    def note(self, cursor: Cursor, function: str, place: Place) -> None:
        """Records the flows of references in statements that are not calls of project functions:
        declarations, return statements, loops over ranges, and assignments."""
        kind = cursor.kind
        if kind == CursorKind.VAR_DECL:
            self.variable(cursor, place)
        elif kind == CursorKind.RETURN_STMT and function:
            self.add(f"result {function}", self.sources(cursor), place)
        elif kind == CursorKind.CXX_FOR_RANGE_STMT:
            children = list(cursor.get_children())
            if len(children) > 1:
                self.add(self.node(children[0]), self.sources(children[1]), place)
        elif kind == CursorKind.BINARY_OPERATOR:
            sides = list(cursor.get_children())
            if len(sides) == 2 and assigns(cursor, sides[0]):
                self.kept(sides, place)
        elif kind == CursorKind.CALL_EXPR and cursor.spelling in KEEPS:
            self.keep_in_library(cursor, place)

    def variable(self, cursor: Cursor, place: Place) -> None:
        name = self.node(cursor)
        sources = [source for child in cursor.get_children() for source in self.sources(child)]
        declared = cursor.type.get_declaration()
        if declared is not None and self.place(declared) is not None and class_name(declared):
            sources.append(f"object {name} {class_name(declared)}")
        self.add(name, sources, place)

    def kept(self, sides: list[Cursor], place: Place) -> None:
        """Records the flow of an assignment. After ``a[i] = b``, both ``a`` and ``i`` are regarded
        as references to ``b``."""
        sources = self.sources(sides[1])
        for name in self.sources(sides[0]) if sources else []:
            self.add(name, sources, place)

    def keep_in_library(self, call: Cursor, place: Place) -> None:
        if self.is_own(call.referenced):
            return
        values = list(call.get_arguments())
        into = self.receiver(call)
        # In the call of an operator, the first argument is the object that the operator changes.
        if not into and len(values) > 1:
            into, values = self.sources(values[0]), values[1:]
        for name in into:
            for value in values:
                self.add(name, self.sources(value), place)

    # ---- members that a body uses -------------------------------------------

    def written(self, cursor: Cursor) -> list[str]:
        """Returns the data members that a statement changes."""
        kind = cursor.kind
        if kind in ASSIGNMENTS:
            left = next(cursor.get_children(), None)
            if left is None or (kind == CursorKind.BINARY_OPERATOR and not assigns(cursor, left)):
                return []
            return self.members(left)
        if kind == CursorKind.UNARY_OPERATOR:
            words = [token.spelling for token in cursor.get_tokens()]
            counts = words[:1] in (["++"], ["--"]) or words[-1:] in (["++"], ["--"])
            return self.members(cursor) if counts else []
        if kind == CursorKind.CALL_EXPR and cursor.referenced is not None:
            return self.changed_by(cursor)
        if kind == CursorKind.VAR_DECL and cursor.type.kind == TypeKind.LVALUEREFERENCE:
            return self.referred(cursor)
        return []

    def referred(self, variable: Cursor) -> list[str]:
        """Returns the data members that code can change by means of a non-const local reference."""
        value = next(reversed(list(variable.get_children())), None)
        constant = variable.type.get_pointee().is_const_qualified()
        return [] if constant or value is None else self.members(value)

    def changed_by(self, call: Cursor) -> list[str]:
        """Returns the data members that a call can change. A call of a non-const method can change
        the object of the call."""
        target = call.referenced
        if target.kind not in (CursorKind.CXX_METHOD, CursorKind.FUNCTION_TEMPLATE):
            return []
        if target.is_const_method() or target.is_static_method():
            return []
        first = next(call.get_children(), None)
        if first is not None and first.kind == CursorKind.MEMBER_REF_EXPR and first.referenced:
            first = first if is_field(first) else next(first.get_children(), None)
        return self.members(first) if first is not None else []

    def members(self, cursor: Cursor) -> list[str]:
        """Returns the data members (``Class::name``) whose memory contains the object that an
        expression names. Members behind a pointer or a reference are left out."""
        members: list[str] = []
        at: Cursor | None = cursor
        while at is not None:
            target = at.referenced
            if at.kind == CursorKind.MEMBER_REF_EXPR and target is not None:
                if target.kind == CursorKind.FIELD_DECL and self.place(target) is not None:
                    if any(mark in target.type.spelling for mark in ("&", "*", "_wrapper")):
                        return members
                    members.append(f"{class_name(target.semantic_parent)}::{target.spelling}")
            elif at.kind == CursorKind.CALL_EXPR and self.is_own(target):
                return members
            at = next(at.get_children(), None)
        return members


def branches_on(cursor: Cursor) -> Iterator[Cursor]:
    """Yields the types on which a decision in the statement depends. A type is a class if the
    statement compares addresses of its objects. A type is an enumeration if the number of one of
    its enumerators is compared, is an index, or is the condition of a switch."""
    children = list(cursor.get_children())
    if cursor.kind == CursorKind.BINARY_OPERATOR and len(children) == 2:
        if operator_of(cursor, children[0]) in COMPARISONS:
            kinds = [side.type.get_canonical() for side in children]
            if all(kind.kind == TypeKind.POINTER for kind in kinds):
                yield from (kind.get_pointee().get_declaration() for kind in kinds)
            yield from (made for side in children for made in numbered(side))
    elif cursor.kind == CursorKind.SWITCH_STMT and children:
        yield from numbered(children[0])
    elif cursor.kind in INDEXED and cursor.spelling in ("", "operator[]") and children:
        yield from numbered(children[-1])


def numbered(cursor: Cursor) -> Iterator[Cursor]:
    """Yields the enumerations whose values an expression converts to numbers."""
    for part in cursor.walk_preorder():
        if part.kind in CASTS or part.spelling == "to_underlying":
            given = list(part.get_children())[-1:]
            kinds = [value.type.get_canonical() for value in given]
            yield from (kind.get_declaration() for kind in kinds if kind.kind == TypeKind.ENUM)


def sure_parts(cursor: Cursor) -> int:
    """Returns a number N: the first N parts of a statement are always executed. The other parts
    depend on a condition."""
    children = list(cursor.get_children())
    if cursor.kind in CHANCES:
        return 1 + bool(children and children[0].kind in DECLARATIONS)
    if cursor.kind == CursorKind.BINARY_OPERATOR and cursor.type.kind == TypeKind.BOOL:
        return 1 if operator_of(cursor, children[0]) in JOINED else 2
    return len(children)


def operator_of(cursor: Cursor, left: Cursor) -> str:
    end = left.extent.end.offset
    for token in cursor.get_tokens():
        if token.extent.start.offset >= end:
            return str(token.spelling)
    return ""


def is_field(cursor: Cursor) -> bool:
    """Returns whether an expression names a data member."""
    named = cursor.referenced if cursor.kind == CursorKind.MEMBER_REF_EXPR else None
    return named is not None and bool(named.kind == CursorKind.FIELD_DECL)


def method_in_template(call: Cursor) -> Cursor | None:
    """Returns the called method of a class template. The call is inside another template."""
    callee = next(call.get_children(), None) if call.kind == CursorKind.CALL_EXPR else None
    if callee is None or callee.kind != CursorKind.MEMBER_REF_EXPR:
        return None
    base = next(callee.get_children(), None)
    name = [token.spelling for token in callee.get_tokens()][-1:]
    declared = base.type.get_declaration() if base is not None else None
    if declared is None or declared.kind != CursorKind.CLASS_TEMPLATE:
        return None
    return next((child for child in declared.get_children() if [child.spelling] == name), None)


def assigns(cursor: Cursor, left: Cursor) -> bool:
    return operator_of(cursor, left) == "="


def parameter_number(cursor: Cursor) -> int | None:
    parent = cursor.semantic_parent
    if parent is None or not is_function(parent):
        return None
    parameters = [child for child in parent.get_children() if child.kind == CursorKind.PARM_DECL]
    names = [child.location.offset for child in parameters]
    return names.index(cursor.location.offset) if cursor.location.offset in names else None
