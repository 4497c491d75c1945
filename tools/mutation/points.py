"""Finds the places for faults in the sources, with libclang. Each mutant is one small change of a
method."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from clang import cindex
from clang.cindex import Cursor, CursorKind, TypeKind

from traceability.reading.clang_names import function_id, is_function
from traceability.reading.translation_units import clang_arguments, standard
from traceability.sources import include_options

# Operator -> a function and the replacements of the operator. The function is in mutant.hpp, and
# computes the original or the changed value. Each replacement is a mutant.
OPERATORS = {
    "<": ("less", ("<=", ">=")),
    ">": ("greater", (">=", "<=")),
    "<=": ("lessOrEqual", ("<", ">")),
    ">=": ("greaterOrEqual", (">", "<")),
    "==": ("equal", ("!=",)),
    "!=": ("unequal", ("==",)),
    "+": ("plus", ("-",)),
    "-": ("minus", ("+",)),
    "*": ("times", ("/",)),
    "/": ("divided", ("*",)),
    "%": ("remainder", ("*",)),
    "&": ("bothBits", ("|",)),
    "|": ("eitherBits", ("&",)),
    "<<": ("shiftedLeft", (">>",)),
    ">>": ("shiftedRight", ("<<",)),
}
RELATIONS = ("<", ">", "<=", ">=", "==", "!=")
STATEMENTS = {CursorKind.COMPOUND_STMT, CursorKind.CASE_STMT, CursorKind.DEFAULT_STMT}
CHANGES = {CursorKind.COMPOUND_ASSIGNMENT_OPERATOR, CursorKind.UNARY_OPERATOR}
NOT_AT_RUN_TIME = {
    CursorKind.STATIC_ASSERT,
    CursorKind.TYPE_REF,
    CursorKind.TEMPLATE_REF,
    CursorKind.ALIGNED_ATTR,
}


@dataclass(frozen=True)
class Mutant:
    """One change of the source. Its number is its position in the list of all mutants. The first
    number is 1."""

    file: str
    line: int
    method: str
    kind: str  # "relation", "arithmetic", "constant", "condition", "statement", "return"
    change: str


@dataclass(frozen=True)
class Point:
    """A part of a source with a wrapper around it. The wrapper can activate each mutant of the
    part.

    In ``before``, ``#`` is replaced by the number of the first mutant. ``cut`` is the operator
    between two operands. ``inside`` replaces the text of ``cut``."""

    start: int
    end: int
    before: str
    after: str
    mutants: tuple[Mutant, ...]
    cut: tuple[int, int] = (0, 0)
    inside: str = ""


def compiler_arguments(root: Path) -> list[str]:
    """Returns the options with which the sources are parsed. These are the options with which
    the model is built, and the option for the precompiled headers of the library."""
    parsed = ["-include-pch", str(standard(root / "build" / "model" / "cache"))]
    return [*clang_arguments(board=False), *include_options(root), *parsed]


def find_points(root: Path, unit: str, files: list[str]) -> dict[str, list[Point]]:
    """Returns the points in the bodies of the functions, by file and in the order of the text."""
    tree = cindex.Index.create().parse(str(root / unit), args=compiler_arguments(root))
    finder = _Finder(root, {str(root / file): file for file in files})
    finder.units(tree.cursor)
    return {
        file: sorted(points, key=lambda point: (point.start, -point.end))
        for file, points in finder.points.items()
    }


class _Finder:
    def __init__(self, root: Path, files: dict[str, str]) -> None:
        self.files = files
        self.texts = {file: (root / file).read_bytes() for file in files.values()}
        self.points: dict[str, list[Point]] = {}
        self.file = ""
        self.method = ""

    def units(self, cursor: Cursor) -> None:
        """Searches the bodies of the functions."""
        for child in cursor.get_children():
            place = child.location.file
            if place is None or place.name not in self.files:
                continue
            if is_function(child) and child.is_definition():
                if not self.is_constant(child):
                    self.method, self.file = function_id(child), self.files[place.name]
                    self.body(child)
            else:
                self.units(child)

    def is_constant(self, function: Cursor) -> bool:
        for token in function.get_tokens():
            if token.spelling == "{":
                return False
            if token.spelling in ("constexpr", "consteval"):
                return True
        return False

    def body(self, function: Cursor) -> None:
        for child in function.get_children():
            if child.kind == CursorKind.COMPOUND_STMT:
                self.early_return(function, child)
                self.walk(child)

    def walk(self, cursor: Cursor) -> None:
        for child in cursor.get_children():
            if child.kind in NOT_AT_RUN_TIME or self.is_constant_value(child):
                continue
            if cursor.kind in STATEMENTS:
                self.statement(child)
            self.expression(child)
            self.walk(child)

    def is_constant_value(self, cursor: Cursor) -> bool:
        if cursor.kind != CursorKind.VAR_DECL:
            return False
        return any(token.spelling == "constexpr" for token in cursor.get_tokens())

    def early_return(self, function: Cursor, body: Cursor) -> None:
        # A body with one statement gets no mutant with an early return. If this statement is a
        # call, the mutant without the call has the same effect as an early return.
        if len(list(body.get_children())) < 2:
            return
        no_value = function.kind in (CursorKind.CONSTRUCTOR, CursorKind.DESTRUCTOR)
        void = no_value or function.result_type.kind == TypeKind.VOID
        text = "return" if void else "return {}"
        at = body.extent.start.offset + 1
        mutant = self.mutant(body, "return", f"{text} at once")
        self.add(Point(at, at, f" if (mutant::on(#)) {text};", "", (mutant,)))

    def statement(self, cursor: Cursor) -> None:
        """Adds a mutant that removes a statement, if the statement is a call or an assignment."""
        inner = _layers(cursor)[-1]
        call = inner.kind == CursorKind.CALL_EXPR
        change = inner.kind in CHANGES or (
            inner.kind == CursorKind.BINARY_OPERATOR and self.operator(inner)[0] == "="
        )
        if call or change:
            mutant = self.mutant(cursor, "statement", f"without {self.short(cursor)}")
            self.wrap(cursor, "(mutant::on(#) ? void() : void(", "))", mutant)

    def expression(self, cursor: Cursor) -> None:
        kind = cursor.kind
        if kind == CursorKind.INTEGER_LITERAL:
            self.literal(cursor)
        elif kind == CursorKind.CXX_BOOL_LITERAL_EXPR:
            self.negated(cursor)
        elif kind in (CursorKind.IF_STMT, CursorKind.WHILE_STMT, CursorKind.CONDITIONAL_OPERATOR):
            first = next(cursor.get_children(), None)
            if first is not None and first.kind.is_expression():
                self.negated(first)
        elif kind == CursorKind.RETURN_STMT:
            value = next(cursor.get_children(), None)
            if value is not None and value.type.get_canonical().kind == TypeKind.BOOL:
                self.negated(value)
        else:
            self.operation(cursor)

    def operation(self, cursor: Cursor) -> None:
        operator, at = self.operator(cursor)
        if operator in ("&&", "||"):
            for operand in cursor.get_children():
                self.negated(operand)
        if operator not in OPERATORS:
            return
        kind = "relation" if operator in RELATIONS else "arithmetic"
        function, others = OPERATORS[operator]
        changes = (f"{other} for {operator} in {self.short(cursor)}" for other in others)
        mutants = [self.mutant(cursor, kind, change) for change in changes]
        self.wrap(cursor, f"mutant::{function}(#, ", ")", *mutants, cut=at, inside=",")

    def operator(self, cursor: Cursor) -> tuple[str, tuple[int, int]]:
        """Returns the operator between two operands, and its place."""
        children = list(cursor.get_children())
        if len(children) < 2 or not all(child.kind.is_expression() for child in children):
            return "", (0, 0)
        left, right = children[0].extent.end.offset, children[-1].extent.start.offset
        text = self.texts[self.file][left:right]
        stripped = text.strip()
        start = left + text.find(stripped) if stripped else left
        return stripped.decode(), (start, start + len(stripped))

    def literal(self, cursor: Cursor) -> None:
        text = self.short(cursor)
        if not text[:1].isdigit():
            return  # The source has the name of a macro here, and no number.
        mutants = (self.mutant(cursor, "constant", f"{text} {way} 1") for way in "+-")
        self.wrap(cursor, "(mutant::offset(#) + ", ")", *mutants)

    def negated(self, cursor: Cursor) -> None:
        if any(self.operator(part)[0] in RELATIONS for part in _layers(cursor)):
            return  # A relation such as a < b already has its negation a >= b as a mutant.
        mutant = self.mutant(cursor, "condition", f"not {self.short(cursor)}")
        self.wrap(cursor, "(mutant::on(#) != static_cast<bool>(", "))", mutant)

    def wrap(
        self,
        cursor: Cursor,
        before: str,
        after: str,
        *mutants: Mutant,
        cut: tuple[int, int] = (0, 0),
        inside: str = "",
    ) -> None:
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        self.add(Point(start, end, before, after, mutants, cut, inside))

    def add(self, point: Point) -> None:
        if point not in self.points.setdefault(self.file, []):
            self.points[self.file].append(point)

    def mutant(self, cursor: Cursor, kind: str, change: str) -> Mutant:
        return Mutant(self.file, cursor.extent.start.line, self.method, kind, change)

    def short(self, cursor: Cursor) -> str:
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        return " ".join(self.texts[self.file][start:end].decode().split())


def _layers(cursor: Cursor) -> list[Cursor]:
    """Returns an expression and the expressions inside it, down to the first node that the compiler
    did not add. The outermost expression is first."""
    found = [cursor]
    while found[-1].kind == CursorKind.UNEXPOSED_EXPR:
        children = list(found[-1].get_children())
        if len(children) != 1:
            break
        found.append(children[0])
    return found
