"""The pages of the portal, one function for each kind."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from itertools import islice
from pathlib import Path

from traceability.documents import calls, plots, verification
from traceability.documents.bench_page import bench_page
from traceability.documents.exports import DIAGRAMS
from traceability.documents.links import logic_anchor
from traceability.documents.paper_views import paper_views
from traceability.documents.portal import Page, Portal
from traceability.metrics import read_products
from traceability.model import usual_design
from traceability.model.mutation import mutants_of
from traceability.model.reverse import methods_without, tests_without
from traceability.model.schema import (
    HOST,
    Method,
    MethodCoverage,
    Module,
    PatternApplication,
    Place,
    Requirement,
    StateMachine,
    TreeNode,
    TreeRun,
)
from traceability.products import PRODUCTS

FIRST_TESTS = 12  # shown open on the page of a module
TORTURE = "tests/torture/"
XML = "build/model/xml"
HIGH_LEVEL = "High-level diagram"
ANY = "*"  # in an allowed use: every logic module
LEAST_DIFFERENCE = 20  # instructions in a cycle: functions that differ by less are not shown
EXAMPLE = "FR-15"  # the requirement that the first page follows


def all_pages(portal: Portal, part: int = 0, parts: int = 1) -> Iterator[Page]:
    """All pages, or one part of them: each process makes its own."""
    for make in islice(_makers(portal), part, None, parts):
        yield make()


def _makers(portal: Portal) -> Iterator[Callable[[], Page]]:
    model = portal.model
    for path in model.files:
        yield partial(source_page, portal, path)
    yield from overviews(portal)
    yield from paper_views(portal)
    for module in portal.designs:
        yield partial(module_page, portal, module)
    for application in model.patterns.values():
        yield partial(pattern_page, portal, application)
    for requirement in model.requirements.values():
        yield partial(requirement_page, portal, requirement)
    for check in portal.checks.values():
        yield partial(portal.page, f"checks/{check.id}", check.id, "checks", "check", check=check)


def overviews(portal: Portal) -> Iterator[Callable[[], Page]]:
    page = partial(partial, portal.page)
    by_logic = [m for m in portal.model.logic_modules.values() if m.modules]
    yield partial(home_page, portal)
    yield partial(structure_page, portal)
    yield page("guide", "Module guide", "guide", "guide", groups=by_logic)
    yield page("interfaces", "Interfaces", "interfaces", "interfaces", groups=by_logic)
    yield page("datatypes", "Data dictionary", "datatypes", "datatypes")
    yield page("patterns/index", "Pattern applications", "patterns", "patterns")
    yield partial(products_page, portal)
    yield page("machines", "State machines", "machines", "machines")
    yield partial(uses_page, portal)
    yield partial(execution_page, portal)
    yield partial(exports_page, portal)
    yield page("architecture", "Architecture", "architecture", "architecture", wide=True)
    yield partial(requirements_page, portal)
    yield page("trees", "Invocation trees", "trees", "trees")
    yield partial(tests_page, portal)
    yield partial(virtual_k64_page, portal)
    yield partial(mutation_page, portal)
    yield partial(reverse_page, portal)
    yield partial(closed_loop_page, portal)
    yield partial(usual_design_page, portal)
    yield partial(bench_page, portal)
    yield page("checks/index", "Checks", "checks", "checks")
    yield page("checks/drift", "Drift test", "drift", "drift")
    yield partial(sources_page, portal)


# ---- views of one list -------------------------------------------------------


def structure_page(portal: Portal) -> Page:
    tops = [m for m in portal.model.logic_modules.values() if m.parent is None]
    return portal.page(
        "structure", "Module structure", "structure", "structure", tops=tops, anchor=logic_anchor
    )


def uses_page(portal: Portal) -> Page:
    return portal.page("uses", "Uses", "uses", "uses", rows=use_rows(portal))


def exports_page(portal: Portal) -> Page:
    return portal.page("exports", "Exports", "exports", "exports", sources=diagram_sources(portal))


def tests_page(portal: Portal) -> Page:
    return portal.page("tests", "Tests", "tests", "tests", suites=suites(portal))


def virtual_k64_page(portal: Portal) -> Page:
    return portal.page(
        "virtual_k64",
        "Findings of the virtual K64",
        "virtual_k64",
        "virtual_k64",
        drivers=driver_coverage(portal),
        torture=[t for t in portal.model.tests.values() if t.place.file.startswith(TORTURE)],
    )


def reverse_page(portal: Portal) -> Page:
    rows = reverse_rows(portal)
    return portal.page("reverse", "Reverse direction", "reverse", "reverse", rows=rows)


def sources_page(portal: Portal) -> Page:
    return portal.page("source/index", "Source", "source", "sources", folders=folders(portal))


# ---- first page --------------------------------------------------------------


def home_page(portal: Portal) -> Page:
    example = portal.model.requirements.get(EXAMPLE)
    method = best_method(portal, example) if example and example.tree else None
    return portal.page(
        "index",
        "The weeding robot's microcontroller software",
        "home",
        "home",
        example=example,
        method=method,
        rows=aligned(portal, example, first_run(example))[:14] if example else [],
    )


def best_method(portal: Portal, requirement: Requirement) -> Method | None:
    """The deepest method of the tree that satisfies the requirement."""
    nodes = portal.flat(requirement.tree) if requirement.tree else []
    methods = [m for m in (real_method(portal, node) for _, node in reversed(nodes)) if m]
    wanted = [m for m in methods if requirement.id in m.satisfies]
    return next(iter([*wanted, *methods]), None)


def real_method(portal: Portal, node: TreeNode) -> Method | None:
    method = portal.links.find_method(node.resolved or f"{node.module}::{node.method}")
    return method if method and method.body else None


@dataclass
class DriverFile:
    """A file of the drivers, and its lines that no test executed on the virtual K64."""

    path: str
    executed: int
    lines: int
    missed: list[Place]  # runs of lines


def driver_coverage(portal: Portal) -> list[DriverFile] | None:
    if portal.model.board_lines is None:
        return None
    return [
        DriverFile(path, sum(lines.values()), len(lines), missed_runs(path, lines))
        for path, lines in sorted(portal.model.board_lines.items())
    ]


def missed_runs(path: str, lines: dict[int, bool]) -> list[Place]:
    """Runs of missed lines; what lies between two and is no code does not part them."""
    runs: list[Place] = []
    missed_before = False
    for line, hit in sorted(lines.items()):
        if not hit:
            first = runs.pop().line if missed_before else line
            runs.append(Place(path, first, line))
        missed_before = not hit
    return runs


def products_page(portal: Portal) -> Page:
    products = read_products(portal.root)
    held = [set(product["modules"]) for product in (products or {}).values()]
    common = set.intersection(*held) if held else set()
    return portal.page(
        "products",
        "Product line",
        "products",
        "products",
        listed=PRODUCTS,
        products=products,
        rows=sorted(set().union(*held) - common),
        common=sorted(common),
    )


def closed_loop_page(portal: Portal) -> Page:
    scenarios = portal.model.closed_loop

    def within(binding: str) -> tuple[int | None, int]:
        """How many figures are within their limits, if any was measured, and how many there are."""
        every = [figure for scenario in scenarios for figure in scenario.figures]
        ran = [figure for figure in every if binding in figure.values]
        return sum(figure.holds(binding) for figure in ran) if ran else None, len(every)

    return portal.page(
        "closed_loop",
        "Closed loop",
        "closed_loop",
        "closed_loop",
        scenarios=scenarios,
        drawings={
            scenario.name: [drawing for plot in scenario.plots if (drawing := plots.draw(plot))]
            for scenario in scenarios
        },
        within=within,
        number=lambda value: f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}",
        width=plots.WIDTH,
        height=plots.HEIGHT,
    )


def mutation_page(portal: Portal) -> Page:
    mutation = portal.model.mutation
    tried = mutation.tried if mutation else []
    return portal.page(
        "mutation",
        "Mutants",
        "mutation",
        "mutation",
        rows=[(r, mutants_of(portal.model, r.id)) for r in portal.model.requirements.values()],
        kinds=Counter(mutant.kind for mutant in tried),
        survivors=[mutant for mutant in tried if not mutant.killed_by],
    )


def reverse_rows(portal: Portal) -> list[tuple[str, int, int]]:
    """Of the public methods and of the tests: how many there are, how many serve no requirement."""
    modules = portal.model.modules.values()
    methods = [m for item in modules if not item.datatype for m in item.methods]
    public = sum(method.access == "public" for method in methods)
    return [
        ("method", public, len(methods_without(portal.model))),
        ("test", len(portal.model.tests), len(tests_without(portal.model))),
    ]


def usual_design_page(portal: Portal) -> Page:
    found = usual_design.read_comparison(portal.root)
    changes = usual_design.changes_of(portal.root)
    patches = {
        change: {
            design: (portal.root / usual_design.patch_of(change, design)).read_text("utf-8")
            for design in usual_design.DESIGNS
        }
        for change in changes
    }
    return portal.page(
        "usual_design",
        "Patterns and the usual design",
        "usual_design",
        "usual_design",
        found=found,
        folder=str(usual_design.FOLDER),
        rows=usual_design.ROWS,
        designs=usual_design.DESIGNS,
        targets=usual_design.TARGETS,
        more=usual_design.more,
        verdict=usual_design.verdict,
        changes=changes,
        titles=usual_design.TITLES,
        patches=patches,
        counts={
            change: {
                design: usual_design.count_patch(text).as_json() for design, text in texts.items()
            }
            for change, texts in patches.items()
        },
        functions=usual_design.beside(found["functions"], LEAST_DIFFERENCE) if found else [],
        least=LEAST_DIFFERENCE,
    )


# ---- modules -----------------------------------------------------------------


def module_page(portal: Portal, module: Module) -> Page:
    rows = portal.calls.rows(module)
    logic = portal.model.logic_modules.get(module.logic)
    first_tests = portal.own_tests(module)[:FIRST_TESTS]
    specified = [m for m in module.methods if m.access == "public"]
    return portal.page(
        f"modules/{module.name}",
        module.name,
        "structure",
        "module",
        module=module,
        by_doxygen=doxygen_file(portal, module) is not None,
        logic=logic,
        rows=rows,
        drawing=calls.draw(rows),
        methods=specified,
        hidden=[m for m in module.methods if m.access != "public"],
        inherited=inherited_methods(portal, module),
        first_tests=first_tests,
        other_tests=[test for test in portal.tests_of(module) if test not in first_tests],
        through=requirement_methods(module),
        siblings=[name for name in (logic.modules if logic else []) if name != module.name],
        ancestors=ancestors(portal, module),
        bars=coverage_bars(portal, module),
        changes=portal.changes_of(module.name),
        in_paper=portal.in_paper(module.name),
        on_board=[hit for lines in board_hits(portal, module).values() for hit in lines.values()],
    )


def doxygen_file(portal: Portal, module: Module) -> Path | None:
    """Doxygen's file on a class."""
    path = portal.root / XML / f"class{module.qualified.replace('::', '_1_1')}.xml"
    return path if path.is_file() else None


