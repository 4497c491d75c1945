"""The facts on the page of a module, for example its share of the stack."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

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
