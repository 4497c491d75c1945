"""proof-*: Spin has proven each property, and the explored model agrees with the design and the
code."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from traceability.model.design_model import Model
from traceability.model.promela import ROBOT, guards_of, name_of, observed, slug
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place

INLINE = re.compile(r"^inline (\w+)\(")
CODE = re.compile(r"^// code: (.+)$")
APART = ("// environment", "// observer")
NUMBER = re.compile(r"^#define (\w+) (\d+)\s+// ([\w:]+)(?: / ([\w:]+))?$")
WORD = re.compile(r"[a-z_]\w*")


@dataclass
class Line:
    text: str
    place: Place


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    path = facts.root / ROBOT
    if not model.proofs.properties or not path.exists():
        return
    text = path.read_text(encoding="utf-8")
    lines = [
        Line(line, Place(str(ROBOT), number)) for number, line in enumerate(text.splitlines(), 1)
    ]
    yield from _machines(model, text)
    yield from _steps(model, facts, lines)
    yield from _numbers(model, lines)
    yield from _properties(model, text)


def _machines(model: Model, text: str) -> Iterator[Finding]:
    words = set(re.findall(r"\w+", text))
    for machine in model.machines.values():
        if f"{name_of(machine)}_step" not in words:
            said = f"{ROBOT} does not use the state machine {machine.id}"
            yield Finding(machine.place, "proof-model", said, "call its step in this file")
            continue
        missing = [guard for guard in guards_of(machine) if guard not in words]
        missing += [
            name
            for event in dict.fromkeys(step.event for step in machine.transitions)
            if (name := f"{name_of(machine)}_on_{slug(event)}") not in words
        ]
        for name in missing:
            said = f"{ROBOT} does not use {name} of the state machine {machine.id}"
            yield Finding(machine.place, "proof-model", said, "set it in this file")


def _steps(model: Model, facts: Facts, lines: list[Line]) -> Iterator[Finding]:
    """Finds hand-written steps of the model without a comment that names the modelled methods. Also
    finds comments that name a method that does not exist."""
    methods = {*(method.id for method in model.methods), *facts.bodies}
    for above, line in zip([Line("", lines[0].place), *lines], lines, strict=False):
        match, named = INLINE.match(line.text), CODE.match(above.text)
        if match and not named and above.text not in APART:
            said = f"the step {match[1]} has no comment with the methods that it models"
            fix = "above the step, write // code: and the methods"
            yield Finding(line.place, "proof-model", said, fix)
        for name in [listed.strip() for listed in named[1].split(",")] if match and named else []:
            if name not in methods:
                said = f"the step {match[1] if match else ''} models {name}, which does not exist"
                yield Finding(above.place, "proof-model", said)


def _numbers(model: Model, lines: list[Line]) -> Iterator[Finding]:
    """Finds numbers in design/proofs/robot.pml that differ from the constants in the code."""
    for line in lines:
        match = NUMBER.match(line.text)
        if not match:
            continue
        constants = [model.constants.get(name) for name in match.groups()[2:] if name]
        if None in constants:
            said = f"the number {match[1]} is linked with a constant that does not exist"
            yield Finding(line.place, "proof-model", said)
            continue
        first, *rest = [constant.number for constant in constants if constant]
        value = first // rest[0] if rest else first
        if value != int(match[2]):
            said = f"{match[1]} is {match[2]}, but the code has {value}"
            yield Finding(line.place, "proof-model", said)


def _properties(model: Model, text: str) -> Iterator[Finding]:
    names = observed(text)
    results = model.proofs.results
    for proof in model.proofs.properties.values():
        if proof.requirement not in model.requirements:
            said = f"{proof.name} formalises {proof.requirement}, which does not exist"
            yield Finding(proof.place, "proof-property", said)
        for word in dict.fromkeys(WORD.findall(proof.formula)):
            if word not in names:
                said = f"the formula of {proof.name} has {word}, which observe() does not set"
                yield Finding(proof.place, "proof-property", said, f"set it in {ROBOT}")
        if results is None:
            continue
        verdict = results[proof.name].verdict if proof.name in results else "not tried"
        if verdict != "proven":
            said = f"the property {proof.name} of {proof.requirement} is {verdict}"
            yield Finding(proof.place, "proof-proven", said)
