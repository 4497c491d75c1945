"""pattern-change: the roles, modules and applications that design/changes.toml names exist."""

from __future__ import annotations

import re
from collections.abc import Iterator

from traceability.checks.pattern_checks import ABSTRACTIONS, SUBCLASS_ROLES
from traceability.model.design_model import Model
from traceability.reading.change_texts import Particular, Recipe
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place

# placeholders in the text of a step, which the model replaces by names
STANDING = {"derives", "edits", "id"}


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    if not facts.declared.patterns:
        return
    texts = facts.declared.changes
    wrong = [
        problem for name, item in texts.recipes.items() for problem in _recipe(name, item, facts)
    ]
    wrong += [
        problem
        for name, item in texts.particulars.items()
        for problem in _particular(name, item, model, facts)
    ]
    wrong += [
        (pattern.place, pattern.name, f"there is no recipe for a change of a {pattern.name}")
        for pattern in facts.declared.patterns
        if pattern.name not in texts.recipes
    ]
    line_in = facts.line_in
    for place, word, text in wrong:
        yield Finding(line_in(place, word), "pattern-change", text)


def _recipe(name: str, recipe: Recipe, facts: Facts) -> Iterator[tuple[Place, str, str]]:
    roles = {pattern.name: pattern.roles for pattern in facts.declared.patterns}
    if name not in roles:
        yield recipe.place, name, f"there is no pattern {name}"
        return
    added = re.split(r", | or ", recipe.adds)
    for role in [*recipe.alters, *added, recipe.derives]:
        if role and role not in roles[name]:
            yield recipe.place, role, f"{role} is not a role of {name}"
    sorts: list[tuple[str, tuple[str, ...], str]] = [
        (role, SUBCLASS_ROLES, "role of a subclass") for role in added if role
    ]
    sorts += [
        (role, (*SUBCLASS_ROLES, "Singleton"), "role of a subclass") for role in recipe.alters
    ]
    sorts += [(recipe.derives, ABSTRACTIONS, "abstraction")] if recipe.derives else []
    for role, fitting, sort in sorts:
        if role in roles[name] and role not in fitting:
            yield (
                recipe.place,
                role,
                f"{role} is not a {sort}, but a change of a {name} needs a {sort} here",
            )
    if not recipe.alters:
        yield (
            recipe.place,
            "alters",
            f"the recipe for a {name} lists no role that the change alters",
        )
    for step in recipe.steps:
        for role in re.findall(r"@role\{\{id\}, ([^}]+)\}", step):
            if role not in roles[name]:
                yield recipe.place, role, f"{role} is not a role of {name}"
        for word in set(re.findall(r"\{([^{}]*)\}", step)) - STANDING:
            yield recipe.place, step, f"the model replaces no placeholder {{{word}}} in a step"


def _particular(
    name: str, particular: Particular, model: Model, facts: Facts
) -> Iterator[tuple[Place, str, str]]:
    if name not in facts.declared.applications:
        yield particular.place, name, f"there is no application {name}"
    for module in [*particular.derives, *particular.examples]:
        if module not in model.modules:
            yield particular.place, module, f"there is no module {module}"
    application = model.patterns.get(name)
    bound = {role.module for role in application.roles} if application else set()
    for module in particular.derives:
        if module in model.modules and not bound & {module, *_above(module, facts)}:
            yield particular.place, module, f"{module} has no role in {name}"
    for module in particular.examples:
        if module in model.modules and not model.modules[module].extension:
            text = f"{module} is a module of src, but an example must be a module of an extension"
            yield particular.place, module, text

    if application and particular.examples and bound.isdisjoint(particular.examples):
        yield particular.place, "examples", f"no module of the examples has a role in {name}"


def _above(module: str, facts: Facts) -> Iterator[str]:
    for base in facts.classes[module].bases if module in facts.classes else []:
        yield base
        yield from _above(base, facts)
