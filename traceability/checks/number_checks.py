"""req-number: each number in the text of a requirement is linked to a constant in the code and has
the value of this constant, or design/requirement_numbers.toml states why there is no constant. Each
limit of a metric is a number of its requirement. module-number: in the specification of a module,
each number with a unit is the value of a constant, or a number of a requirement. doc-number: in the
README of a port, each number with a unit is the value of a constant. This constant is in the port
or in SystemConstants."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from fractions import Fraction

from traceability.model.design_model import Model
from traceability.model.requirement_numbers import (
    Quantity,
    bare_numbers,
    constants_named,
    is_same,
    limits_of_range,
    number_in,
    quantity_of,
    stated_numbers,
    states,
)
from traceability.reading.ast_facts import ConstantFact
from traceability.reading.closed_loop_record import DECLARED, declared
from traceability.reading.formulas import value_of
from traceability.reading.plain_constants import constants_of_cpp
from traceability.reading.ports import FOLDER as PORTS
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.schema import Finding, Module, Place, Requirement, RequirementNumbers
from traceability.sources import files_below

LINKS = "design/requirement_numbers.toml"
SHARED = "SystemConstants"  # module with the constants that all modules use
COUNTS = ("cycle", "sample", "tick", "edge", "byte", "repetition")
ROUNDED = 0.005  # greatest share by which a number of a text may differ from a formula
WHOLE = Quantity("share", Fraction(10_000))  # 100 %
_UNIT_IN_BRACKETS = re.compile(r"\[[^\]]*\]")
_ASSUMPTION = re.compile(r"Assumption:[^.]*(?:\.\d[^.]*)*\.?")


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _requirements(model, facts)
    by_file: dict[str, list[ConstantFact]] = {}
    for constant in facts.syntax.values:
        by_file.setdefault(constant.place.file, []).append(constant)
    for module in model.modules.values():
        yield from _specification(module, model, by_file)
    yield from _ports(facts)


def _ports(facts: Facts) -> Iterator[Finding]:
    """Finds wrong numbers in the README of a port: no constant of the port or of SystemConstants
    has such a number as its value."""
    shared = [
        quantity_of(constant)
        for constant in facts.syntax.values
        if constant.name.startswith(f"{SHARED}::")
    ]
    for readme in sorted((facts.root / PORTS).glob("*/README.md")):
        own = [
            quantity_of(constant)
            for path in files_below(readme.parent, (".",), (".hpp", ".cpp"))
            for _, constant in constants_of_cpp(path, path.name)
        ]
        for place, line in lines_below(facts.root, (str(readme.relative_to(facts.root)),), ()):
            for number, quantity in _numbers(line).items():
                if quantity not in (*own, *shared):
                    text = f"the text states {number}, but no constant of the port has this value"
                    yield Finding(place, "doc-number", text)


def _specification(
    module: Module, model: Model, by_file: dict[str, list[ConstantFact]]
) -> Iterator[Finding]:
    """Finds wrong numbers in the specification of a module. A number is right if a constant has
    this value, or if a requirement of the module contains this number. The constants are those of
    the module, of the modules that it uses, and of SystemConstants."""
    near = [
        model.modules[name] for name in (module.name, SHARED, *module.uses) if name in model.modules
    ]
    constants = [
        quantity_of(constant)
        for file in {file for one in near for file in (one.header, one.source) if file}
        for constant in by_file.get(file, [])
    ]
    named = {*module.requirements, *(name for m in module.methods for name in m.satisfies)}
    required = [
        quantity
        for name in named & model.requirements.keys()
        for text in (model.requirements[name].text, model.requirements[name].rationale)
        for quantity in stated_numbers(text).values()
    ]
    for place, what, text in _texts(module):
        for number, quantity in _numbers(text).items():
            if quantity not in required and not _is_stated(quantity, constants):
                says = f"{what} states {number}, but no constant of the module has this value"
                yield Finding(place, "module-number", says)


def _is_stated(stated: Quantity, constants: list[Quantity]) -> bool:
    """Returns whether a constant has the number and the unit of a text. If the text states a count
    and no constant has the unit of this count, a constant with the same number and without a unit
    is sufficient."""
    if stated.kind in COUNTS and not any(one.kind == stated.kind for one in constants):
        return any(is_same(stated, one) for one in constants)
    return stated in constants


def _texts(module: Module) -> Iterator[tuple[Place, str, str]]:
    """Yields the texts of the specification of a module, each with its place and its owner."""
    yield from ((module.place, module.name, text) for text in (module.brief, module.function))
    for method in module.methods:
        if not method.inherited_from:
            texts = [method.brief, method.details, method.returns, method.errors]
            texts += [*method.pre, *method.post, *(param.text for param in method.params)]
            yield from ((method.place, method.id, text) for text in texts)


def _numbers(text: str) -> dict[str, Quantity]:
    """Returns those numbers of a text that have a unit, and the limits of the ranges in this text.
    Omits assumptions, 100 %, and each number that is not greater than one smallest unit, such as
    0.01 degree."""
    stated = stated_numbers(_UNIT_IN_BRACKETS.sub("", _ASSUMPTION.sub("", text)))
    quantities = stated | limits_of_range(text)
    return {name: one for name, one in quantities.items() if one.amount > 1 and one != WHOLE}


def _requirements(model: Model, facts: Facts) -> Iterator[Finding]:
    links = {entry.requirement: entry for entry in facts.declared.numbers}
    without = {
        number: facts.line_in(entry.place, number)
        for entry in facts.declared.numbers_without
        for number in entry.numbers
    }
    stated = {item.id: _stated(item) for item in model.requirements.values()}
    for requirement in model.requirements.values() if links or without else []:
        # Numbers for which design/requirement_numbers.toml names neither a constant nor a reason.
        linked = links[requirement.id].constants if requirement.id in links else {}
        for number in stated[requirement.id].keys() - linked.keys():
            if f"{requirement.id} {number}" not in without:
                text = f"{requirement.id} states {number}, but no constant has a link to {number}"
                yield Finding(requirement.place, "req-number", text)
    for entry in links.values():
        yield from _linked(entry, stated.get(entry.requirement, {}), facts)
    needed = {f"{name} {number}" for name, numbers in stated.items() for number in numbers}
    for number in without.keys() - needed:
        text = f"no requirement states {number}"
        yield Finding(without[number], "req-number", text, "remove the entry")
    yield from wrong_bounds(model)
    yield from wrong_limits(model, facts)


def _stated(requirement: Requirement) -> dict[str, Quantity]:
    return bare_numbers(requirement.text) | stated_numbers(requirement.text)


def _linked(
    entry: RequirementNumbers, stated: dict[str, Quantity], facts: Facts
) -> Iterator[Finding]:
    """Finds three kinds of wrong links: the requirement does not contain the number, the constant
    does not exist, or the constant or the formula has another value."""
    known = {constant.name: constant for constant in facts.syntax.values}
    for number, name in entry.constants.items():
        place = facts.line_in(entry.place, number)
        constants = constants_named(name, facts.syntax.values)
        if number not in stated:
            text = f"{entry.requirement} does not state {number}"
            yield Finding(place, "req-number", text)
        elif not constants:
            value = value_of(name, known)
            if value is None:
                text = f"{name} is no constant, but is linked with {number} of {entry.requirement}"
                yield Finding(place, "req-number", text)
            elif not math.isclose(value, number_in(number), rel_tol=ROUNDED):
                text = f"{name} is {value:.6g}, but {entry.requirement} states {number}"
                yield Finding(place, "req-number", text)
        elif not any(is_same(stated[number], quantity_of(constant)) for constant in constants):
            shown = f"{constants[0].number} {constants[0].unit}".strip()
            text = f"{name} is {shown}, but {entry.requirement} states {number}"
            yield Finding(constants[0].place, "req-number", text)


def wrong_bounds(model: Model) -> Iterator[Finding]:
    """Each @evidence of a requirement has a bound. Finds the bounds that the text of the
    requirement does not state. The text need not state a bound of 0, which means that there must be
    no finding."""
    for requirement in model.requirements.values():
        for evidence in requirement.evidence:
            bound = Fraction(str(evidence.bound))
            if evidence.bound and not states(requirement.text, bound, evidence.unit):
                text = f"{requirement.id} does not state {evidence.bound:g} {evidence.unit}"
                yield Finding(evidence.place, "req-number", text, "correct one of the two numbers")


def wrong_limits(model: Model, facts: Facts) -> Iterator[Finding]:
    """In design/closed_loop.toml, finds each metric whose limit is not stated by the requirement of
    this metric. If the metric is an error, the requirement can state the limit as a percentage of
    the value of the key ``target``."""
    if not (facts.root / DECLARED).is_file():
        return
    places = {scenario.name: scenario.place for scenario in model.closed_loop}
    for scenario in declared(facts.root):
        for figure in scenario["figure"]:
            requirement = model.requirements.get(figure.get("requirement", ""))
            if requirement is None:
                continue
            limit = Fraction(str(figure["limit"]))
            target = Fraction(str(figure.get("target", 0))) * Fraction(str(figure.get("scale", 1)))
            share = 100 * limit / abs(target) if target and figure["kind"] == "error" else None
            if states(requirement.text, limit, figure["unit"]) or (
                share and states(requirement.text, share, "%")
            ):
                continue
            place = facts.line_in(places[scenario["name"]], f'"{figure["title"]}"')
            text = f"{requirement.id} does not state {figure['limit']} {figure['unit']}"
            yield Finding(place, "req-number", text, "correct the limit or its requirement")