def ancestors(portal: Portal, module: Module) -> list[str]:
    """Bases, nearest first."""
    found: list[str] = []
    pending = list(module.bases)
    while pending:
        base = pending.pop(0)
        if base not in found:
            found.append(base)
            if base in portal.model.modules:
                pending += portal.model.modules[base].bases
    return found


def inherited_methods(portal: Portal, module: Module) -> list[Method]:
    """Public methods that the module has from its bases and does not override."""
    known = {m.name for m in module.methods}
    found: list[Method] = []
    for base in ancestors(portal, module):
        for method in portal.model.modules[base].methods if base in portal.model.modules else []:
            skip = method.kind == "constructor" or method.name.startswith(("~", "operator"))
            if method.access == "public" and not skip and method.name not in known:
                known.add(method.name)
                found.append(method)
    return found


def requirement_methods(module: Module) -> dict[str, list[str]]:
    """The methods through which a module serves each requirement."""
    found: dict[str, list[str]] = {identifier: [] for identifier in module.requirements}
    for method in module.methods:
        for identifier in method.satisfies:
            names = found.setdefault(identifier, [])
            if method.name not in names:
                names.append(method.name)
    return found


def coverage_bars(portal: Portal, module: Module) -> list[tuple[str, list[str]]]:
    """For each file a class for each of its lines: executed, missed, or not code."""
    bars = []
    for path, hits in {**module.line_hits, **board_hits(portal, module)}.items():
        kinds = [line_kind(hits.get(n)) for n in range(1, portal.length(path) + 1)]
        bars.append((path, kinds))
    return bars


