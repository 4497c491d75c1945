"""secret-open and secret-hidden: no module uses a name (of a header, constant, function or type)
that is private to another module."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below, texts_below
from traceability.schema import Finding, Place
from traceability.sources import DESIGN

INCLUDE = re.compile(r"\s*#\s*include\s*<([a-z_./]+)>")


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _open(model, facts)
    yield from _given_out(model, facts)
    yield from _declared_again(facts)
    yield from _hidden(model, facts)
    yield from _copied(model, facts)


def _open(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds public data members and friend declarations. A public data member lets other classes
    use a module without its interface, and a friend declaration does the same for the friend."""
    for module in model.modules.values():
        if module.datatype:
            continue
        for field in facts.classes[module.name].fields:
            if field.access == "public" and not field.constant:
                text = f"{module.name}::{field.name} is public data"
                fix = "make it private, and add an operation"
                yield Finding(field.place, "secret-open", text, fix)
    for friend in facts.syntax.friends:
        module_, other = friend.by.split("::")[0], friend.target.split("::")[0]
        if module_ != other:
            text = f"{module_} makes {other} a friend, so {other} can use its hidden members"
            fix = "remove the friend, and let the class use the interface"
            yield Finding(friend.place, "secret-open", text, fix)


def _given_out(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds public operations that return a non-const reference or pointer to a member of the
    module. With this reference or pointer, a caller could change the member. A member whose type
    contains a class of the project is left out."""
    results: dict[str, list[str]] = {}
    for flow in facts.syntax.flows:
        results.setdefault(flow.into, []).extend(flow.sources)
    for module in model.modules.values():
        fact = facts.classes[module.name]
        own = {
            f"field {module.name}::{field.name}": field.name
            for field in fact.fields
            if not field.refers and not field.constant and not field.classes
        }
        for method in [] if module.datatype else fact.methods:
            refers = re.search(r"[&*]$", method.result) and not method.result.startswith("const ")
            if method.access != "public" or not refers:
                continue
            for member in filter(None, map(own.get, results.get(f"result {method.id}", []))):
                text = f"{method.id} lets its caller change the private {member}"
                fix = "return a value, or a reference to const"
                yield Finding(method.place, "secret-open", text, fix)


def _declared_again(facts: Facts) -> Iterator[Finding]:
    """Finds source files that declare a name of another file. They should include the header that
    declares this name. A name is permitted if a linker script defines it."""
    linked = " ".join(text for _, text in texts_below(facts.root, DESIGN, (".ld",)))
    for name, place in facts.syntax.declared_again.items():
        if not re.search(rf"\b{re.escape(name)}\b", linked):
            text = f"{name} is declared here, but no header of its module declares it"
            fix = "include the header of the module, and call an operation of the module"
            yield Finding(place, "secret-open", text, fix)


@dataclass
class Hidden:
    """A name that is private to a module or to a folder, and the files that may use it."""

    name: str
    owner: str
    place: Place
    files: tuple[str, ...]

    def allows(self, file: str) -> bool:
        return file.startswith(self.files)


def _hidden(model: Model, facts: Facts) -> Iterator[Finding]:
    for hidden in _declared(model):
        uses = _uses(hidden.name, facts)
        if not any(hidden.allows(place.file) for place in uses):
            text = f"{hidden.owner} hides {hidden.name}, but does not use it"
            fix = "name a header, a constant, a function or a type of the module"
            yield Finding(hidden.place, "secret-hidden", text, fix)
            continue
        first = {(p.file, p.line): p for p in uses if not hidden.allows(p.file)}
        text = f"{hidden.name} is used here, but is a secret of {hidden.owner}"
        yield from (Finding(place, "secret-hidden", text) for place in first.values())


def _declared(model: Model) -> Iterator[Hidden]:
    for module in model.modules.values():
        stem = module.header.removesuffix(".hpp")
        for name in module.hides:
            yield Hidden(name, module.name, module.place, (f"{stem}.hpp", f"{stem}.cpp"))
    for logic in model.logic_modules.values():
        folder = str(Path(logic.place.file).parent)
        for name in logic.hides:
            yield Hidden(name, logic.id, logic.place, (f"{folder}/",))


def _uses(name: str, facts: Facts) -> list[Place]:
    """Returns the places in the code that name a header, a class or a member."""
    if name.endswith(".hpp"):
        headers = [f"{folder}/{name}" for folder in DESIGN if (facts.root / folder / name).exists()]
        return [include.place for include in facts.syntax.includes if include.target in headers]
    if name in facts.classes:
        own = facts.classes[name].place
        return [own, *(use.place for use in facts.syntax.names if use.target == name)]
    owner, _, member = name.rpartition("::")
    fields = facts.classes[owner].fields if owner in facts.classes else []
    places = [field.place for field in fields if field.name == member]
    places += [
        use.place
        for use in facts.syntax.names
        if use.member in (name, member) and (use.member == name or use.target == owner)
    ]
    places += [body.place for body in facts.bodies.get(name, [])]
    return places or [  # a header of the standard library
        place
        for place, line in lines_below(facts.root, DESIGN, (".cpp", ".hpp"))
        if (match := INCLUDE.match(line)) and match[1] == name
    ]


def _copied(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds copies of a private constant: a constant in another file has the same value and a
    similar name."""
    values = {(value.place.file, value.place.line): value for value in facts.syntax.values}
    for hidden in _declared(model):
        numbers = {each.number for each in facts.syntax.values if each.name == hidden.name}
        for other in values.values():
            outside = other.number > 1 and not hidden.allows(other.place.file)
            if outside and other.number in numbers and _is_similar(hidden.name, other.name):
                text = (
                    f"the values of {other.name} and {hidden.name} are equal and their names are "
                    f"similar, but {hidden.name} is a secret of {hidden.owner}"
                )
                fix = f"call an operation of {hidden.owner}, or use a different name here"
                yield Finding(other.place, "secret-hidden", text, fix)


def _is_similar(name: str, other: str) -> bool:
    """Returns whether one of two names contains all words of the other name, for example kGroup and
    kSampleGroup."""
    words, others = (
        set(re.findall(r"[A-Z][a-z]*|\d+", part.rpartition("::")[2])) for part in (name, other)
    )
    return bool(words and others) and (words <= others or others <= words)
