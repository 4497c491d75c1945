"""Reads what the code is, from libclang's syntax tree: what compiles is the truth.

A file of the design is read once: a header with the source file of the same name, a header without
one for itself. Files below ``src/k64``, and those in the folder ``k64`` of an extension, are read
for the K64, with the library of its compiler. The facts of a translation unit are kept in a cache,
whose key is the content of its own files, and the code without comments of all that it includes.
"""

from __future__ import annotations

import ctypes
import functools
import hashlib
import json
import multiprocessing
import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from clang import cindex
from clang.cindex import Cursor, CursorKind, LinkageKind, TypeKind

from traceability.model import cursors, flow
from traceability.model.cursors import (
    CLASSES,
    FUNCTIONS,
    NAMESPACE,
    class_name,
    function_id,
    is_function,
    namespace_of,
    qualified_name,
)
from traceability.model.flow import FlowFact
from traceability.model.schema import Place
from traceability.sources import DESIGN, file_hash, files_below, include_options

ANY_CLASS = "?"  # the class of a call that depends on the parameters of a template
BOARD = re.compile(r"(src|extensions/\w+)/k64/")
BOARD_COMPILER = "arm-none-eabi-g++"
BOARD_FLAGS = ["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"]
_NAMES = {
    CursorKind.TYPE_REF,
    CursorKind.TEMPLATE_REF,
    CursorKind.MEMBER_REF_EXPR,
    CursorKind.DECL_REF_EXPR,
    CursorKind.CALL_EXPR,
}

_REFERRING = {TypeKind.POINTER, TypeKind.LVALUEREFERENCE}
_LOCAL = {LinkageKind.INTERNAL, LinkageKind.UNIQUE_EXTERNAL, LinkageKind.NO_LINKAGE}
_CASTS = {
    CursorKind.CXX_REINTERPRET_CAST_EXPR,
    CursorKind.CSTYLE_CAST_EXPR,
    CursorKind.CXX_FUNCTIONAL_CAST_EXPR,
}
_NUMBERS = {
    TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG,
    TypeKind.ULONGLONG, TypeKind.SHORT, TypeKind.USHORT, TypeKind.ENUM, TypeKind.DEPENDENT,
}  # fmt: skip


@dataclass
class MethodFact:
    id: str
    owner: str
    name: str
    signature: str
    access: str
    kind: str
    result: str
    params: list[tuple[str, str]]  # name, type
    place: Place
    end: int
    virtual: bool = False
    pure: bool = False
    final: bool = False
    deleted: bool = False
    defaulted: bool = False
    overrides: str | None = None


@dataclass
class FieldFact:
    name: str
    type: str
    classes: list[str]  # classes of the project in the type
    refers: bool  # pointer or reference, not a value
    static: bool
    place: Place
    access: str = "public"
    constant: bool = False


@dataclass
class ClassFact:
    """A class, struct, enum or alias of the project; ``name`` is without the namespace."""

    name: str
    qualified: str
    kind: str
    place: Place
    end: int
    abstract: bool = False
    local: bool = False  # in an anonymous namespace, or in a function
    bases: list[str] = field(default_factory=list)
    base_places: list[Place] = field(default_factory=list)
    methods: list[MethodFact] = field(default_factory=list)
    fields: list[FieldFact] = field(default_factory=list)


@dataclass
class CallFact:
    target: str
    virtual: bool
    place: Place
    declared: str = ""  # the file that declares a function outside classes
    on: list[str] = field(default_factory=list)  # what a method is called on, see flow
    args: list[list[str]] = field(default_factory=list)  # what each argument names
    sometimes: bool = False  # below a condition, or after one that may have left the function


@dataclass
class BodyFact:
    """A function with a body. A function outside classes has no owner."""

    id: str
    owner: str
    place: Place
    end: int
    overrides: str | None = None
    local: bool = False  # no other file can call it
    calls: list[CallFact] = field(default_factory=list)
    assigns: list[tuple[str, int]] = field(default_factory=list)  # Class::field, line
    touches: dict[str, bool] = field(default_factory=dict)  # Class::field -> whether it is changed


@dataclass
class NameFact:
    """A class is named in the code of another one. ``how``: type, member, construct, base.

    What a namespace holds has no class; its ``member`` has the name of the namespace.
    """

    by: str
    target: str
    how: str
    place: Place
    member: str = ""
    file: str = ""  # where the class is defined, when the unit sees that


