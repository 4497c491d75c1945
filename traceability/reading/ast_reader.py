"""Walks through the syntax tree of a translation unit, and records facts about the code in its
files."""

from __future__ import annotations

import contextlib
import ctypes
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from clang.cindex import AccessSpecifier, Cursor, CursorKind, LinkageKind, StorageClass, TypeKind

from traceability.reading import flow
from traceability.reading.ast_facts import (
    ANY_CLASS,
    BlockFact,
    BodyFact,
    BranchFact,
    CallFact,
    ClassFact,
    ConstantFact,
    EnumNumberFact,
    FieldFact,
    InitialFact,
    MethodFact,
    NameFact,
    OffsetFact,
    SilentFact,
    Syntax,
)
from traceability.reading.clang_names import (
    CLASSES,
    FUNCTIONS,
    NAMESPACE,
    class_name,
    function_id,
    is_function,
    library,
    namespace_of,
    qualified_name,
)
from traceability.reading.conditions import questions
from traceability.reading.constants import constant_names, constants_of, evaluated
from traceability.schema import Place

_NAMES = {
    CursorKind.TYPE_REF,
    CursorKind.TEMPLATE_REF,
    CursorKind.MEMBER_REF_EXPR,
    CursorKind.DECL_REF_EXPR,
    CursorKind.CALL_EXPR,
}

_DESCRIBED = {
    *(CursorKind.FIELD_DECL, CursorKind.VAR_DECL, CursorKind.ENUM_DECL),
    *(CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPEDEF_DECL, CursorKind.TYPE_ALIAS_TEMPLATE_DECL),
    *(FUNCTIONS - {CursorKind.DESTRUCTOR}),
}
_TEMPLATE_PARAMETERS = {
    CursorKind.TEMPLATE_TYPE_PARAMETER,
    CursorKind.TEMPLATE_NON_TYPE_PARAMETER,
    CursorKind.TEMPLATE_TEMPLATE_PARAMETER,
}
_REFERRING = {TypeKind.POINTER, TypeKind.LVALUEREFERENCE}
_LOCAL = {LinkageKind.INTERNAL, LinkageKind.UNIQUE_EXTERNAL, LinkageKind.NO_LINKAGE}
_CASTS = {
    CursorKind.CXX_REINTERPRET_CAST_EXPR,
    CursorKind.CSTYLE_CAST_EXPR,
    CursorKind.CXX_FUNCTIONAL_CAST_EXPR,
}
_DECLARED = {CursorKind.VAR_DECL, CursorKind.PARM_DECL, CursorKind.FIELD_DECL}
_ENUM_MAKERS = {*_CASTS, CursorKind.CXX_STATIC_CAST_EXPR, CursorKind.INIT_LIST_EXPR}
_WRAPPING = {CursorKind.UNEXPOSED_EXPR, CursorKind.PAREN_EXPR, CursorKind.UNARY_OPERATOR}
# class templates of the standard library that contain their objects by value
_HOLDERS = ("optional", "array", "pair", "tuple", "variant")
_COPIES = ("memcpy", "memmove", "__builtin_memcpy", "__builtin_memmove")
_MAKERS = ("construct_at", "make_optional", "make_unique", "make_shared")
_FLOATS = {TypeKind.FLOAT, TypeKind.DOUBLE, TypeKind.LONGDOUBLE}
_UNCOUNTED = {CursorKind.WHILE_STMT, CursorKind.DO_STMT}
_REGISTER = re.compile(r"\bRegister<[^,>]+, (\d+)")
_NUMBERS = {
    TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG,
    TypeKind.ULONGLONG, TypeKind.SHORT, TypeKind.USHORT, TypeKind.ENUM, TypeKind.DEPENDENT,
}  # fmt: skip


_CONSTANTS = {
    CursorKind.VAR_DECL,
    CursorKind.ENUM_CONSTANT_DECL,
    CursorKind.CXX_METHOD,
    CursorKind.FUNCTION_DECL,
}


