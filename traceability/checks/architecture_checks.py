"""arch-*: each module that the architecture names exists, and the code contains each connection
that the architecture declares."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.architecture import is_outside
from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    names: list[tuple[str, Place]] = []
    for element in model.architecture:
        names += [(name, element.place) for name in element.modules]
    for group in model.groups:
        names += [(name, group.place) for name in (group.module, *group.modules)]
    for name, place in names:
        if name not in model.modules:
            yield Finding(
                facts.declared.entries.line_in(place, name),
                "arch-module",
                f"there is no module {name}",
            )
    connectors = {
        "",
        *(element.name for element in model.architecture if element.kind == "connector"),
    }
    for connection in model.connections:
        if connection.connector not in connectors:
            text = f"there is no connector {connection.connector}"
            place = facts.declared.entries.line_in(connection.place, connection.connector)
            yield Finding(place, "arch-module", text)
        ends = (connection.source, connection.target)
        if is_outside(connection):
            continue
        missing = [name for name in ends if name not in model.modules]
        if missing:
            text = f"there is no module {missing[0]}"
            place = facts.declared.entries.line_in(connection.place, missing[0])
            yield Finding(place, "arch-module", text)
        elif not connection.way:
            text = f"the code has no {connection.kind} from {ends[0]} to {ends[1]}"
            yield Finding(connection.place, "arch-code", text)