def board_hits(portal: Portal, module: Module) -> dict[str, dict[int, int]]:
    """File -> line -> 1 where the virtual K64 executed the line, for a module of the drivers."""
    measured = portal.model.board_lines or {}
    return {
        path: {line: int(hit) for line, hit in sorted(measured[path].items())}
        for path in (module.header, module.source)
        if path in measured
    }


def line_kind(hits: int | None) -> str:
    if hits is None:
        return "z"
    return "h" if hits else "m"


# ---- patterns ----------------------------------------------------------------


def pattern_page(portal: Portal, application: PatternApplication) -> Page:
    machines = [m for m in portal.model.machines.values() if m.application == application.id]
    modules = dict.fromkeys(r.module for r in application.roles if r.module in portal.model.modules)
    return portal.page(
        f"patterns/{application.id}",
        application.id,
        "patterns",
        "pattern",
        application=application,
        machines=machines,
        modules=[portal.model.modules[name] for name in modules],
        kin=[a for a in portal.model.patterns.values() if a.pattern == application.pattern],
    )


# ---- requirements ------------------------------------------------------------


def requirements_page(portal: Portal) -> Page:
    model = portal.model
    found = {item.id: verification.facets(model, item) for item in model.requirements.values()}
    picks = {
        "state": lambda one: [one.state],
        "logic": lambda one: one.logic,
        "pattern": lambda one: one.pattern,
        "verification": lambda one: one.verification,
        "binding": lambda one: one.binding,
    }
    return portal.page(
        "requirements/index",
        "Requirements",
        "requirements",
        "requirements",
        sections=sections(portal),
        facets=found,
        options={name: verification.options(found.values(), pick) for name, pick in picks.items()},
        bars=verification.chart(sections(portal)),
        lines_of=verification.lines_of,
        host=HOST,
    )