class Reader:
    """A walk through the syntax tree of one translation unit. The walk stores the facts about the
    requested files."""

    def __init__(self, root: Path, files: set[str]) -> None:
        self.root = f"{root}/"
        self.files = files
        self.facts = Syntax()
        self.flow = flow.FlowReader(self.place)
        self.facts.flows = self.flow.flows
        self.function = ""  # the function that contains the present statement
        self.chances = 0  # number of conditions that enclose the present statement
        self.loops = 0
        self.initialised = ""  # the constant or data member whose initialiser is being read
        # true if an earlier condition may end the function before the present statement
        self.left = False
        # operands of the conditions that enclose the present statement
        self.asked: list[str] = []
        # operands of the earlier conditions that may end the function
        self.left_by: list[str] = []

    def relative(self, name: str) -> str | None:
        return name.removeprefix(self.root) if name.startswith(self.root) else None

    def place(self, cursor: Cursor) -> Place | None:
        file = cursor.location.file
        relative = self.relative(file.name) if file else None
        return Place(relative, cursor.location.line) if relative else None

    def walk(
        self, cursor: Cursor, body: BodyFact | None, owner: str, sure: int | None = None
    ) -> None:
        """Visits the children of a node. The first ``sure`` children are always executed. The other
        children are regarded as conditional."""
        before: Cursor | None = None
        for number, child in enumerate(cursor.get_children()):
            if before is not None and before.kind == CursorKind.MEMBER_REF:
                self.flow.given(before, child, self.place(before) or Place("", 1))
            before = child
            if cursor.kind == CursorKind.TRANSLATION_UNIT:
                place = self.place(child)
                if place is None or place.file not in self.files:
                    continue
            chance = sure is not None and number >= sure
            self.chances += chance
            self.visit(child, body, owner)
            self.chances -= chance

    def visit(self, cursor: Cursor, body: BodyFact | None, owner: str) -> None:
        kind = cursor.kind
        place = self.place(cursor)
        if place is None:
            return
        self.silence(cursor, body, place)
        if kind in CLASSES and cursor.is_definition():
            fact = self.class_fact(cursor, place)
            self.facts.classes.append(fact)
            if body is None:
                owner = fact.name
            else:
                fact.name = f"{body.id}()::{fact.name}"
        elif kind in (CursorKind.ENUM_DECL, CursorKind.TYPE_ALIAS_DECL) and body is None:
            if cursor.spelling and cursor.semantic_parent.kind == CursorKind.NAMESPACE:
                self.facts.classes.append(self.type_fact(cursor, place))
        elif body is None and is_function(cursor):
            owner = class_name(cursor.semantic_parent)
            if cursor.is_definition():
                body = self.body_fact(cursor, place, owner)
                self.facts.bodies.append(body)
                self.function = self.flow.function(cursor)
                self.chances, self.loops, self.left = 0, 0, False
                self.asked, self.left_by = [], []
        elif kind == CursorKind.CXX_BASE_SPECIFIER:
            self.name(owner, cursor.referenced, "base", place)
            return
        self.declaration(cursor, body, place)
        self.values(cursor, place)
        self.address(cursor, place)
        self.past_interface(cursor, body, place)
        self.uses(cursor, body, owner, place)
        self.flow.note(cursor, self.function, place)
        if kind == CursorKind.VAR_DECL:
            self.object(cursor, body, place)
            if body is None:
                self.constant(cursor)
        if body is not None:
            self.assignment(cursor, body, place)
            self.touch(cursor, body)
            self.run_time(cursor, body, place)
            self.branch(cursor, owner, place)
            self.leave(cursor)
        self.below(cursor, body, owner)

    def below(self, cursor: Cursor, body: BodyFact | None, owner: str) -> None:
        """Visits the parts of a statement. If the statement is a condition or a loop, the calls in
        its parts are recorded as conditional or repeated."""
        if body is None:
            self.walk(cursor, body, owner)
            return
        around, turns = len(self.asked), cursor.kind in flow.LOOPS
        self.asked += self.questions(cursor) if cursor.kind in flow.CHANCES else []
        self.loops += turns
        self.walk(cursor, body, owner, flow.sure_parts(cursor))
        self.loops -= turns
        del self.asked[around:]

    def declaration(self, cursor: Cursor, body: BodyFact | None, place: Place) -> None:
        """Records the constant or data member that was declared last. A call outside functions
        belongs to this constant or data member, because the call is in its initialiser."""
        if body is not None:
            return
        if cursor.kind in (CursorKind.VAR_DECL, CursorKind.FIELD_DECL):
            self.initialised = constant_names(cursor, place.file)[-1]
        elif cursor.kind.is_declaration() or cursor.kind == CursorKind.STATIC_ASSERT:
            self.initialised = ""

    def leave(self, cursor: Cursor) -> None:
        """Records the operands of all conditions that enclose a return statement."""
        if cursor.kind == CursorKind.RETURN_STMT and self.chances > 0:
            self.left = True
            self.left_by += self.asked

    def questions(self, cursor: Cursor) -> list[str]:
        """Returns the operands of the condition that a statement evaluates."""
        parts = [part for part in cursor.get_children() if part.kind.is_expression()]
        return questions(parts[0], self.is_own) if parts else []

    def is_own(self, target: Cursor | None) -> bool:
        return target is not None and self.place(target) is not None

    def values(self, cursor: Cursor, place: Place) -> None:
        """Records the constants that a declaration defines, under each name by which a text can
        refer to them."""
        if cursor.kind not in _CONSTANTS:
            return
        for end, number, unit in constants_of(cursor):
            for name in constant_names(cursor, place.file):
                fact = ConstantFact(f"{name}{end}", number, unit, place)
                if fact not in self.facts.values:
                    self.facts.values.append(fact)

    def silence(self, cursor: Cursor, body: BodyFact | None, place: Place) -> None:
        """Records a declaration if it has no comment although other files can use it.

        An enumerator needs a comment only if another enumerator of the same type has a comment. A
        constructor without parameters needs no comment."""
        if body is not None or not place.file.endswith(".hpp") or not _is_open(cursor):
            return
        name = "::".join(filter(None, (namespace_of(cursor), class_name(cursor.lexical_parent))))
        name = f"{name}::{cursor.spelling}".removeprefix("::")
        if cursor.kind in _DESCRIBED and not comment_line(cursor):
            constructor = cursor.kind == CursorKind.CONSTRUCTOR
            bare = constructor and not _arguments_of(cursor)
            exempt = bare or cursor.is_deleted_method() or _overridden(cursor) is not None
            if not exempt:
                variable = cursor.kind in (CursorKind.FIELD_DECL, CursorKind.VAR_DECL)
                end = cursor.extent.end.line if variable else None
                self.facts.silent.append(SilentFact(name, Place(place.file, place.line, end)))
        if cursor.kind == CursorKind.ENUM_DECL:
            values = list(cursor.get_children())
            bare_ones = [value for value in values if not comment_line(value)]
            for value in bare_ones if len(bare_ones) < len(values) else []:
                at = self.place(value) or place
                self.facts.silent.append(SilentFact(f"{name}::{value.spelling}", at))

    def constant(self, cursor: Cursor) -> None:
        given = next((c for c in cursor.get_children() if not c.kind.is_reference()), None)
        value = _inner(given, {CursorKind.UNEXPOSED_EXPR})
        if value is not None and value.kind == CursorKind.INTEGER_LITERAL:
            digits = next((token.spelling for token in value.get_tokens()), "").rstrip("uUlL")
            # A number of C++ is left out if Python cannot read this form of number.
            with contextlib.suppress(ValueError):
                self.facts.constants[self.flow.node(cursor)] = int(digits.replace("'", ""), 0)

    def object(self, cursor: Cursor, body: BodyFact | None, place: Place) -> None:
        """Records a variable whose lifetime is the whole program."""
        inside = cursor.semantic_parent.kind in CLASSES
        lasts = cursor.storage_class == StorageClass.STATIC if body else not inside
        member = self.field_fact(cursor, place)
        if lasts and not member.constant and "&" not in member.type:
            marks = [p for p in cursor.get_children() if p.kind == CursorKind.UNEXPOSED_ATTR]
            # True if the variable is in its own section of the memory. Such a variable is left out,
            # because a reset does not clear it.
            placed = any("section" in _words(mark) for mark in marks)
            self.facts.objects += [] if placed else [member]

    def touch(self, cursor: Cursor, body: BodyFact) -> None:
        if cursor.kind == CursorKind.MEMBER_REF_EXPR:
            name = self.flow.node(cursor.referenced)
            if name.startswith("field "):
                body.touches.setdefault(name.removeprefix("field "), False)
        for name in self.flow.written(cursor):
            body.touches[name] = True

    def branch(self, cursor: Cursor, owner: str, place: Place) -> None:
        for target in flow.branches_on(cursor):
            if self.place(target) is not None:
                self.facts.branches.append(BranchFact(owner, class_name(target), place))

    def uses(self, cursor: Cursor, body: BodyFact | None, owner: str, place: Place) -> None:
        if cursor.kind == CursorKind.FRIEND_DECL and owner:
            self.friend(cursor, owner, place)
        elif cursor.kind == CursorKind.VAR_DECL:
            self.variable(cursor, owner, place)
        elif cursor.kind in _NAMES:
            self.reference(cursor, body, owner, place)
        if cursor.kind == CursorKind.CALL_EXPR and cursor.spelling == "emplace" and body:
            self.emplacement(cursor, body, owner, place)

    def reference(self, cursor: Cursor, body: BodyFact | None, owner: str, place: Place) -> None:
        target = cursor.referenced or flow.method_in_template(cursor)
        if target is None:
            self.unresolved(cursor, body, place)
            return
        if self.place(target) is None:
            if cursor.kind == CursorKind.CALL_EXPR:
                self.made_by_library(cursor, target, owner, place)
            return
        self.block(target.semantic_parent, place, declares=False)
        if cursor.kind in (CursorKind.TYPE_REF, CursorKind.TEMPLATE_REF):
            self.name(owner, target, "type", place)
            for meant in aliased(target):
                self.name(owner, meant, "type", place)
            return
        parent = target.semantic_parent
        if cursor.kind != CursorKind.CALL_EXPR:
            self.name(owner, parent, "member", place, target.spelling)
            if not class_name(parent) and target.kind in (CursorKind.VAR_DECL, *FUNCTIONS):
                member = "::".join(filter(None, (namespace_of(parent), target.spelling)))
                self.facts.names.append(NameFact(owner, "", "member", place, member))
            if cursor.kind == CursorKind.DECL_REF_EXPR:
                self.named(target, body, place)
            return
        if target.kind == CursorKind.CONSTRUCTOR:
            self.name(owner, parent, "construct", place)
        if target.kind in FUNCTIONS:
            args = self.flow.arguments(cursor, target, place)
            call = self.call(
                target, body, place, virtual=bool(library().clang_Cursor_isDynamicCall(cursor))
            )
            if call is not None:
                call.on, call.args = self.flow.receiver(cursor), args
                call.sometimes = self.chances > 0 or self.left
                call.repeated, call.end = self.loops > 0, cursor.extent.end.offset
                call.asked = list(dict.fromkeys([*self.left_by, *self.asked]))

    def made_by_library(self, cursor: Cursor, target: Cursor, owner: str, place: Place) -> None:
        """Records the classes whose objects the standard library constructs for a member, for
        example the class T of std::optional<T>."""
        constructs = target.kind == CursorKind.CONSTRUCTOR and target.spelling in _HOLDERS
        if not constructs and target.spelling not in _MAKERS:
            return
        kind = cursor.type.get_canonical()
        kind = kind.get_pointee() if kind.kind == TypeKind.POINTER else kind
        count = max(0, kind.get_num_template_arguments())
        for made in (kind, *map(kind.get_template_argument_type, range(count))):
            self.name(owner, made.get_declaration(), "construct", place)

    def named(self, target: Cursor, body: BodyFact | None, place: Place) -> None:
        """If the code takes the address of a function, records a call of this function, because the
        function can later be called through the address. A direct call is not recorded here."""
        pending = [] if body is None else [c.target for c in body.calls[-3:] if c.place == place]
        if target.kind in FUNCTIONS and function_id(target) not in pending:
            self.call(target, body, place, virtual=False)

    def call(
        self, target: Cursor, body: BodyFact | None, place: Place, *, virtual: bool
    ) -> CallFact | None:
        if body is None:
            if self.initialised:
                self.facts.initial.append(InitialFact(self.initialised, function_id(target), place))
            return None
        first = None if class_name(target.semantic_parent) else self.place(target.canonical)
        call = CallFact(function_id(target), virtual, place, first.file if first else "")
        body.calls.append(call)
        return call

    def unresolved(self, cursor: Cursor, body: BodyFact | None, place: Place) -> None:
        """Records a call in a template if the target of the call depends on the template
        parameters. Only the name of the called method is known."""
        if body is not None and cursor.kind == CursorKind.MEMBER_REF_EXPR:
            name = [token.spelling for token in cursor.get_tokens()][-1:]
            body.calls += [CallFact(f"{ANY_CLASS}::{part}", False, place) for part in name]

    def variable(self, cursor: Cursor, owner: str, place: Place) -> None:
        """Records the classes that the type of a variable contains. If the variable is not a
        reference, its definition constructs an object."""
        member = self.field_fact(cursor, place)
        if not member.refers and not cursor.type.is_const_qualified():
            inner = owner.split("::", maxsplit=1)[0]
            classes = [name for name in member.classes if name.split("::", maxsplit=1)[0] != inner]
            self.facts.names += [NameFact(owner, name, "construct", place) for name in classes]
        if member.classes:
            self.facts.variables[self.flow.node(cursor).removeprefix("var ")] = member

    def friend(self, cursor: Cursor, owner: str, place: Place) -> None:
        """Records a friend declaration. A friend function that is defined inside the class is left
        out."""
        for part in cursor.get_children():
            inside = part.is_definition() or "default" in _words(part)
            if part.kind in FUNCTIONS and not inside:
                self.facts.friends.append(NameFact(owner, function_id(part), "friend", place))
            elif part.kind == CursorKind.CLASS_TEMPLATE:
                self.facts.friends.append(NameFact(owner, class_name(part), "friend", place))
            named = part.referenced if part.kind == CursorKind.TYPE_REF else None
            if named is not None and self.place(named) is not None:
                self.facts.friends.append(NameFact(owner, class_name(named), "friend", place))

    def address(self, cursor: Cursor, place: Place) -> None:
        if cursor.kind in (CursorKind.ASM_STMT, CursorKind.MS_ASM_STMT) or _is_bare_asm(cursor):
            self.facts.instructions.append(place)
        if _makes_address(cursor):
            self.facts.casts.append(place)
        if cursor.kind in _DECLARED and _is_volatile(cursor):
            self.facts.volatile.append(place)
        bits = cursor.kind == CursorKind.CALL_EXPR and cursor.spelling == "bit_cast"
        if bits or cursor.kind in _CASTS:
            value = next(reversed(list(cursor.get_children())), cursor)
            kinds = [operand.type.get_canonical().kind for operand in (cursor, value)]
            if kinds[0] == TypeKind.POINTER and kinds[1] in _NUMBERS:
                self.facts.casts.append(place)
        elif cursor.kind == CursorKind.NAMESPACE:
            self.block(cursor, place, declares=True)
        elif cursor.kind == CursorKind.NAMESPACE_REF:
            self.block(cursor.referenced, place, declares=False)

    def past_interface(self, cursor: Cursor, body: BodyFact | None, place: Place) -> None:
        """Records three faults of access: a number is used instead of an enumerator, a register is
        reached by an offset from another register, or a name of another file is declared again."""
        if cursor.kind in _ENUM_MAKERS and cursor.type.get_canonical().kind == TypeKind.ENUM:
            kind, number = class_name(cursor.type.get_declaration()), evaluated(cursor)
            named = any(part.kind == CursorKind.DECL_REF_EXPR for part in cursor.walk_preorder())
            if kind and number is not None and not named:
                self.facts.enum_numbers.append(EnumNumberFact(kind, number, place))
        base = register_of(cursor)
        if base is not None:
            numbers = [evaluated(part) for part in expressions_in(cursor.get_arguments())]
            largest = max((number for number in numbers if number is not None), default=0)
            self.facts.offsets.append(OffsetFact(base, largest, place))
        if body is None and place.file.endswith(".cpp") and _is_declared_again(cursor):
            self.facts.declared_again[cursor.spelling] = place

    def run_time(self, cursor: Cursor, body: BodyFact, place: Place) -> None:
        """Records floating-point numbers in a function, and loops whose head does not count the
        iterations."""
        kind = cursor.type.get_canonical().kind
        if kind in _FLOATS and not body.floats:
            body.floats = place.line
        body.branches = body.branches or cursor.kind in flow.CHANCES
        if cursor.kind in _UNCOUNTED or _has_no_condition(cursor):
            body.loops.append(place.line)

    def block(self, cursor: Cursor | None, place: Place, *, declares: bool) -> None:
        """Records uses of a namespace that is inside the namespace of the project (a block of
        registers)."""
        while cursor is not None and cursor.kind != CursorKind.NAMESPACE:
            cursor = cursor.semantic_parent
        name = namespace_of(cursor)
        at = self.place(cursor) if cursor is not None and name else None
        if at is not None:
            fact = BlockFact(name, at.file, place, declares)
            if fact not in self.facts.blocks[-4:]:
                self.facts.blocks.append(fact)

    def emplacement(self, cursor: Cursor, body: BodyFact, owner: str, place: Place) -> None:
        """Records the class of the object that ``field_.emplace(...)`` constructs. The data member
        contains this object by value."""
        member = next((part for part in cursor.walk_preorder() if flow.is_field(part)), None)
        if member is None:
            return
        args = [self.flow.sources(value) for value in cursor.get_arguments()]
        for name in self.field_fact(member.referenced, place).classes:
            constructor = f"{name}::{name.rsplit('::', maxsplit=1)[-1]}"
            for number, sources in enumerate(args):
                self.flow.add(f"param {constructor} {number}", sources, place)
            body.calls.append(CallFact(constructor, False, place))
            if name.split("::", maxsplit=1)[0] != owner.split("::", maxsplit=1)[0]:
                self.facts.names.append(NameFact(owner, name, "construct", place))

    def name(
        self, owner: str, target: Cursor | None, how: str, place: Place, member: str = ""
    ) -> None:
        if target is None or self.place(target) is None:
            return
        named = class_name(target)
        if named and named.split("::")[0] != owner.split("::", maxsplit=1)[0]:
            definition = target.get_definition()
            at = self.place(definition) if definition is not None else None
            file = at.file if at else ""
            self.facts.names.append(NameFact(owner, named, how, place, member, file))

    def assignment(self, cursor: Cursor, body: BodyFact, place: Place) -> None:
        if cursor.kind == CursorKind.CALL_EXPR and cursor.spelling in ("swap", "exchange"):
            for part in cursor.walk_preorder():
                if flow.is_field(part):
                    owner = class_name(part.referenced.semantic_parent)
                    body.assigns.append((f"{owner}::{part.spelling}", place.line))
            return
        if cursor.kind == CursorKind.VAR_DECL:
            left = self.other_name_of(cursor)
        else:
            left = self.left_side(cursor)
        if left is not None and left.referenced is not None:
            changed = f"{class_name(left.referenced.semantic_parent)}::{left.spelling}"
            body.assigns.append((changed, place.line))

    def left_side(self, cursor: Cursor) -> Cursor | None:
        """Returns the data member that an assignment changes."""
        operator = cursor.kind == CursorKind.CALL_EXPR and cursor.spelling == "operator="
        if not operator and cursor.kind != CursorKind.BINARY_OPERATOR:
            return None
        side = next(cursor.get_children(), None)
        if side is None or (not operator and flow.operator_of(cursor, side) != "="):
            return None
        left = bare(side)
        # The code calls the operator by its name, for example a.operator=(b).
        if left is not None and left.spelling == "operator=":
            left = bare(next(left.get_children(), None))
        return left if left is not None and left.kind == CursorKind.MEMBER_REF_EXPR else None

    def other_name_of(self, variable: Cursor) -> Cursor | None:
        """Returns the data member to which a local reference refers. Code can change the member by
        means of this reference."""
        kind = variable.type.get_canonical()
        meant = kind.get_pointee()
        if kind.kind not in _REFERRING or meant.is_const_qualified():
            return None
        given = [bare(part) for part in variable.get_children() if not part.kind.is_reference()]
        member = next((each for each in given if each is not None and flow.is_field(each)), None)
        same = member is not None and member.type.get_canonical().spelling == meant.spelling
        return member if same else None

    def class_fact(self, cursor: Cursor, place: Place) -> ClassFact:
        name = class_name(cursor)
        fact = ClassFact(
            name=name,
            qualified=qualified_name(cursor),
            kind="struct" if cursor.kind == CursorKind.STRUCT_DECL else "class",
            place=place,
            end=cursor.extent.end.line,
            abstract=cursor.is_abstract_record(),
            local=is_local(cursor),
            access=cursor.access_specifier.name.lower(),
            comment=comment_line(cursor),
        )
        for child in cursor.get_children():
            at = self.place(child) or place
            if child.kind == CursorKind.CXX_BASE_SPECIFIER:
                base = unaliased(child)
                if base is not None and self.place(base) is not None:
                    fact.bases.append(class_name(base))
            elif is_function(child):
                fact.methods.append(self.method_fact(child, at, name))
            elif child.kind in (CursorKind.FIELD_DECL, CursorKind.VAR_DECL):
                fact.fields.append(self.field_fact(child, at))
            elif child.kind in _TEMPLATE_PARAMETERS:
                fact.parameters.append(child.spelling)
        return fact

    def type_fact(self, cursor: Cursor, place: Place) -> ClassFact:
        """Returns the fact about an enumeration or an alias."""
        kind = "enum" if cursor.kind == CursorKind.ENUM_DECL else "alias"
        end, comment = cursor.extent.end.line, comment_line(cursor)
        fact = ClassFact(cursor.spelling, qualified_name(cursor), kind, place, end, comment=comment)
        for child in cursor.get_children() if kind == "enum" else ():
            if child.kind == CursorKind.ENUM_CONSTANT_DECL:
                value = self.field_fact(child, self.place(child) or place)
                value.type = ""
                fact.values.append(value)
        return fact

    def field_fact(self, cursor: Cursor, place: Place) -> FieldFact:
        spelling = cursor.type.spelling
        classes = [
            class_name(part.referenced)
            for part in cursor.walk_preorder()
            if part.kind in (CursorKind.TYPE_REF, CursorKind.TEMPLATE_REF)
            and part.referenced is not None
            and self.place(part.referenced) is not None
        ]
        return FieldFact(
            name=cursor.spelling,
            type=spelling,
            classes=[name for name in dict.fromkeys(classes) if name],
            refers=any(mark in spelling for mark in ("&", "*", "reference_wrapper")),
            static=cursor.kind == CursorKind.VAR_DECL,
            place=place,
            access=cursor.access_specifier.name.lower(),
            constant=cursor.type.is_const_qualified(),
            # Without a comment above the declaration, the comment can be at the end of the source
            # line.
            comment=comment_line(cursor) or cursor.extent.end.line,
        )

    def method_fact(self, cursor: Cursor, place: Place, owner: str) -> MethodFact:
        params = [(item.spelling, _short(item.type.spelling)) for item in _arguments_of(cursor)]
        above = _overridden(cursor)
        name = function_id(cursor).rsplit("::", 1)[-1]
        constructor = cursor.kind == CursorKind.CONSTRUCTOR or name == owner.rpartition("::")[2]
        virtual, pure = cursor.is_virtual_method(), cursor.is_pure_virtual_method()
        if constructor:
            kind = "constructor"
        elif above is not None:
            kind = "override"
        elif pure:
            kind = "pure"
        elif virtual:
            kind = "virtual"
        else:
            kind = "static" if cursor.is_static_method() else "plain"
        destructor = cursor.kind == CursorKind.DESTRUCTOR
        result = "" if constructor or destructor else _short(cursor.result_type.spelling)
        return MethodFact(
            id=f"{owner}::{name}",
            owner=owner,
            name=name,
            signature=_signature(cursor, name, kind, result, params),
            access=cursor.access_specifier.name.lower(),
            kind=kind,
            result=result,
            params=params,
            place=place,
            end=cursor.extent.end.line,
            virtual=virtual,
            pure=pure,
            deleted=cursor.is_deleted_method(),
            defaulted=cursor.is_default_method(),
            overrides=function_id(above) if above is not None else None,
            comment=comment_line(cursor),
        )

    def body_fact(self, cursor: Cursor, place: Place, owner: str) -> BodyFact:
        above = _overridden(cursor) if owner else None
        return BodyFact(
            id=function_id(cursor),
            owner=owner,
            place=Place(place.file, place.line, cursor.extent.end.line),
            end=cursor.extent.end.line,
            overrides=function_id(above) if above is not None else None,
            local=is_local(cursor),
        )


