"""Makes the list of all pages. Also makes pages that show all elements of a kind, such as all
tests."""

from __future__ import annotations

import functools
import json
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import Any

from docutils.nodes import make_id
from markupsafe import Markup

from portal.bench_page import bench
from portal.bytes_page import follow_bytes
from portal.cycle_page import cycle
from portal.diagrams import DIAGRAMS, role_family
from portal.dossier import dossier, dossier_page
from portal.layers import ANY, layers
from portal.links import logic_anchor
from portal.live_view import run
from portal.measured_pages import (
    closed_loop,
    made_changes,
    mutation,
    robustness,
    usual_design,
    virtual_k64,
)
from portal.messages import codes_by_name, messages
from portal.module_page import module_page
from portal.paper_views import change_page, concordance, families, hidden_names
from portal.portal import Page, Portal
from portal.recording_page import plotted
from portal.requirement_pages import aligned, first_run, requirement_page, requirements, sections
from portal.safety_pages import cost, goal_page, hazards_page, safety
from portal.search import entries
from portal.sequences import sequences
from portal.source_pages import folders, source_page
from portal.tuning_page import tuning
from portal.verification_views import Facets, facets_of_test, options
from traceability.exports.tool_files import available
from traceability.grouping import grouped
from traceability.model.made_changes import proven
from traceability.model.metrics import driver_lines
from traceability.model.not_shown import by_method, not_shown
from traceability.model.orphan_methods import methods_without, tests_without
from traceability.reading import closed_loop_record
from traceability.reading.bench_record import SCENARIOS
from traceability.reading.products import DEFAULT, FUNCTIONS, PRODUCTS, RECORDED
from traceability.reading.source_lines import headings
from traceability.schema import (
    Method,
    Module,
    PatternApplication,
    Place,
    Requirement,
    TreeNode,
)

# The page of a pattern application lists the roles by family. The families are in this order.
FAMILY_ORDER = ("abstraction", "decorator", "concrete", "context", "target")
EXAMPLE = "FR-15"  # requirement that the first page shows as an example


def all_pages(portal: Portal, part: int = 0, parts: int = 1) -> Iterator[Page]:
    """Yields one part of the pages. ``part`` is the number of this part, and ``parts`` is the
    number of all parts. Several processes build the parts."""
    for make in islice(_makers(portal), part, None, parts):
        yield make()


def _makers(portal: Portal) -> Iterator[Callable[[], Page]]:
    model = portal.model
    elements: list[tuple[Iterable[Any], Callable[[Portal, Any], Page]]] = [
        (model.files, source_page),
        (model.changes.values(), change_page),
        (model.safety.goals.values(), goal_page),
        (portal.designs, module_page),
        (model.patterns.values(), pattern_page),
        (model.requirements.values(), requirement_page),
        (model.requirements.values(), dossier_page),
    ]
    for shown, page_of in elements:
        yield from (partial(page_of, portal, element) for element in shown)
    yield partial(home_page, portal)
    for name in portal.navigation.entries:
        if not name.startswith("docs/"):
            yield partial(portal.view, name, view_of(name))
    for question in portal.questions:
        values = {"question": question, "titles": page_titles(portal)}
        yield partial(portal.page, question.page, question.ask, "answers", "answer", **values)
    for tour in portal.tours:
        values = {"tour": tour, "titles": page_titles(portal)}
        yield partial(portal.page, f"tours/{tour.id}", f"Tour: {tour.title}", "", "tour", **values)
    if model.safety.goals:
        yield partial(hazards_page, portal)
    for check in portal.checks.values():
        yield partial(portal.page, f"checks/{check.id}", check.id, "checks", "check", check=check)


@functools.cache
def page_titles(portal: Portal) -> dict[str, str]:
    """Returns the title of the page, section or element at each address."""
    titles = {address: title for _, _, title, _, address, *_ in reversed(entries(portal))}
    sections = {
        f"docs/{path.stem}.html#{make_id(title)}": title
        for path in sorted((portal.root / "docs").glob("*.rst"))
        for title in headings(path)
    }
    return sections | titles


def view_of(name: str) -> Callable[[Portal], dict[str, Any]]:
    """Returns the function that computes the values for the template of a navigation entry."""
    if name not in VIEWS:
        raise LookupError(f"VIEWS in site/portal/pages.py has no value for the entry {name}")
    return VIEWS[name]


def home_page(portal: Portal) -> Page:
    example = portal.model.requirements.get(EXAMPLE)
    method = best_method(portal, example) if example and example.tree else None
    return portal.page(
        "index",
        "The weeding robot's microcontroller software",
        "home",
        "home",
        example=example,
        by_method=by_method(portal.model, portal.report),
        limits=not_shown(portal.model, portal.report),
        method=method,
        tours=[tour.id for tour in portal.tours],
        paper_most=max(paper.maximum for paper in SCENARIOS),
        proven=proven,
        shown_changes=sorted(
            portal.model.changes.values(), key=lambda change: not proven(change.made)
        )[:6],
        rows=aligned(portal, example, first_run(example))[:14] if example else [],
    )


