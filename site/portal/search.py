"""The search index, the cards of the modules, and the links that hand-written pages use."""

from __future__ import annotations

import html
import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from portal.glossary_terms import terms_of
from portal.links import ROOT, paper_anchor
from portal.messages import codes_by_name, messages
from portal.names import views_of
from portal.page_words import parts_of
from portal.portal import Portal
from portal.templates import SITE
from traceability.schema import Module

# Group, key, title, text and address of an entry, and then more search words. The search words of
# an answer are the words that readers type; the search words of another entry are the words of its
# text.
Entry = tuple[str, ...]
ANSWERS = "Answers"
MOST = 4000  # number of letters after which the text of a section is cut
# Group of entries -> the kind in Sphinx's inventory.
NAMED = {
    "Modules": "module",
    "Data types": "module",
    "Methods": "method",
    "Pattern applications": "pattern",
    "Requirements": "requirement",
    "Safety case": "safety",
    "Tests": "test",
    "Checks": "check",
}


# The sections of the first page that have an entry.
FIRST, SECTIONS_OF_FIRST = "index.html", {"not-shown"}
# Pages whose sections have no entries, because other entries already contain their texts.
LISTS = {
    *("answers", "tests", "source", "guide", "interfaces", "inheritances", "datatypes", "trees"),
    "structure",
    "messages",
}


def script(portal: Portal) -> str:
    """Returns the data that every page loads, as a script. A page that is opened without a server
    can load scripts, but no data files."""
    modules = {m.name: card(portal, m) for m in portal.model.modules.values()}
    tours = {tour.id: asdict(tour) for tour in portal.tours}
    data = {"commit": portal.model.commit, "modules": modules, "tours": tours}
    return assigned("PORTAL", data)


def index_script(portal: Portal, bodies: Path, site: Path) -> str:
    """Returns the search index. A page loads the index when the reader first searches."""
    parts = [*written_entries(portal, site), *section_entries(portal, bodies)]
    pages = {(group, address) for group, _, _, _, address, *_ in parts if group == "Pages"}
    found = [one for one in entries(portal) if (one[0], one[4]) not in pages] + parts
    words = dict(listed("search_words.txt", " = "))
    data = {
        "entries": [with_words(entry, words) for entry in found],
        "synonyms": listed("synonyms.txt", ","),
    }
    return assigned("PORTAL_SEARCH", data)


def with_words(entry: Entry, words: dict[str, str]) -> list[str]:
    """Returns an entry of seven parts. The sixth part contains the words of the text. The seventh
    part contains the phrases that readers type, separated by commas."""
    group, key, title, text, address, *rest = entry
    own = rest[0] if rest else ""
    typed = words.get(address, "")
    if group == ANSWERS:
        phrases = ", ".join(part for part in (own, typed) if part)
        return [group, key, title, text, address, "", phrases]
    return [group, key, title, text, address, own, typed]


def assigned(name: str, data: object) -> str:
    return f"window.{name} = {json.dumps(data, ensure_ascii=False, separators=(',', ':'))};\n"


def listed(name: str, separator: str) -> list[list[str]]:
    """For each line of a file, returns the parts between the separators. Empty lines and comments
    are left out."""
    lines = (SITE / name).read_text(encoding="utf-8").splitlines()
    used = (line for line in lines if line[:1] not in ("", "#"))
    return [[part.strip() for part in line.split(separator)] for line in used]


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
    """Returns a text without its markup and without line breaks."""
    return " ".join(text.replace("`", "").split())


def entries(portal: Portal) -> list[Entry]:
    model, links = portal.model, portal.links
    found: list[Entry] = []

    def add(group: str, key: str, title: str, text: str, address: str | None) -> None:
        if address:
            found.append((group, key, title, plain(text), address.removeprefix(ROOT)))

    for module in model.modules.values():
        text, address = module.secret or module.brief, links.module(module.name)
        add(
            "Data types" if module.datatype else "Modules", kind(module), module.name, text, address
        )
    for logic in model.logic_modules.values():
        text = f"{logic.brief.rstrip('.')}. {logic.function}"
        add("Logic modules", "", logic.name, text, links.logic(logic.id))
    for application in model.patterns.values():
        text = f"{application.pattern}. {application.title}"
        add("Pattern applications", "P", application.id, text, links.pattern(application.id))
    for requirement in model.requirements.values():
        add(
            "Requirements", "R", requirement.id, requirement.text, links.requirement(requirement.id)
        )
    for test in model.tests.values():
        add("Tests", "T", test.id, test.brief, links.test(test.id))
    for check in portal.checks.values():
        add("Checks", "", check.id, check.title, links.check(check.id))
    for path in model.files:
        add("Source", "S", path.rpartition("/")[2], path, links.file(path))
    add("Pages", "", "First page", "Weeding robot, design portal", f"{ROOT}index.html")
    for group_ in portal.navigation.groups:
        for entry in group_.entries:
            add("Pages", entry.key, entry.title, group_.title, ROOT + entry.address)
    for question in portal.questions:
        address = question.address.removeprefix(ROOT)
        found.append((ANSWERS, "", question.ask, plain(question.line), address, question.also))
    for tour in portal.tours:
        address = f"{ROOT}tours/{tour.id}.html"
        add("Pages", "", f"Tour: {tour.title}", "tutorial, getting started", address)
    others = (
        method_entries,
        message_entries,
        change_entries,
        safety_entries,
        paper_entries,
        glossary_entries,
    )
    return [*found, *(entry for make in others for entry in make(portal))]


