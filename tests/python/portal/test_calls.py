"""The callers of a method, on the page of its module."""

from __future__ import annotations

from dataclasses import replace

from portal.calls import CallGraph
from portal.links import Links
from tests.python.portal.fixture import make_model


def test_callers_include_nested_classes_and_values_of_constants() -> None:
    """A nested class and a constant of a module are shown as callers. A function that belongs to no
    module is not shown."""
    model = make_model()
    callers = ["MainController::read", "MainController::States::States", "Mode::kLimit", "helper"]
    rc = model.modules["RC"]
    rc = replace(rc, methods=[replace(rc.methods[0], called_by=dict.fromkeys(callers, ""))])
    model = replace(model, modules={**model.modules, "RC": rc})
    (row,) = CallGraph(model, Links(model, set())).rows(rc)
    assert [end.method for end in row.callers] == [
        "MainController::read",
        "MainController::States",
        "Mode::kLimit",
    ]
    assert row.callers[1].link == Links(model, set()).module("MainController")


def test_caller_with_an_unknown_object_names_the_abstract_method() -> None:
    model = make_model()
    rc = model.modules["RC"]
    callers = {"MainController::read": "Mode::newMessage"}
    rc = replace(rc, methods=[replace(rc.methods[0], called_by=callers)])
    model = replace(model, modules={**model.modules, "RC": rc})
    (row,) = CallGraph(model, Links(model, set())).rows(rc)
    assert [end.through for end in row.callers] == ["Mode::newMessage"]