def best_method(portal: Portal, requirement: Requirement) -> Method | None:
    """Searches the invocation tree from its end for a method that satisfies the requirement.
    Returns the first method that it finds. If there is no such method, returns the last method of
    the tree. Methods without a body are skipped."""
    nodes = reversed(portal.nodes(requirement))
    methods = [m for m in (real_method(portal, node) for _, node in nodes) if m]
    satisfying = [m for m in methods if requirement.id in m.satisfies]
    return next(iter([*satisfying, *methods]), None)


def real_method(portal: Portal, node: TreeNode) -> Method | None:
    method = portal.links.find_method(node.resolved or f"{node.module}::{node.method}")
    return method if method and method.body else None


def products(portal: Portal) -> dict[str, Any]:
    measured = portal.model.products
    module_sets = [set(product.modules) for product in (measured or {}).values()]
    common = set.intersection(*module_sets) if module_sets else set()
    return {
        "listed": PRODUCTS,
        "functions": FUNCTIONS,
        "products": measured,
        "rows": sorted(set().union(*module_sets) - common),
        "common": sorted(common),
    }


def reverse_rows(portal: Portal) -> list[tuple[str, int, int]]:
    """Returns a row for the public methods and a row for the tests. A row contains the number of
    these items, and the number of items without a requirement."""
    modules = portal.model.modules.values()
    methods = [m for item in modules if not item.datatype for m in item.methods]
    public = sum(method.access == "public" for method in methods)
    return [
        ("method", public, len(methods_without(portal.model))),
        ("test", len(portal.model.tests), len(tests_without(portal.model))),
    ]


def pattern_page(portal: Portal, application: PatternApplication) -> Page:
    machines = [m for m in portal.model.machines.values() if m.application == application.id]
    modules = dict.fromkeys(r.module for r in application.roles if r.module in portal.model.modules)
    return portal.page(
        f"patterns/{application.id}",
        application.id,
        "patterns",
        "pattern",
        application=application,
        roles=sorted(
            application.roles, key=lambda binding: FAMILY_ORDER.index(role_family(binding.role))
        ),
        machines=machines,
        modules=[portal.model.modules[name] for name in modules],
        kin=[a for a in portal.model.patterns.values() if a.pattern == application.pattern],
    )


def execution(portal: Portal) -> dict[str, Any]:
    """Returns the values for the page of execution contexts, such as interrupts and threads. The
    context with the highest priority is the first. A context without a priority, such as the
    program after a reset, is at the end."""
    contexts = portal.model.contexts.values()
    ordered = sorted(
        contexts, key=lambda context: (context.priority is None, context.priority or 0)
    )
    lanes = [
        {"id": one.id, "name": one.name, "lines": one.lines, "priority": one.priority}
        for one in ordered
        if one.priority is not None
    ]
    times = portal.model.times
    bounds = times.contexts if times else []
    machines = portal.model.machines.values()
    return {
        "contexts": ordered,
        "responses": {bound.context: bound.response_ms for bound in bounds},
        "lane_data": Markup(json.dumps(lanes)),
        "state_modules": sorted({name for one in machines for name in one.states.values()}),
        "image": DEFAULT,
        "measured_product": closed_loop_record.PRODUCT,
        "wide": True,
    }


def tests(portal: Portal) -> dict[str, Any]:
    modules = modules_of_tests(portal)
    facets = {
        test.id: facets_of_test(test, portal.model, modules.get(test.id, []))
        for test in portal.model.tests.values()
    }
    return {"suites": suites(portal), "facets": facets, "options": options(facets.values())}


def modules_of_tests(portal: Portal) -> dict[str, list[str]]:
    """Each module has a list of tests to read first. For each test, returns the modules with this
    test in their list."""
    modules: dict[str, list[str]] = {}
    for name in sorted(portal.model.modules):
        for test in portal.own_tests(portal.model.modules[name]):
            modules.setdefault(test.id, []).append(name)
    return modules


def trees(portal: Portal) -> dict[str, Any]:
    """Returns the invocation trees of each section of the requirements. Also returns the values
    that each tree has for the filters of the page."""
    facets: dict[str, Facets] = {}
    shown = [one for one in portal.model.requirements.values() if one.tree]
    for requirement in shown:
        modules = {node.module for _, node in portal.nodes(requirement)}
        seen = list(requirement.runs) or ["in no test"]
        known = sorted(modules & set(portal.model.modules))
        facets[requirement.id] = {"seen": seen, "module": known}
    return {
        "sections": sections(shown),
        "facets": facets,
        "options": options(facets.values()),
    }


