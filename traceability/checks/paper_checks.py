"""paper-*: the concordance with the paper is complete and correct."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from pathlib import Path

from traceability.checks.link_checks import has_page
from traceability.checks.registry import KNOWN
from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, PaperElement

# kinds of elements whose names in the code must equal the names in the paper
EXACT = ("module", "method", "state", "application")
COUNT, CONSTANT = "figure-of-design", "constant"


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _complete(model, facts)
    for entry in model.paper:
        yield from _stale(entry, model, facts)
        yield from _alias(entry, model, facts)
        yield from _figure(entry, facts)
    yield from _statements(model, facts)
    yield from _unstated(model)


def _statements(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds statements of the paper with a wrong entry: the paper has no such place, the named
    answer does not exist, or the entry has neither an answer nor a deviation."""
    places = {place.id for place in model.paper_places}
    for statement in model.statements:
        texts = [
            (f"the answer {target} of the statement does not exist", target)
            for target in statement.here
            if not exists(target, model, facts)
        ]
        if statement.where not in places:
            texts.append((f"the paper has no place {statement.where}", "place"))
        if not statement.here and not statement.deviation:
            texts.append(("the statement has neither an answer nor a deviation", "says"))
        for text, word in texts:
            line = facts.line_in(statement.place, word)
            yield Finding(line, "paper-statement", text)


def _unstated(model: Model) -> Iterator[Finding]:
    """Finds requirements whose source is a place of the paper, if no statement of this place lists
    the requirement in ``here``."""
    answered = {
        (statement.where, target) for statement in model.statements for target in statement.here
    }
    for requirement in model.requirements.values() if model.statements else ():
        for source in requirement.sources:
            pair = (source.name, f"requirement:{requirement.id}")
            if source.kind == "paper" and pair not in answered:
                text = f"{requirement.id} is named in no statement of {source.name} of the paper"
                yield Finding(requirement.place, "paper-statement", text)


