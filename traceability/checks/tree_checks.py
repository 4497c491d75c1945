"""tree-*: the code can make each call of an invocation tree, and a passed test made the calls. The
code can also make the calls of the chains in design/recordings.toml."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.model.trees import accepted
from traceability.reading.chains import WITHIN, declared_chains
from traceability.reading.graphs import reached_from
from traceability.reading.source_facts import Facts
from traceability.reading.traces import nodes_of
from traceability.schema import Finding, Place, Requirement, TreeNode

OFTEN = {"": "once", "?": "under a condition", "*": "several times"}


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    for place, text, fix in facts.declared.tree_errors:
        yield Finding(place, "tree-node", text, fix)
    for name, (place, _) in facts.declared.trees.items():
        if name not in model.requirements:
            yield Finding(place, "tree-node", f"there is no requirement {name}", "correct the id")
    for requirement in model.requirements.values():
        if requirement.tree is None:
            if requirement.by_calls:
                text = f"{requirement.id} has no tree of invocations"
                yield Finding(requirement.place, "tree-missing", text)
            continue
        yield from _nodes(requirement)
        yield from _edges(requirement.tree, requirement, facts)
        if not model.results_stale:
            yield from _executed(requirement, model)
    yield from _chains(facts)


def _nodes(requirement: Requirement) -> Iterator[Finding]:
    assert requirement.tree is not None
    for node in nodes_of(requirement.tree):
        if node.resolved is None:
            text = f"there is no method {node.label} (tree of {requirement.id})"
            yield Finding(node.place, "tree-node", text)


def _edges(node: TreeNode, requirement: Requirement, facts: Facts) -> Iterator[Finding]:
    for child in node.children:
        if child.reachable is False and child.otherwise:
            direct = child.kind == "call"
            kind, fix = ("a post", "with") if direct else ("a call", "without")
            text = f"{node.label} reaches {child.label} by {kind} (tree of {requirement.id})"
            yield Finding(child.place, "tree-static", text, f"write this node {fix} 'post '")
        elif child.reachable is False and node.resolved and child.resolved:
            verb = "posts" if child.kind == "post" else "calls"
            call = f"{node.label} never {verb} {child.label}"
            tree = f"the tree of {requirement.id} contains the call"
            text = f"{call}, but {tree} ({child.place.file}:{child.place.line})"
            fix = ""
            if child.kind == "call" and _may_call(node, child, facts):
                text += ". No constructor of a product connects the two objects"
                fix = "correct the connection in the constructor, or change the tree"
            yield Finding(_body_place(node, facts), "tree-static", text, fix)
        elif child.reachable:
            yield from _order(node, child, requirement, facts)
        yield from _edges(child, requirement, facts)


def _may_call(node: TreeNode, child: TreeNode, facts: Facts) -> bool:
    """Returns whether the code of ``node`` contains a call that can execute ``child``. The objects
    that the products connect are not considered."""
    called = {
        target
        for name in accepted(node, facts)
        for body in facts.bodies.get(name, [])
        for call in body.calls
        for target in facts.targets(call.target, call.virtual)
    }
    return bool(called & accepted(child, facts))


def _order(
    node: TreeNode, child: TreeNode, requirement: Requirement, facts: Facts
) -> Iterator[Finding]:
    """The node of a call in the tree states whether the code makes the call once, under a
    condition, or several times. Checks that the code does this. Also checks that the code makes the
    call after the previous call of the tree.
    """
    tree = f"tree of {requirement.id}, {child.place.file}:{child.place.line}"
    call, place = f"{node.label} calls {child.label}", _body_place(node, facts)
    if child.often_in_code is not None and child.often_in_code != child.often:
        text = f"{call} {OFTEN[child.often_in_code]}, not {OFTEN[child.often]} ({tree})"
        fix = f"restore the code, or write {child.often_in_code or 'no mark'} after the node"
        yield Finding(place, "tree-order", text, fix)
    if child.too_early:
        fix = "restore the order of the calls, or change the order in the tree"
        yield Finding(place, "tree-order", f"{call} before {child.too_early} ({tree})", fix)


def _body_place(node: TreeNode, facts: Facts) -> Place:
    for method in sorted(accepted(node, facts)):
        for body in facts.bodies.get(method, []):
            return Place(body.place.file, body.place.line)
    return node.place


def _executed(requirement: Requirement, model: Model) -> Iterator[Finding]:
    assert requirement.tree is not None
    passed = [name for name in requirement.verified_by if model.tests[name].gave("passed")]
    nodes = nodes_of(requirement.tree)
    possible = all(node.resolved is not None and node.reachable for node in nodes)
    if not passed or not possible or requirement.runs:
        return
    # If there are no recorded calls of passed tests, it is unknown for each node whether a test
    # made the call. The finding then points to the root.
    failed = next((node for node in nodes if node.ran is False), requirement.tree)
    text = (
        f"no passing test of {requirement.id} made the call of {failed.label} at this place of the "
        "tree"
    )
    yield Finding(failed.place, "tree-dynamic", text)


def _chains(facts: Facts) -> Iterator[Finding]:
    """Finds steps of a chain that none of the enclosing steps can call, directly or indirectly."""

    def called(method: str) -> list[str]:
        owner = method.rpartition("::")[0]
        calls = [call for body in facts.robot.own_bodies(method) for call in body.calls]
        return [target for call in calls for target in facts.robot.wired_targets(call, owner)]

    for chain in declared_chains(facts.root):
        outer: list[str] = []
        for step in chain.steps:
            name = step.removeprefix(WITHIN)
            if name == step:
                outer = []
            elif not any(name in reached_from([method], called) for method in outer):
                text = f"{', '.join(outer)} cannot call {name} (chain {chain.name})"
                yield Finding(chain.place, "tree-chain", text)
            outer.append(name)