def suites(portal: Portal) -> dict[str, list[str]]:
    return grouped(portal.model.tests, lambda name: portal.model.tests[name].suite)


@dataclass
class UseRow:
    """A use of a logic module by another logic module. ``why`` is the reason why the design allows
    the use. ``places`` is the number of places in the code with this use. ``first`` lists at most
    two of these places."""

    source: str
    target: str
    why: str | None
    places: int
    first: list[Place]


def use_rows(portal: Portal) -> list[UseRow]:
    """Returns a row for each use that the design allows or that the code contains."""
    allowed = {(use.source, use.target): use.why for use in portal.model.allowed_uses}
    actual = {(use.source, use.target): use.places for use in portal.model.uses}
    pairs = {pair for pair in allowed if pair[0] != ANY} | set(actual)
    return [
        UseRow(
            *pair,
            allowed.get(pair, allowed.get((ANY, pair[1]))),
            len(actual.get(pair, [])),
            [*actual.get(pair, [])][:2],
        )
        for pair in sorted(pairs)
    ]


def uses(portal: Portal) -> dict[str, Any]:
    """Returns the uses as rows and as the cells of a matrix. The matrix lists the logic modules in
    the order of the module structure."""
    rows = use_rows(portal)
    named = {name for row in rows for name in (row.source, row.target)}
    return {
        "rows": rows,
        "labels": short_names(
            [name for name in portal.model.logic_modules if name in named], portal
        ),
        "cells": {(row.source, row.target): row for row in rows},
        "layers": layers(portal.model.allowed_uses),
        "wide": True,
    }


def short_names(identifiers: list[str], portal: Portal) -> dict[str, str]:
    """Returns the name of each logic module. If several logic modules have the same name, each of
    these names begins with the name of the parent."""
    logic_modules = portal.model.logic_modules
    count = Counter(logic_modules[identifier].name for identifier in identifiers)

    def name(identifier: str) -> str:
        parent = logic_modules[identifier].parent
        own = logic_modules[identifier].name
        return f"{logic_modules[parent].name}/{own}" if parent and count[own] > 1 else own

    return {identifier: name(identifier) for identifier in identifiers}


def groups(portal: Portal) -> dict[str, Any]:
    return {"groups": [m for m in portal.model.logic_modules.values() if m.modules]}


def structure(portal: Portal) -> dict[str, Any]:
    modules: dict[str, list[Module]] = defaultdict(list)
    for module in portal.designs:
        parts = module.logic.split("/")
        for count in range(1, len(parts) + 1):
            modules["/".join(parts[:count])].append(module)
    return {
        "tops": portal.top_logic_modules,
        "anchor": logic_anchor,
        "below": modules.__getitem__,
        "wide": True,
    }


# The pages of the navigation, each with the values that its template needs besides the model.
VIEWS: dict[str, Callable[[Portal], dict[str, Any]]] = {
    "answers": lambda portal: {
        "topics": grouped(portal.questions, lambda question: question.topic)
    },
    **dict.fromkeys(
        (
            "build_evidence",
            "differences",
            "patterns",
            "machines",
            "proofs",
            "datatypes",
            "beliefs",
            "checks",
            "drift",
        ),
        lambda _: {},
    ),
    "architecture": lambda _: {"wide": True},
    "messages": lambda portal: {"messages": messages(portal.root), "codes": codes_by_name()},
    "changes": made_changes,
    "structure": structure,
    "secrets": lambda portal: {**groups(portal), "hidden_names": hidden_names},
    "guide": groups,
    "interfaces": groups,
    "inheritances": lambda portal: {"families": families(portal)},
    "products": products,
    "trees": trees,
    "uses": uses,
    "concordance": concordance,
    "usual_design": usual_design,
    "execution": execution,
    "cycle": cycle,
    "bytes": follow_bytes,
    "sequences": sequences,
    "safety": safety,
    "safety_cost": cost,
    "requirements": requirements,
    "dossier": dossier,
    "tests": tests,
    "mutation": mutation,
    "robustness": robustness,
    "reverse": lambda portal: {
        "rows": reverse_rows(portal),
        "lines": driver_lines(portal.model),
        "recorded": RECORDED,
    },
    "closed_loop": closed_loop,
    "bench": bench,
    "virtual_k64": virtual_k64,
    "source": lambda portal: {"folders": folders(portal)},
    "exports": lambda portal: {
        "folder": DIAGRAMS,
        "files": available(portal.root),
    },
    "run": run,
    "plot": plotted,
    "tuning": tuning,
}
