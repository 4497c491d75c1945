"""The data dictionary: the parts of each value type, and the fields of the messages.

A module writes a part if it assigns a value to the part, or if it names the part in an initialiser
list. If a module uses the name of the part in another way, it reads the part."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.ast_facts import BodyFact, FieldFact
from traceability.reading.constants import UNIT
from traceability.reading.source_facts import Facts
from traceability.schema import DataPart, MessageField

FIELDS = "FieldName"
ACCESS = re.compile(r"\w*(Reader|Writer)::(read|write)([UI]\d+)")


def with_dictionary(model: Model, facts: Facts) -> Model:
    users = part_users(model, facts)
    modules = dict(model.modules)
    for module in model.modules.values():
        parts: list[DataPart] = []
        for part in parts_of(module.name, facts) if module.datatype else []:
            makers, readers = users.get(f"{module.name}::{part.name}", (set(), set()))
            text = facts.comment(part).brief
            unit = UNIT.search(text) or UNIT.search(unit_text(part.type, model))
            parts.append(
                DataPart(
                    part.name,
                    part.type,
                    text,
                    unit[1] if unit else "",
                    sorted(makers - {module.name}),
                    sorted(readers - makers - {module.name}),
                )
            )
        modules[module.name] = replace(module, parts=parts)
    return replace(model, modules=modules, messages=message_fields(model, facts))


def parts_of(name: str, facts: Facts) -> list[FieldFact]:
    """Returns the parts of a type. The parts of a class are its public data members. The parts of
    an enumeration are its values."""
    fact = facts.classes.get(name)
    return (
        [field for field in fact.fields if field.access == "public"] + fact.values if fact else []
    )


def unit_text(kind: str, model: Model) -> str:
    """Returns the description of the value type in a C++ type. For ``std::optional<Velocity>``,
    this is the description of Velocity. The description contains the unit."""
    named = [model.modules[word] for word in re.findall(r"\w+", kind) if word in model.modules]
    return named[-1].brief if named else ""


def module_of(body: BodyFact, model: Model) -> str:
    """Returns the name of the module to which a function body belongs. A function outside classes
    belongs to the module that has the same name as its file. The result is empty if no module has
    this name."""
    owner = body.owner.split("::")[0] or Path(body.place.file).stem
    return owner if owner in model.modules else ""


def part_users(model: Model, facts: Facts) -> dict[str, tuple[set[str], set[str]]]:
    """Returns two sets of modules for each part (``Type::part``). The modules in the first set
    write the part. The modules in the second set read the part."""
    users: dict[str, tuple[set[str], set[str]]] = {}
    for body in facts.syntax.bodies:
        name = module_of(body, model)
        for member, changed in body.touches.items() if name else ():
            users.setdefault(member, (set(), set()))[0 if changed else 1].add(name)
    for flow in facts.syntax.flows:
        word, _, member = flow.into.partition(" ")
        name = Path(flow.file).stem
        if word == "field" and name in model.modules:
            users.setdefault(member, (set(), set()))[0].add(name)
    return users


def message_fields(model: Model, facts: Facts) -> list[MessageField]:
    """Returns the fields of the messages, in the order in which they are declared."""
    parts = parts_of(FIELDS, facts)
    widths: dict[str, str] = {}
    # (name of a message field, "write" or "read") -> modules that write or read the field
    users: dict[tuple[str, str], dict[str, None]] = {}
    tables: dict[str, list[str]] = {}  # data member -> names of message fields that it contains
    for flow in facts.syntax.flows:
        tables.setdefault(flow.into, []).extend(flow.sources)
    for body in facts.syntax.bodies:
        name = module_of(body, model)
        for call in body.calls if name else ():
            access = ACCESS.fullmatch(call.target)
            for place in call.args[0] if access and call.args else ():
                for row in (place, *tables.get(place, [])):
                    part = row.removeprefix(f"constant {FIELDS}::")
                    if access is not None:
                        widths[part] = access[3].lower()
                        users.setdefault((part, access[2]), {})[name] = None
    return [
        MessageField(
            part.name,
            facts.comment(part).brief,
            widths.get(part.name, ""),
            list(users.get((part.name, "write"), {})),
            list(users.get((part.name, "read"), {})),
        )
        for part in parts
    ]
