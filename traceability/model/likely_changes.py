"""Finds the necessary work for the likely change of each pattern application. Also finds the
modules that this change does not edit.

For each pattern, ``design/changes.toml`` contains the steps of its likely change and the role of
the new class. The modules to edit, the affected requirements and the affected tests are found in
the code. If a module names the existing classes that have the role of the new class, the module
must also name the new class. Other modules need not name the new class."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from traceability.model.design_model import Model
from traceability.reading.declared import Declared, Particular, Recipe
from traceability.reading.traces import nodes_of
from traceability.schema import LikelyChange, MadeChange, PatternApplication


def changes_of(
    model: Model, declared: Declared, made: Mapping[str, MadeChange]
) -> dict[str, LikelyChange]:
    changes: dict[str, LikelyChange] = {}
    for application in model.patterns.values():
        recipe = declared.recipes.get(application.pattern)
        if recipe:
            particular = declared.particulars.get(application.id, Particular(application.id))
            change = _change(model, application, recipe, particular)
            changes[application.id] = replace(change, made=made.get(application.id))
    return changes


def _change(
    model: Model, application: PatternApplication, recipe: Recipe, particular: Particular
) -> LikelyChange:
    altered = _bound(application, recipe.alters)
    derives = particular.derives or (_bound(application, [recipe.derives]) if recipe.adds else [])
    edits = _naming(model, altered) if recipe.adds else altered
    requirements = _requirements(model, dict.fromkeys([*derives, *altered]))
    return LikelyChange(
        application=application.id,
        pattern=application.pattern,
        hidden_by=application.module,
        altered=altered,
        role=recipe.adds,
        derives=derives,
        logic=model.modules[altered[0]].logic if altered else "",
        edits=edits,
        untouched=[name for name in _designed(model) if name not in edits],
        requirements=requirements,
        tests=_tests(model, requirements),
        steps=[*recipe.steps, *particular.steps],
        examples=particular.examples,
    )


def _bound(application: PatternApplication, roles: list[str]) -> list[str]:
    """Returns the modules that have one of the roles in a pattern application."""
    modules = [binding.module for binding in application.roles if binding.role in roles]
    return list(dict.fromkeys(modules))


def _designed(model: Model) -> list[str]:
    return [m.name for m in model.modules.values() if not m.datatype and not m.extension]


def _naming(model: Model, present: list[str]) -> list[str]:
    """Returns the modules that name a module in ``present``. A likely change must edit these
    modules, because they must also name the new class. Modules in ``present`` and their base
    classes are left out."""
    kin = {base for name in present if name in model.modules for base in model.modules[name].bases}
    modules = {
        user
        for name in present
        if name in model.modules
        for user in model.modules[name].used_by
        if user not in present and user not in kin
    }
    return [name for name in _designed(model) if name in modules]


def _requirements(model: Model, modules: dict[str, None]) -> list[str]:
    """Returns the requirements of the modules. A requirement is included if a method of a module
    satisfies it, or if its invocation tree contains a method of a module."""
    return [
        requirement.id
        for requirement in model.requirements.values()
        if any(method.partition("::")[0] in modules for method in requirement.satisfied_by)
        or any(node.module in modules for node in nodes_of(requirement.tree))
    ]


def _tests(model: Model, requirements: list[str]) -> list[str]:
    tests = [test for name in requirements for test in model.requirements[name].verified_by]
    return list(dict.fromkeys(tests))