def _complete(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds elements of the paper that have no entry or several entries in the concordance. Also
    finds entries for elements that design/paper.toml does not list."""
    concordance = facts.declared.concordance
    entries: dict[tuple[str, str], PaperElement] = {}
    for entry in model.paper:
        key = (entry.kind, entry.name)
        if key in entries:
            text = f"the concordance has a second entry for the {entry.kind} {entry.name}"
            yield Finding(entry.place, "paper-complete", text, "remove one of the two entries")
        elif key not in concordance.named:
            text = f"design/paper.toml lists no {entry.kind} {entry.name}"
            yield Finding(entry.place, "paper-complete", text)
        entries[key] = entry
    for key, place in concordance.lines.items():
        if key not in entries:
            text = f"the {key[0]} {key[1]} of the paper has no entry in the concordance"
            yield Finding(place, "paper-complete", text)
    for entry in model.paper:
        if not entry.here and not entry.deviation:
            said = f"the entry of the {entry.kind} {entry.name}"
            text = f"{said} names neither a counterpart nor a deviation"
            fix = "name the counterpart in this project, or write a deviation with the reason"
            yield Finding(entry.place, "paper-complete", text, fix)
    yield from _arrows(model)


def _arrows(model: Model) -> Iterator[Finding]:
    """Finds arrows of the high-level diagram that are in no entry of the concordance."""
    said = {target.partition(":")[2] for entry in model.paper for target in entry.here}
    fix = "correct the arrow, or name it in the entry of Figure 5 and write the reason as deviation"
    for connection in model.connections:
        if model.paper and connection.arrow not in said:
            text = f"the arrow {connection.arrow} is named in no entry of the concordance"
            yield Finding(connection.place, "paper-complete", text, fix)


def _stale(entry: PaperElement, model: Model, facts: Facts) -> Iterator[Finding]:
    for target in entry.here:
        if not exists(target, model, facts):
            named = f"the paper's {entry.kind} {entry.name}"
            text = f"{named} is linked to {target}, which does not exist"
            yield Finding(facts.line_in(entry.place, target), "paper-stale", text)


def exists(target: str, model: Model, facts: Facts) -> bool:
    """Returns whether the target of an entry exists in the model, for example "module:Wheel". For a
    generated page, always returns true, because check_pages() looks for these pages in the site."""
    kind, _, name = target.partition(":")
    if kind == "method":
        owner, _, method = name.partition("::")
        return owner in model.modules and facts.method(owner, method) is not None
    if kind == "docs":
        return (facts.root / "docs" / f"{name}.rst").exists()
    names_of: dict[str, Collection[str]] = {
        "check": KNOWN,
        "module": model.modules,
        "pattern": model.patterns,
        "change": model.patterns,
        "machine": model.machines,
        "requirement": model.requirements,
        "logic": model.logic_modules,
        "element": {element.id for element in model.architecture},
        "arrow": {connection.arrow for connection in model.connections},
    }
    return kind == "view" or name in names_of.get(kind, {})


def _alias(entry: PaperElement, model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds a name that differs from the name in the paper although the entry gives no reason. Also
    finds an entry that gives a reason although both names are equal."""
    if entry.kind not in EXACT or not entry.here:
        return
    same = entry.name in {_name_here(target, model) for target in entry.here}
    if same and entry.alias:
        text = (
            f"{entry.name} has the same name here as in the paper, but its entry gives a reason "
            "for a different name"
        )
        yield Finding(entry.place, "paper-alias", text, "remove the alias")
    elif not same and not entry.alias:
        named = f"the paper's {entry.name} is named {' and '.join(entry.here)} here"
        yield Finding(entry.place, "paper-alias", f"{named}, but its entry has no alias")
    elif entry.alias and entry.kind == "module" and entry.name in facts.classes:
        text = f"the code has a class {entry.name}, but the entry states another name for it"
        yield Finding(entry.place, "paper-alias", text, "name that class, and remove the alias")


def _figure(entry: PaperElement, facts: Facts) -> Iterator[Finding]:
    """Compares the numbers in the paper with this project: the number of modules and applications,
    and the values of constants."""
    if entry.kind == COUNT:
        key, text = "name", entry.name
        counts = {"module": facts.modules, "application": facts.declared.applications}
        true = {str(len(things)) for word, things in counts.items() if word in entry.name}
    elif entry.kind == CONSTANT:
        key, text = "note", entry.note
        methods = [name.partition(":")[2] for name in entry.here if name.startswith("method:")]
        true = {number for method in methods for number in _returned(method, facts)}
    else:
        return
    said = re.search(r"\d+", text)
    if said and true and said[0] not in true:
        has = " or ".join(sorted(true, key=int))
        text = f"the paper has the number {said[0]} for {entry.name}, but this project has {has}"
        fix = "correct the number, or the design"
        yield Finding(facts.line_in(entry.place, key), "paper-stale", text, fix)


def _returned(method: str, facts: Facts) -> Iterator[str]:
    """Yields the numbers that the `return` statements of a method contain."""
    for body in facts.bodies.get(method, []):
        lines = facts.lines_of(body.place.file)[body.place.line - 1 : body.end]
        yield from re.findall(r"\breturn (\d+);", "\n".join(lines))


def _name_here(target: str, model: Model) -> str:
    """Returns the name that a target has in this project. A pattern application is named by its
    title."""
    kind, _, name = target.partition(":")
    application = model.patterns.get(name) if kind == "pattern" else None
    return application.title if application else name


def check_pages(model: Model, facts: Facts, site: Path) -> Iterator[Finding]:
    """The concordance and the statements have links to pages and anchors. Finds each link whose
    page or anchor is not in the built site."""
    named = [
        (entry.place, target, "paper-stale", f"the paper's {entry.kind} {entry.name}")
        for entry in model.paper
        for target in entry.here
    ] + [
        (statement.place, target, "paper-statement", f"a statement of {statement.where}")
        for statement in model.statements
        for target in statement.here
    ]
    for place, target, check, what in named:
        if target.startswith("view:") and not has_page(site, _page_of(target)):
            text = f"{what} is linked to {target}, which is not a page"
            yield Finding(facts.line_in(place, target), check, text)


def _page_of(target: str) -> str:
    page, mark, anchor = target.removeprefix("view:").partition("#")
    return f"{page}.html{mark}{anchor}"