@dataclass
class BlockFact:
    """A namespace below that of the project, declared in ``file``, is opened or used at a place."""

    block: str
    file: str
    place: Place
    declares: bool


@dataclass
class IncludeFact:
    target: str
    place: Place


@dataclass
class Syntax:
    classes: list[ClassFact] = field(default_factory=list)
    bodies: list[BodyFact] = field(default_factory=list)
    names: list[NameFact] = field(default_factory=list)
    includes: list[IncludeFact] = field(default_factory=list)
    blocks: list[BlockFact] = field(default_factory=list)
    casts: list[Place] = field(default_factory=list)  # numbers made into addresses
    flows: list[FlowFact] = field(default_factory=list)
    constants: dict[str, int] = field(default_factory=dict)  # var -> value of a plain number
    friends: list[NameFact] = field(default_factory=list)  # a class lets another one in
    errors: list[tuple[Place, str]] = field(default_factory=list)

    def merge(self, other: Syntax) -> None:
        self.classes += other.classes
        self.bodies += other.bodies
        self.names += other.names
        self.includes += other.includes
        self.blocks += other.blocks
        self.casts += other.casts
        self.flows += other.flows
        self.constants |= other.constants
        self.friends += other.friends
        self.errors += other.errors


def read_syntax(root: Path, cache: Path) -> Syntax:
    """The facts of all files of the design. Only the units whose files changed are parsed."""
    cache.mkdir(parents=True, exist_ok=True)
    hashes: dict[str, str] = {}
    units = translation_units(root)
    stale: list[tuple[Path, Path, list[str], str]] = []
    for board in sorted({is_board(unit) for unit in units}):
        prepare_standard(root, cache, board)
    for unit, files in units.items():
        stored = _stored(root, cache, unit, hashes)
        if stored is None:
            stale.append((root, cache, files, unit))
    _drop_old(cache, units)
    if len(stale) > 2:
        with multiprocessing.get_context("fork").Pool(2) as pool:
            pool.starmap(_parse_and_store, stale, chunksize=2)
    else:
        for work in stale:
            _parse_and_store(*work)
    result = Syntax()
    for unit in units:
        entry = json.loads(_entry(cache, unit).read_text(encoding="utf-8"))
        result.merge(_facts_from(entry["facts"]))
    return result


def translation_units(root: Path) -> dict[str, list[str]]:
    """Unit -> the files whose facts are taken from it."""
    paths = [p for name in DESIGN for p in files_below(root, (name,), (".cpp", ".hpp"))]
    files = [str(path.relative_to(root)) for path in paths]
    units: dict[str, list[str]] = {}
    for file in files:
        source = file.removesuffix(".hpp") + ".cpp"
        unit = source if file.endswith(".hpp") and source in files else file
        units.setdefault(unit, []).append(file)
    return units


def is_board(file: str) -> bool:
    return BOARD.match(file) is not None


def _entry(cache: Path, unit: str) -> Path:
    return cache / (unit.replace("/", "__") + ".json")


def _drop_old(cache: Path, units: dict[str, list[str]]) -> None:
    wanted = {_entry(cache, unit).name for unit in units}
    for path in cache.glob("*.json"):
        if path.name not in wanted:
            path.unlink()


