"""The possible effects of a change, and the command that shows them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.python.portal.fixture import MODES, make_model
from tools.show_impact import lines_of
from traceability.model.design_model import Model
from traceability.model.impact import Impact, Impacts, Reached, UnknownSubjectError


@pytest.fixture
def model() -> Model:
    model = make_model()
    model.modules["Mode"] = replace(model.modules["Mode"], named_by=["MainController"])
    for name in ("Mode", "RC"):
        methods = model.modules[name].methods
        methods[0] = replace(methods[0], called_by={"MainController::read": ""})
    return model


def of(model: Model, subject: str) -> Impact:
    return Impacts(model).of(subject)


def test_a_change_of_an_abstraction_reaches_its_heirs_and_its_users(model: Model) -> None:
    impact = of(model, "Mode")
    assert impact.modules == [
        Reached("Mode", 0, "changed"),
        Reached("MainController", 1, "calls Mode::read"),
        Reached("RC", 1, "derives from Mode"),
    ]


def test_a_change_of_an_heir_stays_behind_its_abstraction(model: Model) -> None:
    assert [one.id for one in of(model, "RC").modules] == ["RC"]


def test_callers_through_an_abstract_class_are_listed_separately(model: Model) -> None:
    caller = Reached("MainController", 1, "MainController::read can call RC::read")
    assert of(model, "RC").callers == [caller]
    assert of(model, "Mode").callers == []
    impacts = Impacts(model)
    assert impacts.of_files("", [f"src/{MODES}/RC.cpp"]).callers == [caller]
    both = [f"src/{MODES}/{name}.cpp" for name in ("RC", "Mode")]
    assert impacts.of_files("", both).callers == [], "MainController calls Mode::read directly"
    lines = lines_of(of(model, "RC"))
    assert "may call it through an abstract class: 1 module" in lines


def test_a_change_of_a_value_type_reaches_the_modules_that_name_it(model: Model) -> None:
    value = replace(model.modules["RC"], name="Order", datatype=True, bases=[], named_by=["RC"])
    model.modules["Order"] = replace(value, methods=[], subclasses=[], roles=[])
    assert Reached("RC", 1, "names Order") in of(model, "Order").modules


def test_requirements_patterns_and_tests_to_look_at_again(model: Model) -> None:
    impact = of(model, "RC")
    assert impact.requirements == [Reached("FR-15", 0, "RC satisfies it")]
    assert impact.patterns == [Reached("reading-modes", 0, "RC is its Concrete State")]
    assert impact.tests == [Reached("RcTest.Reads", 0, "verifies FR-15")]
    tree = of(model, "MainController").requirements
    assert tree == [Reached("FR-15", 0, "its tree contains MainController")]


def test_a_tree_with_an_abstract_method_contains_the_modules_that_override_it(
    model: Model,
) -> None:
    requirement, rc = model.requirements["FR-15"], model.modules["RC"]
    tree = requirement.tree
    assert tree is not None
    child = replace(tree.children[0], module="Mode", resolved="Mode::read")
    model.requirements["FR-15"] = replace(requirement, tree=replace(tree, children=[child]))
    methods = [replace(rc.methods[0], overrides="Mode::read")]
    model.modules["RC"] = replace(rc, requirements=[], methods=methods)
    why = "its tree contains Mode::read, which RC overrides"
    assert of(model, "RC").requirements == [Reached("FR-15", 0, why)]


def test_a_requirement_begins_with_the_modules_that_serve_it(model: Model) -> None:
    impact = of(model, "FR-15")
    assert impact.at(0) == [
        Reached("RC", 0, "satisfies it in RC::read"),
        Reached("MainController", 0, "its tree calls MainController::read"),
    ]
    assert impact.requirements[0] == Reached("FR-15", 0, "changed")


def test_a_file_stands_for_what_is_written_in_it(model: Model) -> None:
    source = of(model, f"./src/{MODES}/RC.cpp")
    assert source.at(0) == [Reached("RC", 0, f"is written in src/{MODES}/RC.cpp")]
    others = ["design/trees/a.tree", "tests/RcTest.cpp", "design/fsm/a.toml", "design/frames.toml"]
    model = replace(model, files=[*model.files, *others])
    assert (
        of(model, "design/trees/a.tree").requirements[0].because
        == "its tree is in design/trees/a.tree"
    )
    assert of(model, "tests/RcTest.cpp").tests[0].because == "is written in tests/RcTest.cpp"
    machine = of(model, "design/fsm/a.toml")
    assert machine.at(0) == [Reached("RC", 0, "is a state of reading-modes")]
    model.modules["FieldName"] = replace(model.modules["RC"], name="FieldName", named_by=["RC"])
    frames = of(model, "design/frames.toml")
    assert [one.id for one in frames.modules] == ["FieldName", "RC"]


@pytest.mark.parametrize(
    ("subject", "near"), [("Modes", "Mode"), ("FR-16", "FR-15"), ("RC.hpp", f"src/{MODES}/RC.hpp")]
)
def test_an_unknown_subject_names_what_is_near(model: Model, subject: str, near: str) -> None:
    with pytest.raises(UnknownSubjectError, match=f"did you mean .*{near}"):
        of(model, subject)


def test_the_command_prints_modules_by_distance(model: Model) -> None:
    lines = lines_of(of(model, "Mode"))
    assert lines[0] == "A change of the module Mode"
    assert "may affect directly: 2 modules" in lines
    assert "  MainController  calls Mode::read" in lines
    assert "run again: 1 test" in lines
