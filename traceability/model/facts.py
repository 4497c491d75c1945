"""What the model is made from, and what is found out by looking at it as a whole."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from traceability.model.annotations import Annotations
from traceability.model.declared import Declared
from traceability.model.references import References
from traceability.model.syntax import BodyFact, ClassFact, MethodFact, Syntax


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

    @functools.cached_property
    def references(self) -> References:
        return References(self)

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
    return Facts(root, annotations, syntax, declared, heirs, overriders, bodies, classes)
