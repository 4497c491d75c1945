"""The facts on the page of a module, for example its share of the stack."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from portal.module_page import requirement_methods
from portal.portal import Portal
from tests.python.portal.fixture import REPORT, make_project
from traceability.schema import StackCall, StackContext, StackProof


def context(name: str, *calls: tuple[str, int]) -> StackContext:
    chain = [StackCall(function, size, measured=False) for function, size in calls]
    return StackContext(name, name, "thread", None, sum(size for _, size in calls), chain)


def test_a_module_has_its_largest_share_of_the_deepest_calls(tmp_path: Path) -> None:
    stack = StackProof(
        108,
        contexts=[
            context("wheel", ("RC::read", 40), ("Mode::read", 900)),
            context("main", ("RC::read", 40), ("RC::convert", 24)),
        ],
    )
    portal = Portal(tmp_path, replace(make_project(tmp_path), stack=stack), REPORT, [])
    assert portal.stack_of(portal.model.modules["RC"]) == (64, "main")
    assert portal.stack_of(portal.model.modules["MainController"]) is None


def test_requirements_whose_tree_contains_the_module_are_listed(tmp_path: Path) -> None:
    """A tree contains a module in two cases: the tree contains a method of the module, or an
    abstract method that the module overrides."""
    model = make_project(tmp_path)
    rc = model.modules["RC"]
    method = replace(rc.methods[0], satisfies=[], overrides="Mode::read")
    modules = {**model.modules, "RC": replace(rc, requirements=[], methods=[method])}

    def listed(name: str, called: str) -> dict[str, list[str]]:
        tree = model.requirements["FR-15"].tree
        assert tree is not None
        child = replace(tree.children[0], module=called.partition("::")[0], resolved=called)
        requirement = replace(model.requirements["FR-15"], tree=replace(tree, children=[child]))
        changed = replace(model, modules=modules, requirements={"FR-15": requirement})
        portal = Portal(tmp_path, changed, REPORT, [])
        return requirement_methods(portal, portal.model.modules[name])

    assert listed("MainController", "RC::read") == {"FR-15": []}
    assert listed("RC", "RC::read") == {"FR-15": []}
    assert listed("RC", "Mode::read") == {"FR-15": []}
    assert listed("Mode", "RC::read") == {}
    portal = Portal(tmp_path, model, REPORT, [])
    assert requirement_methods(portal, rc) == {"FR-15": ["read"]}
