"""pattern-change: the roles, modules and applications in design/changes.toml exist."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from traceability.checks.pattern_checks import ABSTRACTIONS, SUBCLASS_ROLES
from traceability.model.design_model import Model
from traceability.reading.declared import Particular, Recipe
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place

# placeholders that the model replaces by names in the text of a step
STANDING = {"derives", "edits", "id"}


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    if not facts.declared.patterns:
        return
    for name, recipe in facts.declared.recipes.items():
        yield from _findings(recipe.place, _recipe(name, recipe, facts), facts)
    for name, particular in facts.declared.particulars.items():
        yield from _findings(particular.place, _particular(name, particular, model, facts), facts)
    for pattern in facts.declared.patterns:
        if pattern.name not in facts.declared.recipes:
            problem = (pattern.name, f"there is no recipe for a change of a {pattern.name}")
            yield from _findings(pattern.place, [problem], facts)


def _findings(entry: Place, problems: Iterable[tuple[str, str]], facts: Facts) -> Iterator[Finding]:
    """Yields a finding for each problem of an entry. A problem has two parts: the word to which the
    finding points, and the text of the finding."""
    for word, text in problems:
        yield Finding(facts.line_in(entry, word), "pattern-change", text)


def _recipe(name: str, recipe: Recipe, facts: Facts) -> Iterator[tuple[str, str]]:
    roles = {pattern.name: pattern.roles for pattern in facts.declared.patterns}
    if name not in roles:
        yield name, f"there is no pattern {name}"
        return
    added = re.split(r", | or ", recipe.adds)
    demanded = (
        (added, SUBCLASS_ROLES, "role of a subclass"),
        (recipe.alters, (*SUBCLASS_ROLES, "Singleton"), "role of a subclass"),
        ([recipe.derives], ABSTRACTIONS, "role of a base class"),
    )
    for listed, fitting, sort in demanded:
        for role in filter(None, listed):
            if role not in roles[name]:
                yield role, f"{role} is not a role of {name}"
            elif role not in fitting:
                text = f"{role} is not a {sort}, but a change of a {name} needs a {sort} here"
                yield role, text
    if not recipe.alters:
        yield "alters", f"the recipe for a {name} lists no role that the change alters"
    for step in recipe.steps:
        for role in re.findall(r"@role\{\{id\}, ([^}]+)\}", step):
            if role not in roles[name]:
                yield role, f"{role} is not a role of {name}"
        for word in set(re.findall(r"\{([^{}]*)\}", step)) - STANDING:
            yield step, f"a step contains {{{word}}}, but the model has no such placeholder"


def _particular(
    name: str, particular: Particular, model: Model, facts: Facts
) -> Iterator[tuple[str, str]]:
    if name not in facts.declared.applications:
        yield name, f"there is no application {name}"
    for module in [*particular.derives, *particular.examples]:
        if module not in model.modules:
            yield module, f"there is no module {module}"
    application = model.patterns.get(name)
    bound = {role.module for role in application.roles} if application else set()
    for module in particular.derives:
        if module in model.modules and not bound & {module, *facts.bases_of(module)}:
            yield module, f"{module} has no role in {name}"
    for module in particular.examples:
        if module in model.modules and not model.modules[module].extension:
            text = f"{module} is a module of src, but an example must be a module of an extension"
            yield module, text
    if application and particular.examples and bound.isdisjoint(particular.examples):
        yield "examples", f"no module of the examples has a role in {name}"
