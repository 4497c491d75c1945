"""The callers of a method, on the page of its module."""

from __future__ import annotations

from dataclasses import replace

from portal.calls import CallGraph
from portal.links import Links
from tests.python.portal.fixture import make_model
from traceability.schema import Call


def test_callers_include_nested_classes_and_values_of_constants() -> None:
    """A nested class and a constant of a module are shown as callers. A function outside modules is
    not shown."""
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


def test_methods_of_nested_classes_that_other_modules_call_have_a_row() -> None:
    """The row of Body::execute shows its callers in other modules. Body::execute calls the abstract
    method Mode::read. The row shows this method, and not its overrides."""
    model = make_model()
    names = ("Mode", "RC")
    mode, rc = (model.modules[name].methods[0] for name in names)
    called_by = {"MainController::Body::execute": "", "MainController::Body::Body": ""}
    mode = replace(mode, called_by=called_by)
    rc = replace(
        rc,
        called_by=called_by,
        overrides="Mode::read",
        calls=[Call("Command::execute", True, rc.place, ["MainController::Body::execute"])],
    )
    modules = {
        name: replace(model.modules[name], methods=[method])
        for name, method in zip(names, (mode, rc), strict=True)
    }
    model = replace(model, modules={**model.modules, **modules})
    *_, row = CallGraph(model, Links(model, set())).rows(model.modules["MainController"])
    assert (row.name, row.link) == ("Body::execute", None)
    assert [end.method for end in row.callers] == ["RC::read"]
    assert [end.method for end in row.callees] == ["Mode::read"]
