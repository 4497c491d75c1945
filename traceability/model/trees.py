"""The invocation trees. Each node shows whether the code can make the call of this node. Each
requirement contains the recordings of tests that made all calls of its tree."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.model.architecture import POST
from traceability.model.design_model import Model
from traceability.model.trace_summary import Edges, fold, starts
from traceability.reading.ast_facts import BodyFact, CallFact
from traceability.reading.result_cache import cached_result, code_of
from traceability.reading.source_facts import Facts
from traceability.reading.traces import Row, Traces, embed, excerpt, nodes_of
from traceability.reading.translation_units import is_board
from traceability.schema import BINDINGS, HOST, Requirement, TreeNode, TreeRun


def with_trees(model: Model, facts: Facts, recordings: dict[str, Traces], cache: Path) -> Model:
    known_nodes = {
        method.id
        for fact in facts.syntax.classes
        for method in fact.methods
        if (top := model.modules.get(fact.name.split("::")[0])) and not top.datatype
    }
    trees = {
        name: replace(_below(root, facts), reachable=root.resolved is not None)
        for name in model.requirements
        if (tree := facts.declared.trees.get(name, (None, None))[1]) is not None
        for root in [_resolved(tree, facts)]
    }
    edges = declared_edges(trees, facts)
    runs = [
        Run(binding, traces, facts, traces.addresses(known_nodes), edges)
        for binding, traces in recordings.items()
    ]
    searches = [
        Search(name, trees[name], passing, run)
        for name, requirement in model.requirements.items()
        for run in runs
        if name in trees and (passing := _passing(model, requirement, run))
    ]
    parts = [
        [run.traces.state for run in runs],
        sorted(known_nodes),
        sorted(edges.items()),
        [search.asked() for search in searches],
        *code_of("model/trees", "reading/traces", "model/trace_summary"),
    ]
    tree_runs = cached_result(
        cache / "trees.pickle", parts, lambda: [search.find() for search in searches]
    )
    furthest: dict[str, dict[str, int]] = {name: {} for name in trees}  # tree -> target -> nodes
    by_tree: dict[str, dict[str, TreeRun]] = {name: {} for name in trees}
    for search, (run, nodes) in zip(searches, tree_runs, strict=True):
        furthest[search.requirement][search.run.binding] = nodes
        if run is not None:
            by_tree[search.requirement][search.run.binding] = run
    requirements = {
        name: replace(requirement, tree=_executed(trees[name], furthest[name]), runs=by_tree[name])
        if name in trees
        else requirement
        for name, requirement in model.requirements.items()
    }
    return replace(model, requirements=requirements)


def _resolved(node: TreeNode, facts: Facts) -> TreeNode:
    owner, _, name = node.label.rpartition("::")
    method = facts.method(owner, name)
    children = [_resolved(child, facts) for child in node.children]
    resolved = replace(node, resolved=method.id if method else None, children=children)
    if method is None or children:
        return resolved
    return replace(
        resolved,
        outside=[target for target in BINDINGS if not accepted_on(target, resolved, facts)],
    )


def _executed(tree: TreeNode, furthest: Mapping[str, int]) -> TreeNode:
    """Returns the tree. Each node shows for each target whether a recording on this target
    contains the call of the node."""
    numbers = itertools.count()

    def marked(node: TreeNode) -> TreeNode:
        number = next(numbers)
        executed = {
            target: number < furthest[target] for target in furthest if target not in node.outside
        }
        return replace(node, executed=executed, children=[marked(child) for child in node.children])

    return marked(tree)


def accepted(node: TreeNode, facts: Facts) -> set[str]:
    """Returns the methods whose calls match a node. If the method of the node has a body, only this
    method matches. Otherwise, the methods that override it match."""
    if node.resolved is None:
        return set()
    if node.resolved in facts.bodies:
        return {node.resolved}
    return set(facts.overriders.get(node.resolved, []))


def accepted_on(binding: str, node: TreeNode, facts: Facts) -> set[str]:
    """Returns the methods whose calls match a node on a target. On the host, the methods of the K64
    drivers are left out, because they do not exist there."""
    return {
        method
        for method in accepted(node, facts)
        if binding != HOST or not all(is_board(b.place.file) for b in facts.bodies.get(method, []))
    }


def _below(node: TreeNode, facts: Facts) -> TreeNode:
    """Returns the node. Each child contains three results about the code of the node: whether this
    code can call the child, how often it calls the child, and whether this call comes too early."""
    bodies = [body for name in accepted(node, facts) for body in facts.bodies.get(name, [])]
    targets = {
        target
        for body in bodies
        for call in body.calls
        for target in facts.targets_in_products(call, body.owner)[0]
    }
    children: list[TreeNode] = []
    for child in node.children:
        callees = accepted(child, facts) | {child.resolved or ""}
        called = bool(callees & targets)
        posted = POST in targets and _is_activated(callees, facts)
        reachable = posted if child.kind == "post" else called
        otherwise = not reachable and (posted or called)
        sought = {POST} if child.kind == "post" else callees
        calls = [sites for body in bodies if (sites := _calls_of(body, sought, facts))]
        before = children[-1] if children else None
        children.append(
            replace(
                _below(child, facts),
                reachable=reachable,
                otherwise=otherwise,
                often_in_code=_often(calls) if calls else None,
                too_early=_too_early(before, child, bodies, facts) if before else "",
            )
        )
    return replace(node, children=children)


def _calls_of(body: BodyFact, callees: set[str], facts: Facts) -> list[CallFact]:
    return [
        call
        for call in body.calls
        if callees.intersection(facts.targets_in_products(call, body.owner)[0])
    ]


def _often(calls: list[list[CallFact]]) -> str:
    """Returns how often the code makes a call, as in ``TreeNode.often``: an empty text, ? or *.
    ``calls`` contains the calls in each function body."""
    sure = [sum(not call.sometimes for call in own) for own in calls]
    if max(sure) > 1 or any(call.repeated for own in calls for call in own):
        return "*"
    return "" if min(sure) else "?"


def _too_early(before: TreeNode, node: TreeNode, bodies: list[BodyFact], facts: Facts) -> str:
    """Checks the order of two neighbouring nodes. If a function body calls the function of ``node``
    only before its first call of the function of ``before``, the order is wrong, and the label of
    ``before`` is returned. Otherwise returns an empty text.

    Calls in a loop to another module are accepted, because a loop over objects of different classes
    may alternate between their methods."""
    for body in bodies:
        first, second = (
            _calls_of(body, accepted(child, facts) | {child.resolved or ""}, facts)
            for child in (before, node)
        )
        in_turn = before.module != node.module and any(call.repeated for call in second)
        if in_turn or not first or not second:
            continue
        if max(call.end for call in second) < min(call.end for call in first):
            return before.label
    return ""


def _is_activated(callees: set[str], facts: Facts) -> bool:
    """Returns true if a thread executes one of the methods ``callees``. A thread executes the
    method ``execute`` of each command, and the methods that ``execute`` calls."""
    commands = set(facts.overriders.get("Command::execute", []))
    called = {
        target
        for command in commands
        for body in facts.bodies.get(command, [])
        for call in body.calls
        for target in facts.targets(call.target, call.virtual)
    }
    return bool(callees & (commands | called))


def declared_edges(trees: Mapping[str, TreeNode], facts: Facts) -> Edges:
    """Returns the requirements for each pair of modules. The invocation trees of these requirements
    contain a call from the first module of the pair to the second module.
    """
    edges: Edges = {}
    for requirement, tree in trees.items():
        for node in nodes_of(tree):
            for child in node.children:
                for pair in itertools.product(_modules_of(node, facts), _modules_of(child, facts)):
                    names = edges.setdefault(pair, [])
                    if requirement not in names:
                        names.append(requirement)
    return edges


def _modules_of(node: TreeNode, facts: Facts) -> set[str]:
    return {node.module, *(method.split("::")[0] for method in accepted(node, facts))}


@dataclass
class Run:
    """The inputs of a search in the recordings of a target."""

    binding: str
    traces: Traces
    facts: Facts
    shown: set[int]  # addresses of the methods of design modules
    edges: Edges
    read: dict[str, list[Row]] = field(default_factory=dict)

    def rows(self, recording: str) -> list[Row]:
        if recording not in self.read:
            self.read[recording] = self.traces.rows(recording, self.shown)
        return self.read[recording]

    def accepts(self, node: TreeNode) -> set[str]:
        return accepted_on(self.binding, node, self.facts)


def _passing(model: Model, requirement: Requirement, run: Run) -> dict[str, str]:
    """Returns the recordings of the passing tests of a requirement, each with its test."""
    passing = model.passing(requirement.verified_by, run.binding)
    return {name: test for name, test in passing.items() if name in run.traces.tests}


@dataclass
class Search:
    """A search for a tree in the recordings of the passing tests of its requirement."""

    requirement: str
    tree: TreeNode
    passing: dict[str, str]
    run: Run

    def asked(self) -> object:
        """Returns the inputs that determine the result of the search. The result is cached under
        these inputs."""
        return self.requirement, self.run.binding, self.passing, self._shape(self.tree)

    def _shape(self, node: TreeNode) -> object:
        below = [self._shape(child) for child in node.children]
        return node.label, node.kind, sorted(self.run.accepts(node)), below

    def find(self) -> tuple[TreeRun | None, int]:
        """Searches for the tree in the recordings, from the smallest to the largest recording.
        Returns the first recording that contains the whole tree, or None.

        Also returns how many nodes were found in the order of the tree. If the numbers in the
        recordings differ, returns the largest number."""
        nodes = nodes_of(self.tree)
        order = {id(node): number for number, node in enumerate(nodes)}
        furthest = 0
        for name in sorted(self.passing, key=self._length):
            rows = self.run.rows(name)
            embedding = embed(self.tree, rows, self.run.accepts)
            if embedding.failed is None:
                shown, start, numbers = excerpt(rows, sorted(embedding.rows.values()))
                places = [numbers.get(embedding.rows.get(id(node), -1)) for node in nodes]
                folded = fold(rows, starts(nodes, embedding.rows), self.run.edges)
                return TreeRun(self.passing[name], shown, start, places, folded), len(nodes)
            furthest = max(furthest, order[id(embedding.failed)])
        return None, furthest

    def _length(self, recording: str) -> tuple[int, str]:
        return self.run.traces.file(recording).stat().st_size, recording