def inventory(found: list[Entry]) -> list[list[str]]:
    """Returns the kind, name and address of each element to which other documentation may refer."""
    return [
        [NAMED[group], title, address]
        for group, _, title, _, address, *_ in found
        if group in NAMED
    ]


def method_entries(portal: Portal) -> Iterator[Entry]:
    """Yields an entry for each method that the pages show, except constructors."""
    shown = {
        method.id: method
        for module in portal.model.modules.values()
        for method in module.methods
        if method.kind != "constructor" and not (module.datatype and method.access != "public")
    }
    for method in shown.values():
        address = (portal.links.method(method.id) or "").removeprefix(ROOT)
        yield "Methods", "G", method.id, plain(method.brief), address


def message_entries(portal: Portal) -> Iterator[Entry]:
    for message in messages(portal.root):
        address = f"messages.html#{message.anchor}"
        yield "Messages", "", message.text, "Message of a command", address


def change_entries(portal: Portal) -> Iterator[Entry]:
    for change in portal.model.changes.values():
        address = portal.links.change(change.application) or ""
        title = f"Change of {change.application}"
        yield "Likely changes", "", title, change.pattern, address.removeprefix(ROOT)


def safety_entries(portal: Portal) -> Iterator[Entry]:
    """Yields the page of the hazards, and the goals, hazards and assumptions of the safety case."""
    case = portal.model.safety
    if case.hazards:
        yield "Safety case", "", "Hazards", "all hazards and their risks", "safety/hazards.html"
    titles = {one.id: one.title for one in case.goals.values()}
    titles |= {one.id: one.title for one in case.hazards.values()}
    titles |= {one.id: one.title for one in case.assumptions.values()}
    for name, title in titles.items():
        address = portal.links.safety(name) or ""
        yield "Safety case", "", name, title, address.removeprefix(ROOT)


def paper_entries(portal: Portal) -> Iterator[Entry]:
    """Yields the pictures, tables, sections and boxes of the paper, and the names that the paper
    uses."""
    page, model = "concordance.html", portal.model
    for place in model.paper_places:
        yield "Paper", "", place.id, place.title, f"{page}#{paper_anchor(place.id)}"
    for element in model.paper:
        if element.where:
            text = f"{element.kind}, {', '.join(element.where)}"
            yield "Paper", "", element.name, text, f"{page}#{paper_anchor(element.kind)}"


def glossary_entries(portal: Portal) -> Iterator[Entry]:
    for doc in portal.docs:
        source = (portal.root / f"{doc.id}.rst").read_text(encoding="utf-8")
        for term in terms_of(doc, source, portal.constants):
            yield "Glossary", "", term.title, term.text, term.address


def written_entries(portal: Portal, site: Path) -> Iterator[Entry]:
    """Yields the sections of the hand-written pages. Each section has all its words."""
    for doc in portal.docs:
        first, *others = parts_of((site / doc.address).read_text(encoding="utf-8"))
        name = doc.id.removeprefix("docs/").replace("_", " ")
        text = f"{first.text} {name}"
        yield "Explanations", "", first.title, doc.title, doc.address, text
        for part in others:
            address = f"{doc.address}#{part.anchor}"
            yield "Explanations", "", part.title, doc.title, address, part.text


def section_entries(portal: Portal, bodies: Path) -> Iterator[Entry]:
    """Yields sections of the first page, and sections of the generated pages of the navigation.
    Each section has only its first words."""
    first = bodies / FIRST
    for part in parts_of(first.read_text(encoding="utf-8")) if first.is_file() else []:
        if part.anchor in SECTIONS_OF_FIRST:
            address = f"{FIRST}#{part.anchor}"
            yield "Sections", "", part.title, "First page", address, part.text[:MOST]
    for entry in portal.navigation.entries.values():
        body = bodies / entry.address
        if entry.id in LISTS or not body.is_file():
            continue
        for part in parts_of(body.read_text(encoding="utf-8")):
            if part.anchor:
                address = f"{entry.address}#{part.anchor}"
                yield "Sections", "", part.title, entry.title, address, part.text[:MOST]
            else:
                text = part.text[:MOST]
                yield "Pages", entry.key, entry.title, part.title, entry.address, text


def targets(portal: Portal) -> dict[str, dict[str, str]]:
    """Returns the links that Sphinx roles such as ``:module:`` insert into hand-written pages: role
    -> name of an element -> HTML of the link."""
    model, links, names = portal.model, portal.links, portal.names
    methods = {
        f"{module.name}::{method.name}"
        for module in model.modules.values()
        for owner in [module.name, *links.ancestors(module.name)]
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
        "constant": portal.constants,
        "exit": {name: str(code) for name, code in codes_by_name().items()},
        "check": {name: str(names.check(name)) for name in portal.checks},
        "test": {name: str(names.test(name)) for name in model.tests},
        "source": {
            path: f'<a class="src" href="{links.file(path)}"><code>{path}</code></a>'
            for path in model.files
        },
        "view": {
            entry.id: f'<a href="{ROOT}{entry.address}">{html.escape(entry.title)}</a>'
            for entry in portal.navigation.entries.values()
        },
    }
