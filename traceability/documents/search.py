"""The search index, the cards of the modules, and the targets of hand-written pages."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Iterator

from traceability.documents.links import ROOT, paper_anchor
from traceability.documents.module_page import ancestors
from traceability.documents.names import views_of
from traceability.documents.portal import Portal
from traceability.documents.sections import sections_of
from traceability.model.schema import Model, Module

# Group, key, title, text, address; then what is found too, and shown only where it is found.
Entry = tuple[str, ...]


def script(portal: Portal) -> str:
    """A script, so that it can be read without a server."""
    data = {
        "commit": portal.model.commit,
        "modules": {m.name: card(portal, m) for m in portal.model.modules.values()},
        "entries": [list(entry) for entry in entries(portal)],
    }
    return f"window.PORTAL = {json.dumps(data, ensure_ascii=False, separators=(',', ':'))};\n"


def card(portal: Portal, module: Module) -> dict[str, object]:
    logic = portal.model.logic_modules.get(module.logic)
    return {
        "kind": kind(module),
        "logic": logic.name if logic else module.logic,
        "secret": plain(module.secret or module.brief),
        "roles": [[role.role, role.application] for role in module.roles],
        "views": "" if module.datatype else "".join(sorted(views_of(module, portal.names.called))),
        "url": (portal.links.module(module.name) or "").removeprefix(ROOT),
    }


def kind(module: Module) -> str:
    if module.datatype:
        return "d"
    return "a" if module.abstract else "c"


def plain(text: str) -> str:
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", "", text))).strip()


def entries(portal: Portal) -> list[Entry]:
    model, links = portal.model, portal.links
    found: list[Entry] = []

    def add(group: str, key: str, title: str, text: str, address: str | None) -> None:
        if address:
            found.append((group, key, title, plain(text), address.removeprefix(ROOT)))

    for module in model.modules.values():
        group = "Data types" if module.datatype else "Modules"
        add(
            group,
            kind(module),
            module.name,
            module.secret or module.brief,
            links.module(module.name),
        )
    for logic in model.logic_modules.values():
        add("Logic modules", "", logic.name, logic.brief, links.logic(logic.id))
    for application in model.patterns.values():
        text = f"{application.pattern}. {application.title}"
        add("Pattern applications", "P", application.id, text, links.pattern(application.id))
    for requirement in model.requirements.values():
        add(
            "Requirements", "R", requirement.id, requirement.text, links.requirement(requirement.id)
        )
    seen: set[str] = set()
    for module in model.modules.values():
        for method in module.methods:
            if method.access == "public" and method.kind != "constructor" and method.id not in seen:
                seen.add(method.id)
                add("Methods", "G", method.id, method.brief, links.method(method.id))
    for test in model.tests.values():
        add("Tests", "T", test.id, test.brief, links.test(test.id))
    for check in portal.checks.values():
        add("Checks", "", check.id, check.title, links.check(check.id))
    for path in model.files:
        add("Source", "S", path.rpartition("/")[2], path, links.file(path))
    for group_ in portal.navigation.groups:
        for entry in group_.entries:
            add("Pages", entry.key, entry.title, group_.title, ROOT + entry.address)
    return [*found, *safety_entries(portal), *paper_entries(model), *written_entries(portal)]


def safety_entries(portal: Portal) -> Iterator[Entry]:
    """The goals, hazards and assumptions of the safety case."""
    case = portal.model.safety
    titles = {one.id: one.title for one in case.goals.values()}
    titles |= {one.id: one.title for one in case.hazards.values()}
    titles |= {one.id: one.title for one in case.assumptions.values()}
    for name, title in titles.items():
        address = portal.links.safety(name) or ""
        yield "Safety case", "", name, title, address.removeprefix(ROOT)


def paper_entries(model: Model) -> Iterator[Entry]:
    """The places of the paper, and what it names there."""
    page = "concordance.html"
    for place in model.paper_places:
        yield "Paper", "", place.id, place.title, f"{page}#{paper_anchor(place.id)}"
    for element in model.paper:
        if element.where:
            text = f"{element.kind}, {', '.join(element.where)}"
            yield "Paper", "", element.name, text, f"{page}#{paper_anchor(element.kind)}"


def written_entries(portal: Portal) -> Iterator[Entry]:
    """The sections of the hand-written pages, with all their words."""
    for doc in portal.docs:
        source = (portal.root / "docs" / f"{doc.name}.rst").read_text(encoding="utf-8")
        for section in sections_of(doc, source):
            yield "Explanations", "", section.title, doc.title, section.address, section.text


def targets(portal: Portal) -> dict[str, dict[str, str]]:
    """For each role of the hand-written pages: name to HTML."""
    model, links, names = portal.model, portal.links, portal.names
    methods = {
        f"{module.name}::{method.name}"
        for module in model.modules.values()
        for owner in [module.name, *ancestors(portal, module)]
        if owner in model.modules
        for method in model.modules[owner].methods
    }
    return {
        "module": {name: str(names.mod(name)) for name in model.modules},
        "logic": {
            key: str(names.logic(logic.id))
            for logic in model.logic_modules.values()
            for key in (logic.id, logic.name)
        },
        "method": {name: str(names.meth(name)) for name in sorted(methods)},
        "requirement": {name: str(names.req(name)) for name in model.requirements},
        "safety": {
            name: str(names.safety(name))
            for items in (model.safety.goals, model.safety.hazards, model.safety.assumptions)
            for name in items
        },
        "pattern": {name: str(names.pat(name)) for name in model.patterns},
        "check": {name: str(names.check(name)) for name in portal.checks},
        "test": {name: str(names.test(name)) for name in model.tests},
        "source": {
            path: f'<a class="src" href="{links.file(path)}"><code>{path}</code></a>'
            for path in model.files
        },
        "view": {
            entry.id: f'<a href="{ROOT}{entry.address}">{html.escape(entry.title)}</a>'
            for group in portal.navigation.groups
            for entry in group.entries
        },
    }