def bare(cursor: Cursor | None) -> Cursor | None:
    """Returns the inner expression without the brackets, address operators and dereferences around
    it."""
    return _inner(cursor, _WRAPPING)


def _inner(cursor: Cursor | None, around: set[CursorKind]) -> Cursor | None:
    while cursor is not None and cursor.kind in around:
        cursor = next(cursor.get_children(), None)
    return cursor


def _words(cursor: Cursor) -> list[str]:
    return [token.spelling for token in cursor.get_tokens()]


def expressions_in(cursors: Iterable[Cursor]) -> Iterator[Cursor]:
    """Yields the expressions and all expressions inside them."""
    for cursor in cursors:
        yield from (part for part in cursor.walk_preorder() if part.kind.is_expression())


def register_of(call: Cursor) -> int | None:
    """Returns the address of the register to which a call adds an offset."""
    if call.kind != CursorKind.CALL_EXPR or call.spelling != "at":
        return None
    base = next(call.get_children(), None)
    kind = base.type.get_canonical().spelling if base is not None else ""
    kind = kind or call.type.get_canonical().spelling
    register = _REGISTER.search(f"{kind} {call.type.get_canonical().spelling}")
    return int(register[1]) if register else None


def _is_declared_again(cursor: Cursor) -> bool:
    """Returns whether a source file declares a name of another file again, instead of including the
    header that declares this name."""
    first = cursor.canonical == cursor and cursor.get_definition() is None
    is_variable = cursor.kind == CursorKind.VAR_DECL and cursor.storage_class == StorageClass.EXTERN
    is_free = cursor.kind == CursorKind.FUNCTION_DECL and cursor.linkage == LinkageKind.EXTERNAL
    return first and (is_variable or is_free)


