"""arch-*: each module in the architecture exists, each connection begins and ends at elements of
the right kind, and the code contains each connection that the architecture declares."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.architecture import is_outside
from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place

# kinds of the elements whose modules must be in a connection or in a group
ACTING = ("controller", "process", "sensor", "event")
PHYSICAL = "physical"
# kind of a connection, end of the connection, kind of the element at this end
ENDS = (
    ("command", "source", "controller"),
    ("command", "target", "process"),
    (PHYSICAL, "source", "process"),
    (PHYSICAL, "target", "sensor"),
)


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _elements(model, facts)
    names: list[tuple[str, Place]] = []
    for element in model.architecture:
        names += [(name, element.place) for name in element.modules]
    for group in model.groups:
        names += [(name, group.place) for name in (group.module, *group.modules)]
    for name, place in names:
        if name not in model.modules:
            yield _wrong(place, name, f"there is no module {name}", facts)
    connectors = {element.name for element in model.architecture if element.kind == "connector"}
    for connection in model.connections:
        name = connection.connector
        if name and name not in connectors:
            yield _wrong(connection.place, name, f"there is no connector {name}", facts)
        ends = (connection.source, connection.target)
        if is_outside(connection):
            continue
        missing = [name for name in ends if name not in model.modules]
        if missing:
            text = f"there is no module {missing[0]}"
            yield _wrong(connection.place, missing[0], text, facts)
        elif not connection.way:
            text = f"the code has no {connection.kind} from {ends[0]} to {ends[1]}"
            text += f" through {', '.join(connection.through)}" if connection.through else ""
            yield Finding(connection.place, "arch-code", text)


def _elements(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds modules that are in no connection and no group, or in several elements. Also finds
    connections with a wrong end, and processes at which no physical connection begins."""
    connected = {name for each in model.connections for name in (each.source, each.target)}
    connected.update(name for group in model.groups for name in group.modules)
    acting = [element for element in model.architecture if element.kind in ACTING]
    owners: dict[str, str] = {}
    for element in acting:
        for name in element.modules:
            owner = owners.setdefault(name, element.name)
            if name not in model.modules:
                continue
            if name not in connected:
                text = f"no connection and no group contains {name}, a module of {element.name}"
                yield _wrong(element.place, name, text, facts)
            elif owner != element.name:
                text = f"{name} is a module of {owner} and of {element.name}"
                yield _wrong(element.place, name, text, facts)
    for kind, end, owner in ENDS:
        yield from _ends(model, kind, end, owner, facts)
    sources = {each.source for each in model.connections if each.kind == PHYSICAL}
    for element in acting:
        if element.kind == "process" and element.modules and not sources & set(element.modules):
            text = f"no physical connection begins at a module of {element.name}"
            yield Finding(element.place, "arch-module", text)


def _ends(model: Model, kind: str, end: str, owner: str, facts: Facts) -> Iterator[Finding]:
    """Finds connections of the kind ``kind`` that have a wrong module at one end. The argument
    ``end`` selects this end. A module is wrong if it belongs to no element of the kind
    ``owner``."""
    elements = [element for element in model.architecture if element.kind == owner]
    modules = {name for element in elements for name in element.modules}
    ends = {getattr(each, end): each for each in model.connections if each.kind == kind}
    for name, connection in ends.items():
        if elements and name in model.modules and name not in modules:
            text = f"{name} has a {kind} connection, but is not a module of a {owner}"
            yield _wrong(connection.place, name, text, facts)


def _wrong(entry: Place, name: str, text: str, facts: Facts) -> Finding:
    return Finding(facts.line_in(entry, name), "arch-module", text)