def _stored(root: Path, cache: Path, unit: str, hashes: dict[str, str]) -> bool | None:
    try:
        entry = json.loads(_entry(cache, unit).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if entry["reader"] != _reader_hash(is_board(unit)):
        return None
    own = own_files(unit)
    for file, known in entry["files"].items():
        key = file if file in own else f"code of {file}"
        if key not in hashes:
            hashes[key] = file_hash(root / file) if file in own else code_hash(root / file)
        if hashes[key] != known:
            return None
    return True


def own_files(unit: str) -> tuple[str, str]:
    """The files whose facts may be taken from a unit."""
    return unit, unit.removesuffix(".cpp") + ".hpp"


# Numbers come first: their ' begins no character.
_TOKENS = re.compile(
    r"""\b\d[\w'.]*|R"(?P<mark>[^()\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'"""
    r"""|(?P<comment>//[^\n]*|/\*.*?\*/)""",
    re.DOTALL,
)


def code_of(text: str) -> str:
    """The code without comments and empty lines: what the facts of other files depend on."""
    bare = _TOKENS.sub(lambda found: " " if found["comment"] else found[0], text)
    return "\n".join(line for words in bare.splitlines() if (line := words.strip()))


def code_hash(path: Path) -> str:
    """The SHA-256 of the code of a file, or the empty string when there is none."""
    try:
        return hashlib.sha256(code_of(path.read_text(encoding="utf-8")).encode()).hexdigest()
    except OSError:
        return ""


@functools.cache
def _reader_hash(board: bool) -> str:
    files = (__file__, cursors.__file__, flow.__file__)
    own = b"".join(Path(file).read_bytes() for file in files)
    return hashlib.sha256(own + repr(clang_arguments(board)).encode()).hexdigest()


@functools.cache
def clang_arguments(board: bool) -> list[str]:
    common = ["-std=c++20", "-x", "c++", "-fno-exceptions"]
    if board:
        folders = [word for path in _board_folders() for word in ("-isystem", path)]
        target = ["--target=thumbv7em-none-eabihf", *BOARD_FLAGS, "-nostdinc", "-nostdinc++"]
        return [*common, *target, *folders]
    compiler = shutil.which("g++") or "g++"
    answer = subprocess.run(
        [compiler, "-print-file-name=include"], capture_output=True, text=True, check=True
    )
    return [*common, "-isystem", answer.stdout.strip()]


def _board_folders() -> list[str]:
    """Where the compiler of the K64 looks for headers, as it says itself."""
    answer = subprocess.run(
        [BOARD_COMPILER, *BOARD_FLAGS, "-E", "-x", "c++", "-v", "/dev/null"],
        capture_output=True,
        text=True,
        check=True,
    )
    listed = answer.stderr.partition("#include <...> search starts here:")[2]
    return [str(Path(line.strip()).resolve()) for line in listed.splitlines() if line[:1] == " "]


def _parse_and_store(root: Path, cache: Path, files: list[str], unit: str) -> None:
    facts, included = parse(root, unit, files, standard(cache, is_board(unit)))
    own = own_files(unit)
    entry = {
        "reader": _reader_hash(is_board(unit)),
        "files": {
            file: file_hash(root / file) if file in own else code_hash(root / file)
            for file in sorted(included)
        },
        "facts": asdict(facts),
    }
    path = _entry(cache, unit)
    if facts.errors:
        entry["reader"] = "the unit has errors"
    path.write_text(json.dumps(entry), encoding="utf-8")


def standard(cache: Path, board: bool = False) -> Path:
    return cache / ("standard_k64.pch" if board else "standard.pch")


def prepare_standard(root: Path, cache: Path, board: bool) -> None:
    """Parses the headers of the standard library that the design includes, once for all units."""
    names: set[str] = set()
    for path in files_below(root, DESIGN, (".cpp", ".hpp")):
        if board or not is_board(str(path.relative_to(root))):
            names.update(re.findall(r"^#include (<[^>]+>)", path.read_text("utf-8"), re.MULTILINE))
    parsed = standard(cache, board)
    header = parsed.with_suffix(".hpp")
    text = "".join(f"#include {name}\n" for name in sorted(names)) + f"// {_reader_hash(board)}\n"
    if header.exists() and header.read_text(encoding="utf-8") == text:
        return
    parsed.unlink(missing_ok=True)
    header.write_text(text, encoding="utf-8")
    options = cindex.TranslationUnit.PARSE_INCOMPLETE
    arguments = ["c++-header" if one == "c++" else one for one in clang_arguments(board)]
    arguments.append("-fpch-instantiate-templates")  # else each unit does it again
    tree = cindex.Index.create().parse(str(header), args=arguments, options=options)
    if not any(problem.severity >= cindex.Diagnostic.Error for problem in tree.diagnostics):
        tree.save(str(parsed))


def parse(root: Path, unit: str, files: list[str], known: Path) -> tuple[Syntax, set[str]]:
    """The facts of the files, and all files of the project that the unit includes."""
    arguments = [*clang_arguments(is_board(unit)), *include_options(root)]
    if known.exists():
        arguments += ["-include-pch", str(known)]
    tree = cindex.Index.create().parse(str(root / unit), args=arguments)
    reader = _Reader(root, set(files))
    reader.walk(tree.cursor, None, "")
    included = {unit}
    for entry in tree.get_includes():
        target = reader.relative(entry.include.name)
        if target is not None:
            included.add(target)
    for wanted in files:
        reader.facts.includes += includes_of(root, wanted)
    for problem in tree.diagnostics:
        # With parsed headers libclang reports errors that lie in no file; they mean nothing.
        if problem.severity >= cindex.Diagnostic.Error and problem.location.file:
            file = reader.relative(problem.location.file.name)
            place = Place(file or unit, problem.location.line if file else 1)
            reader.facts.errors.append((place, problem.spelling))
    return reader.facts, included


def includes_of(root: Path, file: str) -> list[IncludeFact]:
    """The files of the project that a file includes, as written.

    The compiler's list lacks a header that was included before: it is not read a second time.
    """
    found: list[IncludeFact] = []
    lines = (root / file).read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        written = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if written is None:
            continue
        for folder in ((root / file).parent, *(root / name for name in DESIGN), root):
            target = (folder / written[1]).resolve()
            if target.is_file() and target.is_relative_to(root):
                name = str(target.relative_to(root))
                found.append(IncludeFact(name, Place(file, number)))
                break
    return found


class _Reader:
    """Walks one unit and keeps the facts of the wanted files."""

    def __init__(self, root: Path, files: set[str]) -> None:
        self.root = f"{root}/"
        self.files = files
        self.facts = Syntax()
        self.flow = flow.FlowReader(self.place)
        self.facts.flows = self.flow.flows
        self.function = ""  # the last one that was entered
        self.chances = 0  # conditions around the statement
        self.left = False  # whether a condition before it may have left the function

    def relative(self, name: str) -> str | None:
        return name.removeprefix(self.root) if name.startswith(self.root) else None

    def place(self, cursor: Cursor) -> Place | None:
        file = cursor.location.file
        relative = self.relative(file.name) if file else None
        return Place(relative, cursor.location.line) if relative else None

    def walk(self, cursor: Cursor, body: BodyFact | None, owner: str) -> None:
        before: Cursor | None = None
        for child in cursor.get_children():
            if before is not None and before.kind == CursorKind.MEMBER_REF:
                self.flow.given(before, child, self.place(before) or Place("", 1))
            before = child
            if cursor.kind == CursorKind.TRANSLATION_UNIT:
                place = self.place(child)
                if place is None or place.file not in self.files:
                    continue
            self.visit(child, body, owner)

    def visit(self, cursor: Cursor, body: BodyFact | None, owner: str) -> None:
        kind = cursor.kind
        place = self.place(cursor)
        if place is None:
            return
        if kind in CLASSES and cursor.is_definition():
            fact = self.class_fact(cursor, place)
            self.facts.classes.append(fact)
            if body is None:
                owner = fact.name
            else:
                fact.name = f"{body.id}()::{fact.name}"
        elif kind in (CursorKind.ENUM_DECL, CursorKind.TYPE_ALIAS_DECL) and body is None:
            if cursor.spelling and cursor.semantic_parent.kind == CursorKind.NAMESPACE:
                self.facts.classes.append(
                    ClassFact(
                        name=cursor.spelling,
                        qualified=qualified_name(cursor),
                        kind="enum" if kind == CursorKind.ENUM_DECL else "alias",
                        place=place,
                        end=cursor.extent.end.line,
                    )
                )
        elif body is None and is_function(cursor):
            owner = class_name(cursor.semantic_parent)
            if cursor.is_definition():
                body = self.body_fact(cursor, place, owner)
                self.facts.bodies.append(body)
                self.function = self.flow.function(cursor)
                self.chances, self.left = 0, False
        elif kind == CursorKind.CXX_BASE_SPECIFIER:
            self.name(owner, cursor.referenced, "base", place)
            return
        self.address(cursor, place)
        self.uses(cursor, body, owner, place)
        self.flow.note(cursor, self.function, place)
        if kind == CursorKind.VAR_DECL and body is None:
            self.constant(cursor)
        if body is not None:
            self.assignment(cursor, body, place)
            self.touch(cursor, body)
            self.left = self.left or (kind == CursorKind.RETURN_STMT and self.chances > 0)
        self.chances += kind in flow.CHANCES
        self.walk(cursor, body, owner)
        self.chances -= kind in flow.CHANCES

    def constant(self, cursor: Cursor) -> None:
        value = next((c for c in cursor.get_children() if not c.kind.is_reference()), None)
        while value is not None and value.kind == CursorKind.UNEXPOSED_EXPR:
            value = next(value.get_children(), None)
        if value is not None and value.kind == CursorKind.INTEGER_LITERAL:
            digits = next((token.spelling for token in value.get_tokens()), "")
            if digits.isdigit():
                self.facts.constants[self.flow.node(cursor)] = int(digits)

    def touch(self, cursor: Cursor, body: BodyFact) -> None:
        if cursor.kind == CursorKind.MEMBER_REF_EXPR:
            name = self.flow.node(cursor.referenced)
            if name.startswith("field "):
                body.touches.setdefault(name.removeprefix("field "), False)
        for name in self.flow.written(cursor):
            body.touches[name] = True

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
            call = self.call(target, body, place, virtual=_is_dynamic(cursor))
            if call is not None:
                call.on, call.args = self.flow.receiver(cursor), args
                call.sometimes = self.chances > 0 or self.left

    def named(self, target: Cursor, body: BodyFact | None, place: Place) -> None:
        """Whoever has the address of a function may call it. The name in a call is not counted."""
        known = [] if body is None else [c.target for c in body.calls[-3:] if c.place == place]
        if target.kind in FUNCTIONS and function_id(target) not in known:
            self.call(target, body, place, virtual=False)

    def call(
        self, target: Cursor, body: BodyFact | None, place: Place, *, virtual: bool
    ) -> CallFact | None:
        if body is None:
            return None
        first = None if class_name(target.semantic_parent) else self.place(target.canonical)
        call = CallFact(function_id(target), virtual, place, first.file if first else "")
        body.calls.append(call)
        return call

    def unresolved(self, cursor: Cursor, body: BodyFact | None, place: Place) -> None:
        """In a template a call of what depends on the parameters has a name only."""
        if body is not None and cursor.kind == CursorKind.MEMBER_REF_EXPR:
            name = [token.spelling for token in cursor.get_tokens()][-1:]
            body.calls += [CallFact(f"{ANY_CLASS}::{one}", False, place) for one in name]

    def variable(self, cursor: Cursor, owner: str, place: Place) -> None:
        """A variable that is no reference is an object of its class, or holds one."""
        held = self.field_fact(cursor, place)
        if not held.refers and not cursor.type.is_const_qualified():
            inner = owner.split("::", maxsplit=1)[0]
            classes = [name for name in held.classes if name.split("::", maxsplit=1)[0] != inner]
            self.facts.names += [NameFact(owner, name, "construct", place) for name in classes]

    def friend(self, cursor: Cursor, owner: str, place: Place) -> None:
        for part in cursor.get_children():
            named = part.referenced if part.kind == CursorKind.TYPE_REF else None
            if named is not None and self.place(named) is not None:
                self.facts.friends.append(NameFact(owner, class_name(named), "friend", place))

    def address(self, cursor: Cursor, place: Place) -> None:
        bits = cursor.kind == CursorKind.CALL_EXPR and cursor.spelling == "bit_cast"
        if bits or cursor.kind in _CASTS:
            value = next(reversed(list(cursor.get_children())), cursor)
            kinds = [one.type.get_canonical().kind for one in (cursor, value)]
            if kinds[0] == TypeKind.POINTER and kinds[1] in _NUMBERS:
                self.facts.casts.append(place)
        elif cursor.kind == CursorKind.NAMESPACE:
            self.block(cursor, place, declares=True)
        elif cursor.kind == CursorKind.NAMESPACE_REF:
            self.block(cursor.referenced, place, declares=False)

    def block(self, cursor: Cursor | None, place: Place, *, declares: bool) -> None:
        """Notes a namespace that lies in that of the project, and what its header holds."""
        while cursor is not None and cursor.kind != CursorKind.NAMESPACE:
            cursor = cursor.semantic_parent
        name = namespace_of(cursor)
        at = self.place(cursor) if cursor is not None and name else None
        if at is not None:
            fact = BlockFact(name, at.file, place, declares)
            if fact not in self.facts.blocks[-4:]:
                self.facts.blocks.append(fact)

    def emplacement(self, cursor: Cursor, body: BodyFact, owner: str, place: Place) -> None:
        """``field_.emplace(...)`` constructs the class that the field holds by value."""
        held = next((part for part in cursor.walk_preorder() if self.is_field(part)), None)
        if held is None:
            return
        args = [self.flow.sources(value) for value in cursor.get_arguments()]
        for name in self.field_fact(held.referenced, place).classes:
            constructor = f"{name}::{name.rsplit('::', maxsplit=1)[-1]}"
            for number, sources in enumerate(args):
                self.flow.add(f"param {constructor} {number}", sources, place)
            body.calls.append(CallFact(constructor, False, place))
            if name.split("::", maxsplit=1)[0] != owner.split("::", maxsplit=1)[0]:
                self.facts.names.append(NameFact(owner, name, "construct", place))

    def is_field(self, cursor: Cursor) -> bool:
        if cursor.kind != CursorKind.MEMBER_REF_EXPR or cursor.referenced is None:
            return False
        return bool(cursor.referenced.kind == CursorKind.FIELD_DECL)

    def name(
        self, owner: str, target: Cursor | None, how: str, place: Place, member: str = ""
    ) -> None:
        if target is None or self.place(target) is None:
            return
        named = class_name(target)
        if named and named.split("::")[0] != owner.split("::", maxsplit=1)[0]:
            known = target.get_definition()
            at = self.place(known) if known is not None else None
            file = at.file if at else ""
            self.facts.names.append(NameFact(owner, named, how, place, member, file))

    def assignment(self, cursor: Cursor, body: BodyFact, place: Place) -> None:
        if cursor.kind == CursorKind.CALL_EXPR and cursor.spelling in ("swap", "exchange"):
            for part in cursor.walk_preorder():
                if self.is_field(part):
                    owner = class_name(part.referenced.semantic_parent)
                    body.assigns.append((f"{owner}::{part.spelling}", place.line))
            return
        operator = cursor.kind == CursorKind.CALL_EXPR and cursor.spelling == "operator="
        if not operator and cursor.kind != CursorKind.BINARY_OPERATOR:
            return
        left = next(cursor.get_children(), None)
        while left is not None and left.kind == CursorKind.UNEXPOSED_EXPR:
            left = next(left.get_children(), None)
        if left is None or left.kind != CursorKind.MEMBER_REF_EXPR or left.referenced is None:
            return
        if not operator and _operator_after(cursor, left) != "=":
            return
        changed = f"{class_name(left.referenced.semantic_parent)}::{left.spelling}"
        body.assigns.append((changed, place.line))

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
        )
        for child in cursor.get_children():
            at = self.place(child) or place
            if child.kind == CursorKind.CXX_BASE_SPECIFIER:
                base = child.referenced
                if base is not None and self.place(base) is not None:
                    fact.bases.append(class_name(base))
                    fact.base_places.append(at)
            elif is_function(child):
                fact.methods.append(self.method_fact(child, at, name))
            elif child.kind in (CursorKind.FIELD_DECL, CursorKind.VAR_DECL):
                fact.fields.append(self.field_fact(child, at))
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
        )

    def method_fact(self, cursor: Cursor, place: Place, owner: str) -> MethodFact:
        params = [(item.spelling, _short(item.type.spelling)) for item in _arguments_of(cursor)]
        above = _overridden(cursor)
        name = function_id(cursor).rsplit("::", 1)[-1]
        constructor = (
            cursor.kind == CursorKind.CONSTRUCTOR or name == owner.rsplit("::", maxsplit=1)[-1]
        )
        virtual = cursor.is_virtual_method()
        pure = cursor.is_pure_virtual_method()
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
            signature=_signature(cursor, kind, result, params),
            access=cursor.access_specifier.name.lower(),
            kind=kind,
            result=result,
            params=params,
            place=place,
            end=cursor.extent.end.line,
            virtual=virtual,
            pure=pure,
            final=any(part.kind == CursorKind.CXX_FINAL_ATTR for part in cursor.get_children()),
            deleted=cursor.is_deleted_method(),
            defaulted=cursor.is_default_method(),
            overrides=function_id(above) if above is not None else None,
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


