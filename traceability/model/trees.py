"""The trees of invocations: which edges the code can make, and which run made them."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

from traceability.model.design_model import Model
from traceability.model.trace_summary import Edges, fold, starts
from traceability.reading.ast_facts import BodyFact
from traceability.reading.result_cache import code_of, kept
from traceability.reading.source_facts import Facts
from traceability.reading.traces import Row, Traces, embed, excerpt, nodes_of, recorded_nodes
from traceability.reading.translation_units import is_board
from traceability.schema import BINDINGS, HOST, Requirement, TreeNode, TreeRun


def add_trees(model: Model, facts: Facts, recordings: dict[str, Traces], cache: Path) -> None:
    known = {
        method.id
        for fact in facts.syntax.classes
        for method in fact.methods
        if (top := model.modules.get(fact.name.split("::")[0])) and not top.datatype
    }
    for name, (_, tree) in facts.declared.trees.items():
        requirement = model.requirements.get(name)
        if requirement is None or tree is None:
            continue
        requirement.tree = tree
        _resolve(tree, facts)
        _reach(tree, facts)
    edges = declared_edges(model, facts)
    runs = [
        Run(binding, traces, facts, traces.addresses(known), edges)
        for binding, traces in recordings.items()
    ]
    searches = [
        Search(requirement, requirement.tree, passing, run)
        for requirement in model.requirements.values()
        for run in runs
        if requirement.tree and (passing := _passing(model, requirement, run))
    ]
    parts = [
        [run.traces.state for run in runs],
        sorted(known),
        sorted(edges.items()),
        [search.asked() for search in searches],
        *code_of("model/trees", "reading/traces", "model/trace_summary"),
    ]
    found = kept(cache / "trees.pickle", parts, lambda: [search.find() for search in searches])
    for search, result in zip(searches, found, strict=True):
        search.note(*result)


def _resolve(tree: TreeNode, facts: Facts) -> None:
    for node in nodes_of(tree):
        owner, _, name = node.label.rpartition("::")
        method = facts.method(owner, name)
        node.resolved = method.id if method else None
        if method is not None and not node.children:
            node.outside = [one for one in BINDINGS if not accepted_on(one, node, facts)]


def accepted(node: TreeNode, facts: Facts) -> set[str]:
    """The methods whose call counts as the node: its own, or an overrider when it has no body."""
    if node.resolved is None:
        return set()
    if node.resolved in facts.bodies:
        return {node.resolved}
    return set(facts.overriders.get(node.resolved, []))


def accepted_on(binding: str, node: TreeNode, facts: Facts) -> set[str]:
    """Those of them that a binding has: methods of the K64 are not on the host."""
    return {
        method
        for method in accepted(node, facts)
        if binding != HOST or not all(is_board(b.place.file) for b in facts.bodies.get(method, []))
    }


def _bodies_of(node: TreeNode, facts: Facts) -> list[BodyFact]:
    return [body for method in accepted(node, facts) for body in facts.bodies.get(method, [])]


def _reach(tree: TreeNode, facts: Facts) -> None:
    tree.reachable = tree.resolved is not None
    for node in nodes_of(tree):
        targets = {
            target
            for body in _bodies_of(node, facts)
            for call in body.calls
            for target in facts.targets(call.target, call.virtual)
        }
        for child in node.children:
            wanted = accepted(child, facts) | {child.resolved or ""}
            called = bool(wanted & targets)
            posted = "ControlThread::post" in targets and _is_activated(wanted, facts)
            child.reachable = posted if child.kind == "post" else called
            child.otherwise = not child.reachable and (posted or called)


def _is_activated(wanted: set[str], facts: Facts) -> bool:
    """A thread executes a command: the body is one, or a command calls it."""
    commands = set(facts.overriders.get("Command::execute", []))
    called = {
        target
        for command in commands
        for body in facts.bodies.get(command, [])
        for call in body.calls
        for target in facts.targets(call.target, call.virtual)
    }
    return bool(wanted & (commands | called))


def declared_edges(model: Model, facts: Facts) -> Edges:
    """Which requirements' trees lead from one module into another."""
    found: Edges = {}
    for requirement in model.requirements.values():
        for node in nodes_of(requirement.tree) if requirement.tree else []:
            for child in node.children:
                for pair in product(_modules_of(node, facts), _modules_of(child, facts)):
                    names = found.setdefault(pair, [])
                    if requirement.id not in names:
                        names.append(requirement.id)
    return found


def _modules_of(node: TreeNode, facts: Facts) -> set[str]:
    return {node.module, *(method.split("::")[0] for method in accepted(node, facts))}


@dataclass
class Run:
    """What the recordings of a binding are searched with."""

    binding: str
    traces: Traces
    facts: Facts
    shown: set[int]  # where the methods of design modules begin
    edges: Edges
    read: dict[str, list[Row]] = field(default_factory=dict)

    def rows(self, recording: str) -> list[Row]:
        if recording not in self.read:
            self.read[recording] = self.traces.rows(recording, self.shown)
        return self.read[recording]

    def accepts(self, node: TreeNode) -> set[str]:
        return accepted_on(self.binding, node, self.facts)


def _passing(model: Model, requirement: Requirement, run: Run) -> dict[str, str]:
    """The recordings of the passing tests of a requirement, each with its test."""
    return {
        recording: name
        for name in requirement.verified_by
        if run.binding in model.tests[name].gave("passed")
        for recording in model.tests[name].results[run.binding].recordings
        if recording in run.traces.tests
    }


@dataclass
class Search:
    """Looks for a tree in the recordings of the passing tests of its requirement."""

    requirement: Requirement
    tree: TreeNode
    passing: dict[str, str]
    run: Run

    def asked(self) -> object:
        """What decides on what is found."""
        return self.requirement.id, self.run.binding, self.passing, self._shape(self.tree)

    def _shape(self, node: TreeNode) -> object:
        below = [self._shape(child) for child in node.children]
        return node.label, node.kind, sorted(self.run.accepts(node)), below

    def find(self) -> tuple[TreeRun | None, int]:
        """The first run of the whole tree, the shortest recordings first; and how many nodes of it,
        in their order, were found."""
        nodes = nodes_of(self.tree)
        order = {id(node): number for number, node in enumerate(nodes)}
        furthest = 0
        for name in sorted(self.passing, key=self._length):
            rows = self.run.rows(name)
            found = embed(self.tree, rows, self.run.accepts)
            if found.failed is None:
                shown, start, numbers = excerpt(rows, sorted(found.rows.values()))
                places = [numbers.get(found.rows.get(id(node), -1)) for node in nodes]
                folded = fold(rows, starts(nodes, found.rows), self.run.edges)
                return TreeRun(self.passing[name], shown, start, places, folded), len(nodes)
            furthest = max(furthest, order[id(found.failed)])
        return None, furthest

    def _length(self, recording: str) -> tuple[int, str]:
        return self.run.traces.file(recording).stat().st_size, recording

    def note(self, found: TreeRun | None, nodes: int) -> None:
        if found is not None:
            self.requirement.runs[self.run.binding] = found
        order = {id(node): number for number, node in enumerate(nodes_of(self.tree))}
        for node in recorded_nodes(self.tree, self.run.binding):
            node.executed[self.run.binding] = order[id(node)] < nodes
