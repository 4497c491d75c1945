"""The list of requirements, and the page of each requirement. The page shows the invocation tree
next to the calls that a test recorded."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any

from portal import verification_views
from portal.module_page import line_kind
from portal.names import counted_states
from portal.portal import Page, Portal
from traceability.grouping import grouped
from traceability.model.design_model import Model
from traceability.model.report import Verdict
from traceability.model.reviews import BASELINE, NAMES_OF_TEXTS, QUESTIONS
from traceability.reading.traces import nodes_of
from traceability.schema import (
    HOST,
    FaultScenario,
    MethodCoverage,
    Requirement,
    StateMachine,
    Test,
    TreeNode,
    TreeRun,
)

MOST_BETWEEN = 4  # greatest number of calls that are shown one by one between two nodes of a tree


def requirements(portal: Portal) -> dict[str, Any]:
    every = portal.model.requirements.values()
    numbers = {
        item.id: verification_views.facets(portal.model, portal.report, item) for item in every
    }
    states = [verdict.state for verdict in portal.report.requirements.values()]
    return {
        "sections": sections(every),
        "facets": numbers,
        "states": counted_states(states),
        "baseline": BASELINE,
        "baseline_changed": portal.last_change([str(BASELINE)]),
        "methods": Counter(requirement.method for requirement in every),
        "sources": Counter(value for facets in numbers.values() for value in facets["source"]),
        "without_test": [item.id for item in every if not item.verified_by],
        "without_method": [item.id for item in every if not item.satisfied_by],
        "options": verification_views.options(numbers.values()),
        "bars": verification_views.chart(sections(every)),
        "covered": verification_views.coverage_rows(portal.model),
        "total": verification_views.coverage_of(portal.model, "", portal.model.host_files),
        "measured_lines": verification_views.measured_lines,
        "host": HOST,
        "dots": {requirement.id: dots(portal, requirement) for requirement in every},
        "tops": portal.top_logic_modules,
        "marks": marks,
        "wide": True,
    }


def dots(portal: Portal, requirement: Requirement) -> Counter[str]:
    """For each top-level logic module, returns the number of its methods that satisfy the
    requirement."""
    modules = (portal.model.modules.get(m.split("::")[0]) for m in requirement.satisfied_by)
    return Counter(module.logic.partition("/")[0] for module in modules if module)


def marks(portal: Portal, requirement: Requirement) -> list[tuple[str, bool]]:
    """Returns statements about the invocation tree, each with true or false: the tree is declared,
    the tree is possible, the tree was executed on a target."""
    nodes = portal.nodes(requirement)
    possible = all(node.reachable for _, node in nodes)
    targets = portal.model.results_hashes
    ran = [
        (
            f"executed on the {target}",
            target in requirement.runs and not portal.model.stale_on(target),
        )
        for target in targets
    ]
    return [("declared", True), ("possible", possible), *ran] if nodes else []


@dataclass
class Sheet:
    """The values that the page of a requirement and its printable sheet show."""

    requirement: Requirement
    verdict: Verdict
    nodes: list[tuple[int, TreeNode]]
    outside_tree: list[str]  # methods that satisfy the requirement, but are not in the tree
    scenarios: dict[str, list[FaultScenario]]  # targets -> scenarios whose tests passed there
    tests: list[Test]
    changes: list[str]  # texts that have changed since their baseline


def sheet_of(portal: Portal, requirement: Requirement) -> Sheet:
    return Sheet(
        requirement,
        portal.report.requirements[requirement.id],
        portal.nodes(requirement),
        outside_tree(portal.model, requirement),
        played_scenarios(portal.model, requirement),
        [portal.model.tests[name] for name in requirement.verified_by],
        [
            f"{NAMES_OF_TEXTS[suspicion.kind].format(suspicion.name)} {suspicion.text}"
            for suspicion in requirement.suspicions
        ],
    )


def requirement_page(portal: Portal, requirement: Requirement) -> Page:
    return portal.page(
        f"requirements/{requirement.id}",
        requirement.id,
        "requirements",
        "requirement",
        **vars(sheet_of(portal, requirement)),
        runs=[
            (binding, run, shortened(aligned(portal, requirement, run)))
            for binding, run in requirement.runs.items()
        ],
        rows=aligned(portal, requirement, None),
        covered=covered_methods(requirement),
        gaps=[gap for gap in portal.model.line_gaps if requirement.id in gap.requirements],
        lines_of=verification_views.lines_of,
        measured=verification_views.measured_lines(requirement),
        branches_of=verification_views.branches_of,
        mutants=portal.model.mutants_of(requirement.id),
        machines=machines_of(portal, requirement.id),
        questions=QUESTIONS,
        line_kind=line_kind,
    )


def outside_tree(model: Model, requirement: Requirement) -> list[str]:
    """Returns the methods that satisfy the requirement and are not in its tree. If a method
    overrides a method of the tree, the method is left out too."""
    if requirement.tree is None:
        return []
    inside: set[str] = set()
    for node in nodes_of(requirement.tree):
        subclasses = model.modules[node.module].subclasses if node.module in model.modules else []
        inside |= {node.resolved or ""} | {f"{name}::{node.method}" for name in subclasses}
    return [name for name in requirement.satisfied_by if name not in inside]


def played_scenarios(model: Model, requirement: Requirement) -> dict[str, list[FaultScenario]]:
    """Returns the fault scenarios that are played by a test of the requirement. The key lists the
    targets on which at least one test of the scenario passed. This test may verify another
    requirement."""
    scenarios: dict[str, list[FaultScenario]] = {}
    for scenario in model.safety.scenarios.values():
        if set(scenario.tests) & set(requirement.verified_by):
            passed = {
                target for name in scenario.tests for target in model.tests[name].gave("passed")
            }
            scenarios.setdefault(", ".join(sorted(passed)), []).append(scenario)
    return scenarios


def covered_methods(requirement: Requirement) -> list[dict[str, MethodCoverage]]:
    """Returns a row for each method that is in the tree and has a body. The row shows which source
    lines the tests executed on each target."""
    rows: dict[tuple[str, int], dict[str, MethodCoverage]] = {}
    for binding, methods in requirement.coverage.items():
        for method in methods:
            rows.setdefault((method.place.file, method.place.line), {})[binding] = method
    return list(rows.values())


def first_run(requirement: Requirement) -> TreeRun | None:
    return next(iter(requirement.runs.values()), None)


def machines_of(portal: Portal, requirement: str) -> list[StateMachine]:
    """Returns the state machines that have a transition for the requirement."""
    return [
        machine
        for machine in portal.model.machines.values()
        if any(requirement in step.requirements for step in machine.transitions)
    ]


@dataclass
class Row:
    """A row that shows a node of the invocation tree, a recorded call, or both if they match."""

    node: TreeNode | None = None
    depth: int = 0
    call: str = ""
    call_depth: int = 0
    matched: bool = False
    trunks: list[int] = field(default_factory=list)


def aligned(portal: Portal, requirement: Requirement, run: TreeRun | None) -> list[Row]:
    """Returns the rows of the invocation tree and of a recorded run. If a recorded call matches a
    node of the tree, both are in the same row."""
    rows = [Row(call=t.method, call_depth=t.depth) for t in run.rows] if run else []
    nodes = portal.nodes(requirement)
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


def shortened(rows: list[Row]) -> list[Row]:
    """Returns the rows. If more than MOST_BETWEEN consecutive calls match no node, a single row
    replaces them and shows their number."""
    shown: list[Row] = []
    for is_call, group in groupby(rows, lambda row: row.node is None):
        between = list(group)
        if is_call and len(between) > MOST_BETWEEN:
            between = [replace(between[0], call=f"{len(between)} calls")]
        shown += between
    return shown


def add_trunks(rows: list[Row]) -> None:
    """Adds to each row the vertical lines that join the parents of the tree to their children. The
    line of a parent ends at the last child."""
    placed = [(index, row.depth) for index, row in enumerate(rows) if row.node]
    for number, (index, depth) in enumerate(placed):
        if depth == 0:
            continue
        parent = next(i for i, d in reversed(placed[:number]) if d == depth - 1)
        for between in range(parent + 1, index):
            if depth - 1 not in rows[between].trunks:
                rows[between].trunks.append(depth - 1)


def sections(requirements: Iterable[Requirement]) -> dict[str, list[Requirement]]:
    return grouped(requirements, lambda requirement: requirement.section)
