"""req-number: each number with a unit in the text of a requirement is linked to a constant in the
code, and has the value of this constant."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.model.requirement_numbers import (
    Quantity,
    constants_named,
    is_same,
    quantity_of,
    stated_numbers,
)
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place, Requirement, RequirementNumbers

LINKS = "design/requirement_numbers.toml"


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    links = {entry.requirement: entry for entry in facts.declared.numbers}
    without = {
        number: facts.declared.entries.line_in(entry.place, number)
        for entry in facts.declared.numbers_without
        for number in entry.numbers
    }
    for requirement in model.requirements.values() if links or without else []:
        stated = stated_numbers(requirement.text)
        yield from _unlinked(requirement, stated, links.get(requirement.id), without)
    for entry in links.values():
        stated_in = model.requirements.get(entry.requirement)
        yield from _linked(entry, stated_numbers(stated_in.text if stated_in else ""), facts)
    yield from _unneeded(model, without)


def _unlinked(
    requirement: Requirement,
    stated: dict[str, Quantity],
    links: RequirementNumbers | None,
    without: dict[str, Place],
) -> Iterator[Finding]:
    """Finds numbers in the texts of requirements for which design/requirement_numbers.toml names
    neither a constant nor a reason why there is no constant."""
    for number in stated.keys() - (links.constants.keys() if links else set()):
        if f"{requirement.id} {number}" not in without:
            text = f"{requirement.id} states {number}, but no constant is linked with it"
            yield Finding(requirement.place, "req-number", text)


def _linked(
    entry: RequirementNumbers, stated: dict[str, Quantity], facts: Facts
) -> Iterator[Finding]:
    """Finds links with a number that the requirement does not contain, with a constant that does
    not exist, or with a constant that has another value."""
    for number, name in entry.constants.items():
        place = facts.declared.entries.line_in(entry.place, number)
        constants = constants_named(name, facts.syntax.values)
        if number not in stated:
            text = f"{entry.requirement} does not state {number}"
            yield Finding(place, "req-number", text)
        elif not constants:
            text = f"{name} is not a constant, but is linked with {number} of {entry.requirement}"
            yield Finding(place, "req-number", text)
        elif not any(is_same(stated[number], quantity_of(constant)) for constant in constants):
            value = f"{constants[0].number} {constants[0].unit}".strip()
            text = f"{name} is {value}, but {entry.requirement} states {number}"
            yield Finding(constants[0].place, "req-number", text)


def _unneeded(model: Model, without: dict[str, Place]) -> Iterator[Finding]:
    needed = {
        f"{requirement.id} {number}"
        for requirement in model.requirements.values()
        for number in stated_numbers(requirement.text)
    }
    for number, place in without.items():
        if number not in needed:
            text = f"no requirement states {number}"
            yield Finding(place, "req-number", text, "remove the entry")
