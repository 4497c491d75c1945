"""Pages for views of the paper: likely changes, secrets, interface inheritances, concordance."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from markupsafe import Markup

from portal import names
from portal.links import ROOT, paper_anchor
from portal.portal import Page, Portal
from traceability.grouping import grouped
from traceability.reading.products import DEFAULT, PAPER
from traceability.schema import LikelyChange, LogicModule, Method, Module

CONSTANT = re.compile(r"k[A-Z]\w*")
ROLE_CHECKS = ("module-count", "pattern-subclass-unbound")  # for a change that adds a module
MACHINE_CHECKS = ("fsm-declared", "fsm-code", "fsm-seen", "proof-model")  # for a new state
COMMON_CHECKS = ("module-secret", "module-spec", "uses-allowed", "req-verified", "tree-static")


# ---- likely changes ----------------------------------------------------------


def change_page(portal: Portal, change: LikelyChange) -> Page:
    application = portal.model.patterns[change.application]
    return portal.page(
        f"changes/{change.application}",
        f"Change: {application.title}",
        "changes",
        "change",
        change=change,
        application=application,
        hider=portal.model.modules[change.hidden_by],
        steps=[filled(step, change) for step in change.steps],
        untouched=grouped(change.untouched, lambda name: portal.model.modules[name].logic),
        tests=[portal.model.tests[name] for name in change.tests],
        checks=checks_of(portal, change),
        compared=compared(portal, change),
    )


@dataclass(frozen=True)
class Compared:
    """Two products, without and with an extension, and a scenario that shows the difference."""

    extension: str
    before: str
    after: str
    scenario: str


COMPARED = (
    Compared("bluetooth", "weeding_robot_pc", "weeding_robot_pc_bluetooth", "loss_of_the_pc"),
    Compared("safety", PAPER, DEFAULT, "hall_dead"),
    Compared("warning", PAPER, "weeding_robot_warning", "loss_of_the_pc"),
)


def compared(portal: Portal, change: LikelyChange) -> Compared | None:
    """Returns the products without and with the extension that makes the change, or None if no
    extension makes the change."""
    by_extension = {f"extensions/{pair.extension}": pair for pair in COMPARED}
    examples = (portal.model.modules[name].logic for name in change.examples)
    made = (change.made.extension,) if change.made else ()
    return next(
        (by_extension[example] for example in (*examples, *made) if example in by_extension), None
    )


def filled(step: str, change: LikelyChange) -> str:
    values = {
        "{id}": change.application,
        "{derives}": " or ".join(f"`{name}`" for name in change.derives),
        "{edits}": ", ".join(f"`{name}`" for name in change.edits) or "a composition",
    }
    for mark, value in values.items():
        step = step.replace(mark, value)
    return step


def checks_of(portal: Portal, change: LikelyChange) -> list[str]:
    """Returns the checks that a new module must pass when this change is made: the checks for every
    new module, the checks of the state machines for a new state, and the clauses of the pattern."""
    pattern = portal.model.patterns[change.application].pattern.lower().replace(" ", "-")
    prefix = f"pattern-{pattern.partition('-')[0]}-"
    clauses = [name for name in portal.checks if name.startswith(prefix)]
    roles = ROLE_CHECKS if change.role else ()
    machines = MACHINE_CHECKS if change.pattern == "State" else ()
    names_of_checks = (*COMMON_CHECKS, *roles, *machines, *clauses)
    return [name for name in names_of_checks if name in portal.checks]


# ---- secrets -----------------------------------------------------------------


def hidden_names(owner: Module | LogicModule) -> dict[str, list[str]]:
    """Returns the hidden names of a module or of a folder, by kind."""
    registers = list(owner.registers) if isinstance(owner, Module) else []
    return ({"registers": registers} if registers else {}) | grouped(owner.hides, kind_of)


def kind_of(name: str) -> str:
    if name.endswith(".hpp"):
        return "headers"
    return "constants" if CONSTANT.fullmatch(name.rpartition("::")[2]) else "types"


# ---- interface inheritances --------------------------------------------------


@dataclass
class FamilyMember:
    """A module in a family of subclasses. Its methods are divided into new methods (``own``),
    overridden methods, and methods that it inherits unchanged."""

    module: Module
    depth: int
    own: list[Method]
    overridden: list[Method]
    inherited: list[Method]


def families(portal: Portal) -> list[list[FamilyMember]]:
    """Returns a family for each class that has subclasses and is not derived from a module."""
    modules = portal.model.modules
    roots = [m for m in portal.designs if any(h in modules for h in m.subclasses)]
    return [
        list(family_members(portal, root, 0, []))
        for root in roots
        if not any(base in modules for base in root.bases)
    ]


def family_members(
    portal: Portal, module: Module, depth: int, above: list[Method]
) -> Iterator[FamilyMember]:
    """Yields the module and all its subclasses. ``above`` contains the methods that the module
    inherits."""
    methods = [m for m in unique(module.methods) if m.access == "public" or m.kind != "plain"]
    methods = [m for m in methods if m.kind != "constructor" and m.name[0] != "~"]
    inherited = {method.name for method in above}
    overridden = [m for m in methods if m.name in inherited]
    own = [m for m in methods if m.name not in inherited]
    names_here = {m.name for m in methods}
    taken = [m for m in above if m.name not in names_here]
    yield FamilyMember(module, depth, own, overridden, taken)
    for subclass in portal.designs:
        if module.name in subclass.bases:
            yield from family_members(portal, subclass, depth + 1, [*taken, *methods])


def unique(methods: Iterable[Method]) -> list[Method]:
    return list({method.name: method for method in methods}.values())


# ---- concordance -------------------------------------------------------------


def concordance(portal: Portal) -> dict[str, Any]:
    model = portal.model
    by_key = {(element.kind, element.name): element for element in model.paper}
    places = [(place, by_key.get((place.kind, place.id))) for place in model.paper_places]
    own = {id(element) for _, element in places}
    others = (element for element in model.paper if id(element) not in own)
    kinds = grouped(others, lambda element: element.kind)
    back = {m.name: paper_names for m in portal.designs if (paper_names := portal.in_paper(m.name))}
    return {
        "places": places,
        "kinds": sorted(kinds.items()),
        "back": back,
        "rows": len(model.paper) + len(model.statements) + len(back),
        "target": partial(target_link, portal),
        "slug": paper_anchor,
    }


def target_link(portal: Portal, target: str) -> Markup:
    """Returns a link to an element of this project. ``target`` is from an entry of the concordance,
    and names this element."""
    kind, _, name = target.partition(":")
    makers: dict[str, Callable[[str], Markup]] = {
        "module": portal.names.mod,
        "method": portal.names.meth,
        "pattern": portal.names.pat,
        "change": portal.names.change,
        "requirement": portal.names.req,
        "logic": portal.names.logic,
        "check": portal.names.check,
    }
    if kind in makers:
        return makers[kind](name)
    address, title = page_of(portal, kind, name)
    return names.anchor(address, title)


def page_of(portal: Portal, kind: str, name: str) -> tuple[str | None, str]:
    """Returns the address and the title of an element that has no separate page."""
    model = portal.model
    if kind == "machine":
        machine = model.machines.get(name)
        return portal.links.machine(name), machine.title if machine else name
    if kind == "arrow":
        return f"{ROOT}architecture.html#high-level", name
    if kind == "element":
        drawn = {element.id: element.name for element in model.architecture}
        address = f"{ROOT}architecture.html#{name}" if name in drawn else None
        return address, drawn.get(name, name)
    page, _, part = (f"docs/{name}" if kind == "docs" else name).partition("#")
    address = f"{page}.html"
    entries = portal.navigation.entries.values()
    titles = {entry.address: entry.title for entry in entries} | {"index.html": "First page"}
    title = titles.get(address, page)
    return f"{ROOT}{address}{'#' + part if part else ''}", f"{title}, {part}" if part else title
