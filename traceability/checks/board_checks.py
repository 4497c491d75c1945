"""board-*: the virtual K64 detects some kinds of mistakes. Each of these kinds is declared and
tested. Each belief about the hardware has a source, for example the manual."""

from __future__ import annotations

import re
from collections.abc import Iterator

from traceability.checks.register_checks import REGISTERS, lines_of_blocks
from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place
from traceability.sources import text_of

BELIEFS = "design/board_beliefs.toml"
FINDINGS = Place("design/board_findings.toml", 1)


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _findings(model)
    yield from _beliefs(model, facts)


def _findings(model: Model) -> Iterator[Finding]:
    for finding in model.board_findings.values():
        if not finding.tests:
            text = f"the finding {finding.id} is named in no test in tests/sim/emulator"
            yield Finding(finding.place, "board-finding", text)
    for fault in model.driver_faults or []:
        if fault.finding and fault.finding not in model.board_findings:
            said = f"the fault '{fault.fault}' caused the finding {fault.finding}"
            yield Finding(FINDINGS, "board-finding", f"{said}, which is not declared")


def _beliefs(model: Model, facts: Facts) -> Iterator[Finding]:
    registers = {
        f"{block}::{name}": place
        for place, block, line in lines_of_blocks(facts.root)
        for name in re.findall(r"\bRegister<.*> (\w+);", line)
    }
    for belief in model.beliefs:
        # The virtual board names the register directly, or as a constant.
        named = re.compile(rf"\bk?{re.escape(belief.name)}", re.IGNORECASE)
        if belief.register not in registers:
            yield _belief(belief.place, f"there is no register {belief.register} in {REGISTERS}")
        if not named.search(text_of(facts.root / belief.model)):
            yield _belief(belief.place, f"{belief.model} does not name {belief.name}")
        if belief.source not in model.belief_sources:
            yield _belief(belief.place, f"there is no source {belief.source}")
    for register in registers.keys() - {belief.register for belief in model.beliefs}:
        yield _belief(registers[register], f"no belief in {BELIEFS} is about {register}")


def _belief(place: Place, text: str) -> Finding:
    return Finding(place, "board-belief", text)