def _has_no_condition(cursor: Cursor) -> bool:
    if cursor.kind != CursorKind.FOR_STMT:
        return False
    head = "".join(_words(cursor)).partition("{")[0]
    return ";;" in head


def _is_bare_asm(cursor: Cursor) -> bool:
    """Returns whether a node of the syntax tree is an assembler instruction outside functions."""
    bare_kind = cursor.kind == CursorKind.UNEXPOSED_DECL
    return bare_kind and _words(cursor)[:1] in (["asm"], ["__asm__"], ["__asm"])


def _makes_address(cursor: Cursor) -> bool:
    """Returns whether a node of the syntax tree makes a pointer from a number without a cast: by
    means of a union, a copy of the bytes, or an offset from a null pointer."""
    if cursor.kind == CursorKind.UNION_DECL:
        members = [part for part in cursor.get_children() if part.kind == CursorKind.FIELD_DECL]
        return any(part.type.get_canonical().kind == TypeKind.POINTER for part in members)
    if cursor.kind == CursorKind.CXX_STATIC_CAST_EXPR:
        return any(part.kind == CursorKind.CXX_NULL_PTR_LITERAL_EXPR for part in _parts(cursor))
    if cursor.kind == CursorKind.CALL_EXPR and cursor.spelling in _COPIES:
        target = _inner(next(cursor.get_arguments(), None), {CursorKind.UNEXPOSED_EXPR})
        kind = target.type.get_canonical().get_pointee() if target is not None else None
        return kind is not None and kind.kind == TypeKind.POINTER
    return False


