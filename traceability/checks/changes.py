"""pattern-change: the likely changes name what exists."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.changes import Particular, Recipe
from traceability.model.facts import Facts
from traceability.model.schema import Finding, Model, Place


def check(model: Model, facts: Facts) -> list[Finding]:
    if not facts.declared.patterns:
        return []
    texts = facts.declared.changes
    wrong = [one for name, item in texts.recipes.items() for one in _recipe(name, item, facts)]
    wrong += [
        one
        for name, item in texts.particulars.items()
        for one in _particular(name, item, model, facts)
    ]
    wrong += [
        (pattern.place, pattern.name, f"no recipe says what a change of a {pattern.name} takes")
        for pattern in facts.declared.patterns
        if pattern.name not in texts.recipes
    ]
    line_in = facts.declared.entries.line_in
    return [
        Finding(line_in(place, word), "pattern-change", text, "correct the name in the design")
        for place, word, text in wrong
    ]


def _recipe(name: str, recipe: Recipe, facts: Facts) -> Iterator[tuple[Place, str, str]]:
    known = {pattern.name: pattern.roles for pattern in facts.declared.patterns}
    if name not in known:
        yield recipe.place, name, f"there is no pattern {name}"
        return
    for role in [*recipe.alters, recipe.derives]:
        if role and role not in known[name]:
            yield recipe.place, role, f"{role} is no role of {name}"


def _particular(
    name: str, particular: Particular, model: Model, facts: Facts
) -> Iterator[tuple[Place, str, str]]:
    if name not in facts.declared.applications:
        yield particular.place, name, f"there is no application {name}"
    for module in [*particular.derives, *particular.examples]:
        if module not in model.modules:
            yield particular.place, module, f"there is no module {module}"