def is_local(cursor: Cursor) -> bool:
    return bool(cursor.linkage in _LOCAL)


def aliased(cursor: Cursor) -> Iterator[Cursor]:
    """The classes that an alias means: its own, and those of its parameters."""
    if cursor.kind in (CursorKind.TYPE_ALIAS_DECL, CursorKind.TYPEDEF_DECL):
        meant = cursor.underlying_typedef_type.get_canonical()
        count = max(0, meant.get_num_template_arguments())
        for part in (meant, *map(meant.get_template_argument_type, range(count))):
            yield (part.get_pointee() if part.kind in _REFERRING else part).get_declaration()


def _arguments_of(cursor: Cursor) -> Iterator[Cursor]:
    for child in cursor.get_children():
        if child.kind == CursorKind.PARM_DECL:
            yield child


def _short(type_name: str) -> str:
    return type_name.replace(f"{NAMESPACE}::", "").replace(" &", "&").replace(" *", "*")


def _signature(cursor: Cursor, kind: str, result: str, params: list[tuple[str, str]]) -> str:
    name = function_id(cursor).rsplit("::", 1)[-1]
    inner = ", ".join(f"{type_name} {param}".strip() for param, type_name in params)
    before = {"virtual": "virtual ", "pure": "virtual ", "static": "static "}.get(kind, "")
    after = " const" if cursor.is_const_method() else ""
    after += " override" if kind == "override" else ""
    after += " = 0" if cursor.is_pure_virtual_method() else ""
    shown = f"{result} " if result else ""
    return f"{before}{shown}{name}({inner}){after}"