def _is_volatile(cursor: Cursor) -> bool:
    """Returns whether a declaration is volatile, or refers to a volatile object."""
    kind = cursor.type.get_canonical()
    while kind.kind in _REFERRING:
        kind = kind.get_pointee()
    return bool(kind.is_volatile_qualified())


def _parts(cursor: Cursor) -> Iterator[Cursor]:
    """Yields the operand of a cast. The nodes that the compiler adds around the operand are
    skipped."""
    for child in cursor.get_children():
        yield child
        if child.kind == CursorKind.UNEXPOSED_EXPR:
            yield from child.get_children()


def is_local(cursor: Cursor) -> bool:
    return bool(cursor.linkage in _LOCAL)


def aliased(cursor: Cursor) -> Iterator[Cursor]:
    """Yields the classes in the type of an alias: the class itself and the classes of its template
    arguments."""
    if cursor.kind in (CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPEDEF_DECL):
        meant = cursor.underlying_typedef_type.get_canonical()
        count = max(0, meant.get_num_template_arguments())
        for part in (meant, *map(meant.get_template_argument_type, range(count))):
            yield (part.get_pointee() if part.kind in _REFERRING else part).get_declaration()


def unaliased(cursor: Cursor) -> Cursor | None:
    """Returns the class that a base-class clause names."""
    named = cursor.referenced
    if named is not None and named.kind in (CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPEDEF_DECL):
        return cursor.type.get_canonical().get_declaration()
    return named


