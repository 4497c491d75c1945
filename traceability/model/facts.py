"""What the model is made from, and what is found out by looking at it as a whole."""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from pathlib import Path

from traceability.model.annotations import Annotations
from traceability.model.code_facts import (
    BodyFact,
    ClassFact,
    IncludeFact,
    MethodFact,
    NameFact,
    Syntax,
)
from traceability.model.declared import Declared
from traceability.model.references import References
from traceability.model.schema import Place


@dataclass
class Facts:
    """What the model was made from. Checks that need more than the model read it here."""

    root: Path
    annotations: Annotations
    syntax: Syntax
    declared: Declared
    heirs: dict[str, list[str]]  # class -> all classes below it
    overriders: dict[str, list[str]]  # method -> all methods that override it
    bodies: dict[str, list[BodyFact]]
    classes: dict[str, ClassFact]
    written_in: dict[str, str]  # file -> the class that it is named after
    bodies_of: dict[str, list[BodyFact]] = field(default_factory=dict)  # class -> all in its files
    names_of: dict[str, list[NameFact]] = field(default_factory=dict)  # class -> what it names
    includes_of: dict[str, list[IncludeFact]] = field(default_factory=dict)  # class -> its files'

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
        """The design modules, as they are named in the design."""
        return {name for names in self.declared.names.values() for name in names}

    @property
    def with_role(self) -> set[str]:
        """The modules that the design binds to a role."""
        known = self.declared.applications.values()
        return {name for item in known for names in item.roles.values() for name in names}

    @property
    def builders(self) -> set[str]:
        """The modules that build."""
        return {
            name
            for item in self.declared.applications.values()
            for name in item.roles.get("Concrete Builder", [])
        }

    def user(self, owner: str, place: Place) -> str:
        """The class that code belongs to: what stands beside a class is its detail."""
        outer = owner.split("::", maxsplit=1)[0]
        return outer if outer in self.with_file else self.written_in.get(place.file, outer)

    def kind_of(self, name: str) -> str:
        """What a class is: class, struct, enum or alias; empty for one that is not known."""
        fact = self.classes.get(name)
        return fact.kind if fact else ""

    @functools.cached_property
    def with_file(self) -> set[str]:
        """The classes that a file is named after."""
        return set(self.written_in.values())

    @functools.cached_property
    def references(self) -> References:
        return References(self)

    def lines_of(self, file: str) -> list[str]:
        return (self.root / file).read_text(encoding="utf-8").splitlines()

    def targets(self, method: str, virtual: bool) -> list[str]:
        """The methods that a call can reach."""
        return [method, *self.overriders.get(method, [])] if virtual else [method]

    def method(self, owner: str, name: str) -> MethodFact | None:
        """The method that ``owner`` has or inherits."""
        fact = self.classes.get(owner)
        if fact is None:
            return None
        for method in fact.methods:
            if method.name == name:
                return method
        for base in fact.bases:
            found = self.method(base, name)
            if found is not None:
                return found
        return None


def gather_facts(root: Path, annotations: Annotations, syntax: Syntax, declared: Declared) -> Facts:
    classes = {fact.name: fact for fact in syntax.classes}
    heirs: dict[str, list[str]] = {}
    overriders: dict[str, list[str]] = {}
    methods = {method.id: method for fact in syntax.classes for method in fact.methods}
    for fact in syntax.classes:
        above, known = list(fact.bases), set()
        while above:
            base = above.pop()
            if base in known:
                continue
            known.add(base)
            heirs.setdefault(base, []).append(fact.name)
            above += classes[base].bases if base in classes else []
    for method in methods.values():
        upper = method.overrides
        while upper is not None:
            overriders.setdefault(upper, []).append(method.id)
            upper = methods[upper].overrides if upper in methods else None
    bodies: dict[str, list[BodyFact]] = {}
    for body in syntax.bodies:
        bodies.setdefault(body.id, []).append(body)
    written_in = {
        file: fact.name
        for fact in syntax.classes
        if Path(fact.place.file).stem == fact.name
        for file in (fact.place.file, str(Path(fact.place.file).with_suffix(".cpp")))
    }
    return Facts(
        root, annotations, syntax, declared, heirs, overriders, bodies, classes, written_in
    )
