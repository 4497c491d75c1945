"""Which objects a reference may refer to, and so which methods a call may reach.

An object is a member or a variable that holds a class of the project by value. Its references are
followed through constructors, parameters, members and results, in all files of the robot itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from traceability.sources import SRC

if TYPE_CHECKING:
    from traceability.model.code_facts import BodyFact, CallFact
    from traceability.model.facts import Facts


@dataclass(frozen=True)
class Object:
    """``name`` is ``Class::member``, or ``file:variable``."""

    name: str
    kind: str  # its class


class References:
    def __init__(self, facts: Facts) -> None:
        self.facts = facts
        self.known: dict[str, set[Object]] = {}  # place -> objects
        self.next: dict[str, set[str]] = {}  # place -> places that know what it knows
        self._objects()
        self._flows()
        self._solve()

    def _objects(self) -> None:
        for fact in self.facts.syntax.classes:
            if not fact.place.file.startswith(f"{SRC}/"):
                continue
            for member in fact.fields:
                name = f"{fact.name}::{member.name}"
                for kind in [] if member.refers else member.classes:
                    if kind in self.facts.classes:
                        self._know(f"field {name}", Object(name, kind))

    def _know(self, place: str, one: Object) -> None:
        self.known.setdefault(place, set()).add(one)

    def _flows(self) -> None:
        for flow in self.facts.syntax.flows:
            if not flow.file.startswith(f"{SRC}/"):
                continue
            for source in flow.sources:
                word, _, rest = source.partition(" ")
                if word == "object":
                    name, _, kind = rest.removeprefix("var ").rpartition(" ")
                    self._know(flow.into, Object(name, kind))
                elif word == "this":
                    for place in self._places_of(rest):
                        self._lead(place, flow.into)
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
        family = {kind, *self.facts.heirs.get(kind, [])}
        return [
            place for place, known in self.known.items() if any(o.kind in family for o in known)
        ]

    def _solve(self) -> None:
        work = list(self.known)
        while work:
            place = work.pop()
            for target in self.next.get(place, ()):
                known = self.known.setdefault(target, set())
                before = len(known)
                known |= self.known[place]
                if len(known) > before:
                    work.append(target)

    def objects(self, places: list[str], kind: str = "") -> set[Object]:
        """What places may refer to: objects of a class and its heirs, or all."""
        family = {kind, *self.facts.heirs.get(kind, [])}
        found = {one for place in places for one in self.known.get(place, set())}
        return {one for one in found if not kind or one.kind in family}

    def targets(self, call: CallFact) -> list[str]:
        """The methods that a call may reach: those of the objects that it is called on."""
        owner, _, name = call.target.rpartition("::")
        if not call.virtual:
            return [call.target]
        kinds = sorted({one.kind for one in self.objects(call.on, owner)})
        if not kinds:
            return self.facts.targets(call.target, virtual=True)
        methods = [self.facts.method(kind, name) for kind in kinds]
        return list(dict.fromkeys(method.id for method in methods if method))

    def reached(self, start: list[str], within: dict[str, str], ends: list[str]) -> dict[str, str]:
        """Methods and functions that may run below the start -> who calls each first.

        ``within`` narrows a virtual method to one that overrides it. Nothing runs below ``ends``.
        """
        found = dict.fromkeys(start, "")
        work = list(start)
        while work:
            caller = work.pop(0)
            for body in self.own_bodies(caller) if caller not in ends else []:
                for call in body.calls:
                    narrowed = within.get(call.target)
                    for target in [narrowed] if narrowed else self.targets(call):
                        if target not in found:
                            found[target] = caller
                            work.append(target)
        return found

    def own_bodies(self, method: str) -> list[BodyFact]:
        """The bodies in the robot itself."""
        bodies = self.facts.bodies.get(method, [])
        return [body for body in bodies if body.place.file.startswith(f"{SRC}/")]