def _arguments_of(cursor: Cursor) -> list[Cursor]:
    return [child for child in cursor.get_children() if child.kind == CursorKind.PARM_DECL]


def _short(type_name: str) -> str:
    return type_name.replace(f"{NAMESPACE}::", "").replace(" &", "&").replace(" *", "*")


def _signature(
    cursor: Cursor, name: str, kind: str, result: str, params: list[tuple[str, str]]
) -> str:
    inner = ", ".join(f"{type_name} {param}".strip() for param, type_name in params)
    before = {"virtual": "virtual ", "pure": "virtual ", "static": "static "}.get(kind, "")
    after = " const" if cursor.is_const_method() else ""
    after += " override" if kind == "override" else ""
    after += " = 0" if cursor.is_pure_virtual_method() else ""
    shown = f"{result} " if result else ""
    return f"{before}{shown}{name}({inner}){after}"


def comment_line(cursor: Cursor) -> int:
    """Returns the source line at which the comment of a declaration begins. Returns 0 if the
    comment is missing or in another file."""
    start = library().clang_Cursor_getCommentRange(cursor).start
    same = start.file is not None and start.file.name == cursor.location.file.name
    return int(start.line) if same else 0


def _is_open(cursor: Cursor) -> bool:
    """Returns whether other files can use a declaration. The declaration and all classes around it
    must be public."""
    if cursor.access_specifier not in (AccessSpecifier.PUBLIC, AccessSpecifier.INVALID):
        return False
    above = cursor.lexical_parent
    if above is None or above.kind in (CursorKind.NAMESPACE, CursorKind.TRANSLATION_UNIT):
        return cursor.semantic_parent is None or cursor.semantic_parent.kind not in CLASSES
    return above.kind in CLASSES and _is_open(above)


def _overridden(cursor: Cursor) -> Cursor | None:
    """Returns the method that this method overrides in the nearest base class."""
    overridden = ctypes.POINTER(Cursor)()
    count = ctypes.c_uint()
    library().clang_getOverriddenCursors(cursor, ctypes.byref(overridden), ctypes.byref(count))
    if not count.value:
        return None
    above = Cursor()
    ctypes.memmove(ctypes.byref(above), ctypes.byref(overridden[0]), ctypes.sizeof(Cursor))
    above._tu = cursor._tu
    library().clang_disposeOverriddenCursors(overridden)
    return above
