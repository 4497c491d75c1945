"""change-tuned: if the value of a constant depends on the cycle time or the tick time, the code
computes the value from this time, or design/tuned.toml declares the dependence."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place
from traceability.sources import DESIGN, files_below

WRITTEN = re.compile(
    r"^\s*(?:\[\[maybe_unused\]\] )?(?:static |inline )*constexpr [\w:<>, ]+? (k\w+)\b[^/]*"
    r"(?://(.*))?$"
)
REMARK = re.compile(r"^\s*//(.*)$")
# If the name or the comment of a constant contains one of these words, the constant probably
# depends on the named constant of SystemConstants.
SIGNS = {
    "SystemConstants::cyclePeriod": re.compile(r"(?<!duty )\b[Cc]ycles?\b|[a-z]Cycles?\b"),
    "SystemConstants::tickPeriod": re.compile(r"\bticks?\b|Ticks?\b"),
}
DECLARATIONS = "design/tuned.toml"


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
    yield from _unknown(model, constants)
    yield from _undeclared(model, facts, constants)


def written(facts: Facts) -> Iterator[Written]:
    for path in files_below(facts.root, DESIGN, (".cpp", ".hpp")):
        above: list[str] = []
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = WRITTEN.match(line)
            if match:
                text = " ".join((*above, match[1], match[2] or ""))
                place = Place(str(path.relative_to(facts.root)), number)
                yield Written(f"{path.stem}::{match[1]}", line.split("//")[0], text, place)
            remark = REMARK.match(line)
            above = [*above, remark[1]] if remark else []


def _unknown(model: Model, constants: dict[str, Written]) -> Iterator[Finding]:
    """Finds entries of design/tuned.toml that name a constant which does not exist."""
    methods = {method.id for module in model.modules.values() for method in module.methods}
    for item in model.tuned:
        for name in [item.to, *item.constants]:
            if name not in methods and name not in constants:
                text = f"there is no constant {name}"
                yield Finding(item.place, "change-tuned", text, "correct the name")


def _read_by(constant: Written) -> set[str]:
    """Returns the constants of the same file that the source line of a constant names. The constant
    itself is included."""
    file = constant.name.split("::", maxsplit=1)[0]
    return {f"{file}::{name}" for name in re.findall(r"\bk[A-Z]\w*", constant.code)}


def _undeclared(model: Model, facts: Facts, constants: dict[str, Written]) -> Iterator[Finding]:
    """Finds constants that seem to depend on a constant of SystemConstants, but are neither
    computed from it nor declared in design/tuned.toml."""
    computed = {(fact.name, fact.target) for fact in facts.syntax.initial}
    declared = {(name, item.to) for item in model.tuned for name in item.constants}
    for constant in constants.values():
        for to, sign in SIGNS.items():
            if computed.intersection((name, to) for name in _read_by(constant)):
                computed.add((constant.name, to))
            if sign.search(constant.text) and (constant.name, to) not in computed | declared:
                text = (
                    f"{constant.name} seems to depend on {to}, but is neither computed from it nor "
                    "declared in design/tuned.toml"
                )
                yield Finding(constant.place, "change-tuned", text)