def _operator_after(cursor: Cursor, left: Cursor) -> str:
    end = left.extent.end.offset
    for token in cursor.get_tokens():
        if token.extent.start.offset >= end:
            return str(token.spelling)
    return ""


def _library() -> Any:
    library = cindex.conf.lib
    if not hasattr(_library, "bound"):
        library.clang_Cursor_isDynamicCall.argtypes = [Cursor]
        library.clang_Cursor_isDynamicCall.restype = ctypes.c_int
        pointer = ctypes.POINTER(Cursor)
        library.clang_getOverriddenCursors.argtypes = [
            Cursor,
            ctypes.POINTER(pointer),
            ctypes.POINTER(ctypes.c_uint),
        ]
        library.clang_disposeOverriddenCursors.argtypes = [pointer]
        # A mark on this very function, so that the binding is done once.
        _library.bound = True  # type: ignore[attr-defined]
    return library


def _is_dynamic(cursor: Cursor) -> bool:
    return bool(_library().clang_Cursor_isDynamicCall(cursor))


def _overridden(cursor: Cursor) -> Cursor | None:
    """The first method that this one overrides, of the nearest base."""
    found = ctypes.POINTER(Cursor)()
    count = ctypes.c_uint()
    library = _library()
    library.clang_getOverriddenCursors(cursor, ctypes.byref(found), ctypes.byref(count))
    if not count.value:
        return None
    above = Cursor()
    ctypes.memmove(ctypes.byref(above), ctypes.byref(found[0]), ctypes.sizeof(Cursor))
    above._tu = cursor._tu
    library.clang_disposeOverriddenCursors(found)
    return above


