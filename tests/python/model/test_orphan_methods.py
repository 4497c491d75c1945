"""From methods and tests back to the requirements."""

from __future__ import annotations

from dataclasses import replace

from traceability.model.design_model import Model
from traceability.model.orphan_methods import methods_without
from traceability.schema import Method, Module, Place, Requirement, TreeNode

PLACE = Place("src/a/A.hpp", 1)
TOML = Place("design/justified.toml", 4)


def method(name: str, overrides: str | None = None, satisfies: str = "") -> Method:
    owner, _, plain = name.partition("::")
    kind = "constructor" if owner == plain else "plain"
    item = Method(name, owner, plain, name, "public", kind, PLACE, overrides=overrides)
    return replace(item, satisfies=[satisfies] if satisfies else [])


def module(*methods: Method, datatype: bool = False) -> Module:
    name = methods[0].module
    found = Module(name, f"wr::{name}", "a", False, datatype, "", "", "", PLACE, PLACE.file, None)
    return replace(found, methods=list(methods))


def model_of(*modules: Module) -> Model:
    tree = TreeNode("Leaf::inTree", "Leaf", "inTree", "Leaf::inTree", "root", PLACE)
    requirement = Requirement("FR-1", "It shall.", "A", PLACE, tree=tree)
    named = {item.name: item for item in modules}
    return Model("", "", "", {}, modules=named, requirements={"FR-1": requirement})


def without(*modules: Module) -> list[str]:
    return [item.id for _, item in methods_without(model_of(*modules))]


def test_a_tag_or_a_place_in_a_tree_is_enough() -> None:
    leaf = module(method("Leaf::inTree"), method("Leaf::tagged", satisfies="FR-1"))
    assert without(leaf) == []


def test_a_method_without_both_is_found() -> None:
    assert without(module(method("Leaf::inTree"), method("Leaf::left"))) == ["Leaf::left"]


def test_overriding_methods_serve_together() -> None:
    top = module(method("Top::act"), method("Top::rest"))
    middle = module(method("Middle::act", "Top::act"))
    low = module(method("Low::act", "Middle::act", satisfies="FR-1"))
    other = module(method("Other::act", "Top::act"), method("Other::rest", "Top::rest"))
    assert without(top, middle, low, other) == ["Top::rest", "Other::rest"]


def test_a_constructor_serves_with_its_module() -> None:
    used = module(method("Used::Used"), method("Used::act", satisfies="FR-1"))
    idle = module(method("Idle::Idle"))
    assert without(used, idle) == ["Idle::Idle"]


def test_private_methods_and_value_types_serve_whom_they_like() -> None:
    hidden = replace(method("Leaf::hidden"), access="private")
    assert without(module(hidden), module(method("Value::x"), datatype=True)) == []