def requirement_page(portal: Portal, requirement: Requirement) -> Page:
    nodes = portal.flat(requirement.tree) if requirement.tree else []
    tests = [portal.model.tests[t] for t in requirement.verified_by if t in portal.model.tests]
    return portal.page(
        f"requirements/{requirement.id}",
        requirement.id,
        "requirements",
        "requirement",
        requirement=requirement,
        nodes=nodes,
        runs=[
            (binding, run, aligned(portal, requirement, run))
            for binding, run in requirement.runs.items()
        ],
        rows=aligned(portal, requirement, None),
        tests=tests,
        covered=covered_methods(requirement),
        gaps=[gap for gap in portal.model.line_gaps if requirement.id in gap.requirements],
        lines_of=verification.lines_of,
        branches_of=verification.branches_of,
        mutants=mutants_of(portal.model, requirement.id),
        machines=machines_of(portal, requirement.id),
        line_kind=line_kind,
    )


def covered_methods(requirement: Requirement) -> list[dict[str, MethodCoverage]]:
    """A row for each body of a method of the tree: binding -> what the tests executed of it."""
    rows: dict[tuple[str, int], dict[str, MethodCoverage]] = {}
    for binding, methods in requirement.coverage.items():
        for method in methods:
            rows.setdefault((method.place.file, method.place.line), {})[binding] = method
    return list(rows.values())


def first_run(requirement: Requirement) -> TreeRun | None:
    return next(iter(requirement.runs.values()), None)


def machines_of(portal: Portal, requirement: str) -> list[StateMachine]:
    """State machines with a transition that the requirement asks for."""
    return [
        machine
        for machine in portal.model.machines.values()
        if any(requirement in step.requirements for step in machine.transitions)
    ]