def _place_from(data: dict[str, Any]) -> Place:
    return Place(**data)


def _facts_from(data: dict[str, Any]) -> Syntax:
    facts = Syntax()
    for item in data["classes"]:
        item["place"] = _place_from(item["place"])
        item["base_places"] = [_place_from(place) for place in item["base_places"]]
        for method in item["methods"]:
            method["place"] = _place_from(method["place"])
            method["params"] = [(name, kind) for name, kind in method["params"]]
        item["methods"] = [MethodFact(**method) for method in item["methods"]]
        for member in item["fields"]:
            member["place"] = _place_from(member["place"])
        item["fields"] = [FieldFact(**member) for member in item["fields"]]
        facts.classes.append(ClassFact(**item))
    for item in data["bodies"]:
        item["place"] = _place_from(item["place"])
        for call in item["calls"]:
            call["place"] = _place_from(call["place"])
        item["calls"] = [CallFact(**call) for call in item["calls"]]
        item["assigns"] = [(name, line) for name, line in item["assigns"]]
        facts.bodies.append(BodyFact(**item))
    for item in data["names"]:
        item["place"] = _place_from(item["place"])
        facts.names.append(NameFact(**item))
    for item in data["includes"]:
        item["place"] = _place_from(item["place"])
        facts.includes.append(IncludeFact(**item))
    for item in data["blocks"]:
        item["place"] = _place_from(item["place"])
        facts.blocks.append(BlockFact(**item))
    facts.flows = [FlowFact(**item) for item in data["flows"]]
    facts.constants = data["constants"]
    facts.casts = [_place_from(place) for place in data["casts"]]
    for item in data["friends"]:
        item["place"] = _place_from(item["place"])
        facts.friends.append(NameFact(**item))
    facts.errors = [(_place_from(place), text) for place, text in data["errors"]]
    return facts
