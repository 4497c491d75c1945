"""The inputs of the model, and facts that are derived from several inputs."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from traceability.grouping import grouped
from traceability.reading.ast_facts import (
    BodyFact,
    CallFact,
    ClassFact,
    FieldFact,
    IncludeFact,
    MethodFact,
    NameFact,
    Syntax,
)
from traceability.reading.comments import NO_COMMENT, Comment, Comments
from traceability.reading.declared import Declared
from traceability.reading.graphs import Ways, reached_from, ways_from
from traceability.reading.products import is_of_default
from traceability.schema import Place
from traceability.sources import DESIGN, SRC


@dataclass
class Facts:
    """The inputs of the model. Checks use these inputs if the model does not contain enough
    details."""

    root: Path
    comments: Comments
    syntax: Syntax
    declared: Declared
    # class -> all classes that derive from it, directly or indirectly
    subclasses: dict[str, list[str]]
    overriders: dict[str, list[str]]  # method -> all methods that override it
    bodies: dict[str, list[BodyFact]]
    classes: dict[str, ClassFact]
    written_in: dict[str, str]  # file -> the class with the name of the file
    bodies_of: dict[str, list[BodyFact]] = field(
        default_factory=dict
    )  # class -> all function bodies in its files
    # class -> names of classes that its code contains
    names_of: dict[str, list[NameFact]] = field(default_factory=dict)
    # class -> includes in its files
    includes_of: dict[str, list[IncludeFact]] = field(default_factory=dict)
    warnings: list[tuple[Place, str]] = field(default_factory=list)  # warnings of Doxygen

    def __post_init__(self) -> None:
        for body in self.syntax.bodies:
            self.bodies_of.setdefault(self.user(body.owner, body.place), []).append(body)
        for name in self.syntax.names:
            self.names_of.setdefault(self.user(name.by, name.place), []).append(name)
        for include in self.syntax.includes:
            owner = self.written_in.get(include.place.file, "")
            self.includes_of.setdefault(owner, []).append(include)

    @property
    def modules(self) -> set[str]:
        """Returns the names of all modules that design/modules.toml lists."""
        return {name for names in self.declared.names.values() for name in names}

    @property
    def with_role(self) -> set[str]:
        """Returns the names of all modules to which the design assigns a role in a pattern."""
        applications = self.declared.applications.values()
        return {name for item in applications for names in item.roles.values() for name in names}

    @property
    def builders(self) -> set[str]:
        """Returns the names of all modules with the role Concrete Builder."""
        return {
            name
            for item in self.declared.applications.values()
            for name in item.roles.get("Concrete Builder", [])
        }

    def user(self, owner: str, place: Place) -> str:
        """Returns the class to which a piece of code belongs. If a class has no file of its own,
        its code belongs to the class after which the file is named."""
        outer = owner.split("::", maxsplit=1)[0]
        return outer if outer in self.with_file else self.written_in.get(place.file, outer)

    def named_by(self, user: str) -> Iterator[tuple[Place, str]]:
        """Yields each class whose name is in the code of a class, or whose header this code
        includes. Each result also contains the place."""
        for name in self.names_of.get(user, []):
            yield name.place, name.target.split("::", maxsplit=1)[0]
        for include in self.includes_of.get(user, []):
            yield include.place, self.written_in.get(include.target, "")

    def comment(self, fact: ClassFact | MethodFact | FieldFact) -> Comment:
        return self.comments.at(fact.place.file, fact.comment)

    def comment_of(self, name: str) -> Comment:
        fact = self.classes.get(name)
        return self.comment(fact) if fact else NO_COMMENT

    @functools.cached_property
    def folders(self) -> dict[str, Comment]:
        """Returns a map from each folder to the comment with ``@dir`` that describes the folder."""
        comments = self.comments.below(DESIGN)
        return {comment.of("dir")[0].argument: comment for comment in comments if comment.of("dir")}

    def kind_of(self, name: str) -> str:
        """Returns "class", "struct", "enum" or "alias". Returns "" for a type outside the
        project."""
        fact = self.classes.get(name)
        return fact.kind if fact else ""

    @functools.cached_property
    def with_file(self) -> set[str]:
        """Returns the classes that have the same name as their file."""
        return set(self.written_in.values())

    @functools.cached_property
    def references(self) -> References:
        """The references in src, which is the design of the paper."""
        return References(self, lambda file: file.startswith(f"{SRC}/"))

    @functools.cached_property
    def products(self) -> References:
        """The references in the firmware of all products."""
        return References(self, lambda _: True)

    @functools.cached_property
    def robot(self) -> References:
        """The references in the firmware of the product ``DEFAULT``."""
        replaced = replaced_files(self)
        return References(self, lambda file: is_of_default(file) and file not in replaced)

    def lines_of(self, file: str) -> list[str]:
        return (self.root / file).read_text(encoding="utf-8").splitlines()

    def line_in(self, entry: Place, words: str) -> Place:
        """Returns the place of a text in an entry of ``design/``, see ``Entries.line_in``."""
        return self.declared.entries.line_in(entry, words)

    def targets(self, method: str, virtual: bool) -> list[str]:
        """Returns the methods that a call can execute: the called method, and for a virtual call
        also each overriding method."""
        return [method, *self.overriders.get(method, [])] if virtual else [method]

    def targets_in_products(self, call: CallFact, owner: str) -> tuple[list[str], bool]:
        """Returns the called method, and the methods that the call can execute in the products. The
        call is in a method of the class ``owner``. Also returns whether the objects of the call are
        known. If they are unknown, each overriding method is returned."""
        wired = self.products.wired_targets(call, owner)
        if not wired:
            return self.targets(call.target, call.virtual), False
        return list(dict.fromkeys([call.target, *wired])), True

    def bases_of(self, name: str) -> set[str]:
        """Returns all base classes of a class, direct and indirect."""
        return {base for base, others in self.subclasses.items() if name in others}

    def method(self, owner: str, name: str) -> MethodFact | None:
        """Returns the method with this name in the class ``owner`` or in a base class. Returns None
        if there is none."""
        fact = self.classes.get(owner)
        if fact is None:
            return None
        for method in fact.methods:
            if method.name == name:
                return method
        for base in fact.bases:
            inherited = self.method(base, name)
            if inherited is not None:
                return inherited
        return None


def gather_facts(root: Path, syntax: Syntax, declared: Declared) -> Facts:
    classes = {fact.name: fact for fact in syntax.classes}
    subclasses: dict[str, list[str]] = {}
    overriders: dict[str, list[str]] = {}
    methods = {method.id: method for fact in syntax.classes for method in fact.methods}
    for fact in syntax.classes:
        bases = reached_from(
            fact.bases, lambda base: classes[base].bases if base in classes else ()
        )
        for base in bases:
            subclasses.setdefault(base, []).append(fact.name)
    for method in methods.values():
        upper = method.overrides
        while upper is not None:
            overriders.setdefault(upper, []).append(method.id)
            upper = methods[upper].overrides if upper in methods else None
    bodies = grouped(syntax.bodies, lambda body: body.id)
    written_in = {
        file: fact.name
        for fact in syntax.classes
        if Path(fact.place.file).stem == fact.name
        for file in (fact.place.file, str(Path(fact.place.file).with_suffix(".cpp")))
    }
    comments = Comments(root)
    return Facts(
        root, comments, syntax, declared, subclasses, overriders, bodies, classes, written_in
    )


def is_constructor(function: str) -> bool:
    owner, _, name = function.rpartition("::")
    return bool(owner) and owner.rpartition("::")[2] == name


# ---- references: their possible objects, and the methods that a call may reach ----


@dataclass(frozen=True)
class Object:
    """An object in the firmware. ``name`` is ``Class::member`` or ``file:variable``."""

    name: str
    kind: str  # class of the object


def replaced_files(facts: Facts) -> set[str]:
    """Returns the files of src that the product ``DEFAULT`` does not contain, because a file of its
    extension defines the same function, such as an interrupt handler."""
    return {
        body.place.file
        for bodies in facts.bodies.values()
        if any(_is_extended(body) for body in bodies)
        for body in bodies
        if _is_callable(body) and not _is_extended(body)
    }


def _is_callable(body: BodyFact) -> bool:
    """Returns whether other files can call a function outside classes."""
    return not body.owner and not body.local


def _is_extended(body: BodyFact) -> bool:
    file = body.place.file
    return _is_callable(body) and is_of_default(file) and not file.startswith(f"{SRC}/")


class References:
    """For each reference, the objects to which it may refer.

    An object is a member or a variable whose type is a class of the project. The references to an
    object are followed through constructors, parameters, members and results, in all files for
    which ``contains`` returns true."""

    def __init__(self, facts: Facts, contains: Callable[[str], bool]) -> None:
        self.facts = facts
        self.contains = contains
        # file, virtual method that it calls -> methods that these calls may execute
        self.called: dict[tuple[str, str], list[str]] = {}
        self._fill()
        # Now the targets of each virtual call are known. With these targets, fewer results flow
        # into the places of a file.
        self.called = self._called()
        self._fill()

    def _fill(self) -> None:
        # place (see flow.py) -> objects to which it may refer
        self.known: dict[str, set[Object]] = {}
        self.next: dict[str, set[str]] = {}  # place -> places that may refer to the same objects
        self._objects()
        self._flows()
        self._solve()

    def _called(self) -> dict[tuple[str, str], list[str]]:
        called: dict[tuple[str, str], list[str]] = {}
        for body in self.facts.syntax.bodies:
            for call in body.calls:
                if call.virtual:
                    called.setdefault((call.place.file, call.target), []).extend(self.targets(call))
        return called

    def _objects(self) -> None:
        for fact in self.facts.syntax.classes:
            if not self.contains(fact.place.file):
                continue
            for member in fact.fields:
                name = f"{fact.name}::{member.name}"
                for kind in [] if member.refers else member.classes:
                    if kind in self.facts.classes:
                        self._know(f"field {name}", Object(name, kind))
        for name, member in self.facts.syntax.variables.items():
            if not member.refers and self.contains(member.place.file):
                for kind in member.classes:
                    if kind in self.facts.classes:
                        self._know(f"var {name}", Object(name, kind))

    def _know(self, place: str, item: Object) -> None:
        self.known.setdefault(place, set()).add(item)

    def _flows(self) -> None:
        for flow in self.facts.syntax.flows:
            if not self.contains(flow.file):
                continue
            for source in flow.sources:
                word, _, rest = source.partition(" ")
                if word == "object":
                    name, _, kind = rest.removeprefix("var ").rpartition(" ")
                    self._know(flow.into, Object(name, kind))
                elif word == "this":
                    for place in self._places_of(rest):
                        self._lead(place, flow.into)
                elif word == "result" and (flow.file, rest) in self.called:
                    for method in self.called[flow.file, rest]:
                        self._lead(f"result {method}", flow.into)
                else:
                    self._lead(source, flow.into)
        for method, overriders in self.facts.overriders.items():
            for other in overriders:
                for number in range(8):
                    self._lead(f"param {method} {number}", f"param {other} {number}")
                self._lead(f"result {other}", f"result {method}")

    def _lead(self, source: str, target: str) -> None:
        self.next.setdefault(source, set()).add(target)

    def _places_of(self, kind: str) -> list[str]:
        family = {kind, *self.facts.subclasses.get(kind, [])}
        return [
            place for place, objects in self.known.items() if any(o.kind in family for o in objects)
        ]

    def _solve(self) -> None:
        work = list(self.known)
        while work:
            place = work.pop()
            for target in self.next.get(place, ()):
                objects = self.known.setdefault(target, set())
                before = len(objects)
                objects |= self.known[place]
                if len(objects) > before:
                    work.append(target)

    def objects(self, places: list[str], kind: str = "") -> set[Object]:
        """Returns the objects to which these places may refer. If ``kind`` names a class, only
        objects of this class and of its subclasses are returned."""
        family = {kind, *self.facts.subclasses.get(kind, [])}
        reachable = {item for place in places for item in self.known.get(place, set())}
        return {item for item in reachable if not kind or item.kind in family}

    def targets(self, call: CallFact) -> list[str]:
        """Returns the methods that a call may execute. For a virtual call, these are methods of the
        objects to which the reference in the call may refer. If no such object is known, these are
        all overriding methods in the files that are read."""
        if not call.virtual:
            return [call.target]
        owner = call.target.rpartition("::")[0]
        kinds = {item.kind for item in self.objects(call.on, owner)}
        if not kinds:
            possible = self.facts.targets(call.target, virtual=True)
            return [method for method in possible if self.own_bodies(method)] or possible
        return self._methods(kinds, call.target)

    def _methods(self, kinds: Iterable[str], target: str) -> list[str]:
        name = target.rpartition("::")[2]
        methods = [self.facts.method(kind, name) for kind in sorted(kinds)]
        return list(dict.fromkeys(method.id for method in methods if method))

    def arguments(self, kind: str) -> set[str]:
        """Returns the classes of the objects that are passed to the constructors of a class."""
        begin = f"param {kind}::{kind.rpartition('::')[2]} "
        places = [place for place in self.known if place.startswith(begin)]
        return {item.kind for item in self.objects(places)}

    # ---- calls in a method of an object whose class is known -------------------

    @functools.cached_property
    def constructed(self) -> set[str]:
        """Returns the classes of all objects."""
        return {item.kind for objects in self.known.values() for item in objects}

    @functools.cached_property
    def _into(self) -> dict[str, list[str]]:
        """Returns a map from each place to the sources of all flows into the place."""
        into: dict[str, list[str]] = {}
        for flow in self.facts.syntax.flows:
            if self.contains(flow.file):
                into.setdefault(flow.into, []).extend(flow.sources)
        return into

    def own_targets(self, call: CallFact, kind: str) -> list[str]:
        """Returns the methods that a call may execute, if the calling method is a method of an
        object of exactly the class ``kind``. If a base class declares a member, this member then
        refers only to objects that the constructors of ``kind`` pass to the base class."""
        owner = call.target.rpartition("::")[0]
        if not call.virtual:
            return [call.target]
        if not call.on and owner in (kind, *self.facts.bases_of(kind)):
            return self._methods([kind], call.target)
        family = {owner, *self.facts.subclasses.get(owner, [])}
        reached = {item.kind for place in call.on for item in self._own(place, kind, frozenset())}
        return self._methods(reached & family, call.target) or self.targets(call)

    def wired_targets(self, call: CallFact, owner: str) -> list[str]:
        """Returns the methods that a call in a method of the class ``owner`` may execute. The
        object of the calling method has the class ``owner`` or a subclass. Returns an empty list if
        no object is known for the reference in the call, or for the calling method."""
        family = [owner, *self.facts.subclasses.get(owner, [])]
        kinds = [kind for kind in family if kind in self.constructed]
        target = call.target.rpartition("::")[0]
        known = self.objects(call.on, target) if call.on else kinds
        if call.virtual and not known:
            return []
        return list(
            dict.fromkeys(m for kind in kinds or [owner] for m in self.own_targets(call, kind))
        )

    def _own(self, place: str, kind: str, asked: frozenset[str]) -> set[Object]:
        """Returns the objects to which a place may refer. If the place belongs to a base class of
        ``kind``, its reference is followed only to the constructors of ``kind``."""
        word, _, rest = place.partition(" ")
        function = rest.rpartition(" ")[0]
        owner = (function or rest).rpartition("::")[0]
        sources: list[str] = []
        if place not in asked and owner in self.facts.bases_of(kind):
            if word == "param" and is_constructor(function):
                sources = self._passed(function, int(rest.rpartition(" ")[2]), kind)
            elif word == "field" or (word == "result" and rest not in self.facts.overriders):
                sources = self._into.get(place, [])
        if not sources or any(source.startswith(("object ", "this ")) for source in sources):
            return self.known.get(place, set())
        asked |= {place}
        return {item for source in sources for item in self._own(source, kind, asked)}

    def _passed(self, constructor: str, number: int, kind: str) -> list[str]:
        """Returns the sources of an argument that the constructors of ``kind`` and of its base
        classes pass to the constructor of a base class."""
        names = [
            f"{name}::{name.rpartition('::')[2]}" for name in (kind, *self.facts.bases_of(kind))
        ]
        return [
            source
            for name in names
            for body in self.own_bodies(name)
            for call in body.calls
            if call.target == constructor and number < len(call.args)
            for source in call.args[number]
        ]

    def reached(self, start: Iterable[str], within: dict[str, str], ends: list[str]) -> Ways[str]:
        """Returns all methods and functions that the functions in ``start`` may call, directly or
        indirectly. For each of them, the result contains the first caller that was found.

        ``within`` maps a virtual method to an overriding method. A call of such a virtual method is
        regarded as a call of only this overriding method. Calls inside the methods in ``ends`` are
        not followed."""

        def next_of(caller: str) -> Iterator[str]:
            for body in self.own_bodies(caller) if caller not in ends else []:
                for call in body.calls:
                    narrowed = within.get(call.target)
                    yield from [narrowed] if narrowed else self.targets(call)

        return ways_from(start, next_of)

    def own_bodies(self, method: str) -> list[BodyFact]:
        """Returns the bodies of a method or function in the files that are read."""
        return [
            body for body in self.facts.bodies.get(method, []) if self.contains(body.place.file)
        ]