@dataclass
class Row:
    """A row of tree and trace: a node, a recorded call, or both when they match."""

    node: TreeNode | None = None
    depth: int = 0
    call: str = ""
    call_depth: int = 0
    matched: bool = False
    trunks: list[int] = field(default_factory=list)


def aligned(portal: Portal, requirement: Requirement, run: TreeRun | None) -> list[Row]:
    """Each node of the tree on the row of the recorded call that it matches."""
    rows = [Row(call=t.method, call_depth=t.depth) for t in run.rows] if run else []
    nodes = portal.flat(requirement.tree) if requirement.tree else []
    places = run.places if run else [None] * len(nodes)
    loose: list[tuple[int, Row]] = []
    last = -1
    for (depth, node), at in zip(nodes, places, strict=True):
        if at is not None and 0 <= at < len(rows) and rows[at].node is None:
            rows[at].node, rows[at].depth, rows[at].matched = node, depth, True
            last = at
        else:
            loose.append((last + 1, Row(node=node, depth=depth)))
    for at, row in reversed(loose):
        rows.insert(at, row)
    add_trunks(rows)
    return rows


def add_trunks(rows: list[Row]) -> None:
    """Which vertical lines of the tree pass each row: a parent's line ends at its last child."""
    placed = [(index, row.depth) for index, row in enumerate(rows) if row.node]
    for number, (index, depth) in enumerate(placed):
        if depth == 0:
            continue
        parent = next(i for i, d in reversed(placed[:number]) if d == depth - 1)
        for between in range(parent + 1, index):
            if depth - 1 not in rows[between].trunks:
                rows[between].trunks.append(depth - 1)


def sections(portal: Portal) -> dict[str, list[Requirement]]:
    found: dict[str, list[Requirement]] = {}
    for requirement in portal.model.requirements.values():
        found.setdefault(requirement.section, []).append(requirement)
    return found


# ---- exports -----------------------------------------------------------------


def diagram_sources(portal: Portal) -> list[tuple[str, str, str]]:
    """The file of each diagram, and the page that shows it."""
    found = []
    for application in portal.model.patterns.values():
        page = portal.links.pattern(application.id) or ""
        found.append((f"{DIAGRAMS}/pattern-{application.id}.puml", page, application.title))
    if portal.model.groups:
        found.append((f"{DIAGRAMS}/high-level.puml", "@/architecture.html#high-level", HIGH_LEVEL))
    for machine in portal.model.machines.values():
        page = portal.links.machine(machine.id) or ""
        found.append((f"{DIAGRAMS}/machine-{machine.id}.puml", page, machine.title))
    return found


# ---- execution ---------------------------------------------------------------


def execution_page(portal: Portal) -> Page:
    """The contexts, the highest priority first; what has none comes last."""
    contexts = sorted(
        portal.model.contexts.values(), key=lambda one: (one.priority is None, one.priority or 0)
    )
    return portal.page(
        "execution", "Execution", "execution", "execution", wide=True, contexts=contexts
    )


# ---- tests, uses, source -----------------------------------------------------


def suites(portal: Portal) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for test in portal.model.tests.values():
        found.setdefault(test.suite, []).append(test.id)
    return found


@dataclass
class UseRow:
    source: str
    target: str
    why: str | None
    places: int
    first: list[Place]


def use_rows(portal: Portal) -> list[UseRow]:
    """Allowed and actual uses side by side."""
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


def folders(portal: Portal) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for path in portal.model.files:
        found.setdefault(path.rpartition("/")[0], []).append(path)
    return found


@dataclass
class Line:
    number: int
    code: str
    hits: int | None
    marks: list[str]


def source_page(portal: Portal, path: str) -> Page:
    marks, hits = portal.marks.get(path, {}), portal.hits.get(path, {})
    lines = [
        Line(number, code, hits.get(number), marks.get(number, []))
        for number, code in enumerate(portal.code.lines(path), 1)
    ]
    modules = [m.name for m in portal.model.modules.values() if path in (m.header, m.source)]
    return portal.page(
        f"source/{path}", path, "source", "source", path=path, lines=lines, modules=modules,
        measured=bool(hits), on_board=path in (portal.model.board_lines or {}),
        line_kind=line_kind,
    )  # fmt: skip
