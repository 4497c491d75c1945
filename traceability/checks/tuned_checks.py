"""change-tuned: if the value of a constant depends on the cycle time or the tick time, the code
computes the value from this time, or design/tuned.toml declares the dependence. Each name and each
line in design/tuned.toml exists."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from traceability.model.design_model import Model
from traceability.model.requirement_numbers import WORDS, stated_numbers
from traceability.reading.formulas import NAME
from traceability.reading.plain_constants import plain_constants
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below, place_of
from traceability.schema import Finding, Place
from traceability.sources import DESIGN

WRITTEN = re.compile(
    r"^\s*(?:\[\[maybe_unused\]\] )?(?:static |inline )*constexpr [\w:<>, ]+? (k\w+)\b[^/]*"
    r"(?://(.*))?$"
)
REMARK = re.compile(r"^\s*//(.*)$")
PERIOD = "SystemConstants::cyclePeriod"
# If the name or the comment of a constant contains one of these words, the constant probably
# depends on the named constant of SystemConstants.
SIGNS = {
    PERIOD: re.compile(r"(?<!duty )\b[Cc]ycles?\b|[a-z]Cycles?\b"),
    "SystemConstants::tickPeriod": re.compile(r"\bticks?\b|Ticks?\b"),
}
# If the rationale of a requirement counts cycles in this way, the times and the numbers of bytes in
# the requirement probably depend on the period of a cycle.
COUNTED = re.compile(rf"\b(?:for|in) (?:an?|one|\d+|{'|'.join(WORDS)}) (?:control )?cycles?\b")
DEPENDENT = ("time", "byte")


@dataclass
class Written:
    """A constant in a source file. ``text`` contains its name and the comments above and next to
    the constant."""

    name: str
    code: str
    text: str
    place: Place


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    if not facts.declared.patterns:
        return
    constants = {constant.name: constant for constant in written(facts)}
    yield from _unknown(model, facts, constants)
    yield from _undeclared(model, facts, constants)


def written(facts: Facts) -> Iterator[Written]:
    above: list[str] = []
    for place, line in lines_below(facts.root, DESIGN, (".cpp", ".hpp")):
        if match := WRITTEN.match(line):
            text = " ".join((*above, match[1], match[2] or ""))
            name = f"{Path(place.file).stem}::{match[1]}"
            yield Written(name, line.split("//")[0], text, place)
        remark = REMARK.match(line)
        above = [*above, remark[1]] if remark else []


def _unknown(model: Model, facts: Facts, constants: dict[str, Written]) -> Iterator[Finding]:
    """Finds entries of design/tuned.toml that name a constant or a line which does not exist."""
    known = {*(method.id for method in model.methods), *constants}
    simulated = plain_constants(facts.root) if {item.to for item in model.tuned} - known else {}
    for item in model.tuned:
        names = [] if item.to in simulated else [item.to]
        for name in [*names, *item.constants]:
            if name not in known:
                text = f"there is no constant {name}"
                yield Finding(item.place, "change-tuned", text, "correct the name")
        for line in item.lines:
            if place_of(facts.root, line) is None:
                text = f"no source line matches {line}"
                yield Finding(item.place, "change-tuned", text, "correct the file or the text")


def _read_by(constant: Written) -> set[str]:
    """Returns the constant itself, and the constants of the same file whose names are in the source
    line of the constant."""
    file = constant.name.split("::", maxsplit=1)[0]
    return {f"{file}::{name}" for name in re.findall(r"\bk[A-Z]\w*", constant.code)}


def _undeclared(model: Model, facts: Facts, constants: dict[str, Written]) -> Iterator[Finding]:
    """Finds constants that seem to depend on a constant of SystemConstants, but are neither
    computed from it nor declared in design/tuned.toml."""
    computed = {(fact.name, fact.target) for fact in facts.syntax.initial}
    declared = {(name, item.to) for item in model.tuned for name in item.constants}
    suspects: dict[tuple[str, str], Place] = {}
    for constant in constants.values():
        for to, sign in SIGNS.items():
            if computed.intersection((name, to) for name in _read_by(constant)):
                computed.add((constant.name, to))
            if sign.search(constant.text):
                suspects[constant.name, to] = constant.place
    for name, place in _counted_in_cycles(model, facts):
        own = constants[name].place if name in constants else place
        suspects.setdefault((name, PERIOD), own)
    for (name, to), place in suspects.items():
        if name != to and (name, to) not in computed | declared:
            text = (
                f"{name} seems to depend on {to}, but is neither computed from it nor declared in "
                "design/tuned.toml"
            )
            yield Finding(place, "change-tuned", text)


def _counted_in_cycles(model: Model, facts: Facts) -> Iterator[tuple[str, Place]]:
    """Examines each requirement whose rationale counts cycles. Yields the constants for the times
    and the numbers of bytes in this requirement. Each constant has its place in
    design/requirement_numbers.toml."""
    for entry in facts.declared.numbers:
        requirement = model.requirements.get(entry.requirement)
        if requirement and COUNTED.search(requirement.rationale):
            for number, name in entry.constants.items():
                if any(found.kind in DEPENDENT for found in stated_numbers(number).values()):
                    place = facts.line_in(entry.place, number)
                    yield from ((constant, place) for constant in NAME.findall(name))
