"""board-*: each kind of mistake that the virtual K64 detects is declared and tested, and each
belief about the hardware has a source, for example the manual."""

from __future__ import annotations

import re
from collections.abc import Iterator

from traceability.checks.register_checks import REGISTERS
from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.schema import BoardBelief, Finding, Place
from traceability.sources import text_of

BELIEFS = "design/board_beliefs.toml"


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _findings(model)
    yield from _beliefs(model, facts)
    yield from _without_belief(model, facts)


def _findings(model: Model) -> list[Finding]:
    untested = [
        Finding(
            finding.place,
            "board-finding",
            f"no test in tests/sim/emulator names the finding {finding.id}",
        )
        for finding in model.board_findings.values()
        if not finding.tests
    ]
    unknown = [
        Finding(
            Place("design/board_findings.toml", 1),
            "board-finding",
            f"the fault '{fault.fault}' caused the finding {fault.finding}, which is not declared",
        )
        for fault in model.driver_faults or []
        if fault.finding and fault.finding not in model.board_findings
    ]
    return untested + unknown


def _beliefs(model: Model, facts: Facts) -> Iterator[Finding]:
    registers = text_of(facts.root / REGISTERS)
    for belief in model.beliefs:
        if not _declares(registers, belief):
            yield _belief(belief, f"there is no register {belief.register} in {REGISTERS}")
        if not _names(text_of(facts.root / belief.model), belief):
            yield _belief(belief, f"{belief.model} does not name {belief.name}")
        if belief.source not in model.belief_sources:
            yield _belief(belief, f"there is no source {belief.source}")


def _without_belief(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds registers of src/k64/registers.hpp for which design/board_beliefs.toml has no entry."""
    believed, block = {belief.register for belief in model.beliefs}, ""
    for number, line in enumerate(text_of(facts.root / REGISTERS).splitlines(), 1):
        if begin := re.match(r"namespace (\w+) \{", line):
            block = begin[1]
        declared = re.search(r"\bRegister<.*> (\w+);", line)
        if declared and f"{block}::{declared[1]}" not in believed:
            text = f"no belief in {BELIEFS} is about {block}::{declared[1]}"
            yield Finding(Place(REGISTERS, number), "board-belief", text)


def _belief(belief: BoardBelief, text: str) -> Finding:
    return Finding(belief.place, "board-belief", text)


def _declares(registers: str, belief: BoardBelief) -> bool:
    """Returns whether the table of registers declares the register in the namespace of the
    block."""
    block, _, name = belief.register.rpartition("::")
    inside = registers.partition(f"namespace {block} {{")[2].partition("}  // namespace")[0]
    return re.search(rf"> {re.escape(name)};", inside) is not None


def _names(text: str, belief: BoardBelief) -> bool:
    """Returns whether a file of the virtual board names the register, directly or as a constant."""
    return re.search(rf"\bk?{re.escape(belief.name)}", text, re.IGNORECASE) is not None
