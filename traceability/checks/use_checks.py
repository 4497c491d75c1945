"""uses-*: a logic module uses only the logic modules that the design allows, and no undeclared
cycle of uses exists."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import product
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.graphs import descendants
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.reading.syntax import includes_of
from traceability.reading.translation_units import is_board
from traceability.schema import AllowedUse, Finding, Place, Use, is_extension
from traceability.sources import DESIGN, files_below

VIRTUAL_BOARD = "sim/emulator/"
# Folders of test programs that contain drivers and run on the virtual K64. These programs may
# include the headers of the drivers.
PROGRAMS = ("tests/k64/program/", "tests/usual_design/k64/")
OF_FIRMWARE = tuple(f"{name}/" for name in DESIGN)
MICROCONTROLLER = {"K64", "Kinetis"}
NAMED = re.compile(r"\b(?:K64\w*|Kinetis)\b")


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    allowed = [use for use in model.uses if _is_allowed(model, use)]
    yield from _forbidden(model)
    yield from _extensions(model)
    yield from _numbers_of_extensions(facts)
    yield from _apart(facts)
    yield from _unused(model)
    yield from _idle_cycles(model, facts)
    yield from _cycles(allowed, facts)
    yield from _board(facts.root)
    yield from _drivers(model, facts.root)


def _drivers(model: Model, root: Path) -> Iterator[Finding]:
    """Outside the folders of the K64, finds files of the firmware that name a driver or the
    microcontroller. The name can be in the code or in a comment."""
    drivers = {module.name for module in model.modules.values() if is_board(module.header)}
    for place, line in lines_below(root, DESIGN, (".hpp", ".cpp", ".dox")):
        for name in (drivers | MICROCONTROLLER).intersection(NAMED.findall(line)):
            if is_board(place.file):
                continue
            text = f"the file names {name}"
            yield Finding(place, "uses-board", text, "name the interface of the driver")


def _board(root: Path) -> Iterator[Finding]:
    """Finds files of the simulator and of the tests that include a header of a K64 driver. Also
    finds files of the virtual K64 that include a file of the firmware."""
    for path in files_below(root, ("sim", "tests"), (".cpp", ".hpp", ".h")):
        file = str(path.relative_to(root))
        for include in includes_of(root, file):
            if is_board(include.target) and not file.startswith(PROGRAMS):
                text = f"{file} includes {include.target}, which only a composition may include"
                fix = "test the image on the virtual K64 instead"
            elif file.startswith(VIRTUAL_BOARD) and include.target.startswith(OF_FIRMWARE):
                text = f"the virtual K64 includes {include.target} of the firmware"
                fix = (
                    "write the facts from the manual of the microcontroller; otherwise the driver "
                    "and its model can share a mistake"
                )
            else:
                continue
            yield Finding(include.place, "uses-board", text, fix)


def _covers(allowed: AllowedUse, use: Use) -> bool:
    return allowed.source in ("*", use.source) and allowed.target == use.target


def _is_allowed(model: Model, use: Use) -> bool:
    return any(_covers(allowed, use) for allowed in model.allowed_uses)


def _forbidden(model: Model) -> Iterator[Finding]:
    for use in model.uses:
        if not _is_allowed(model, use):
            text = f"{use.source} uses {use.target}, but design/uses.toml does not allow this use"
            yield from (Finding(place, "uses-allowed", text) for place in use.places)


def _extensions(model: Model) -> Iterator[Finding]:
    """Finds files in src that use an extension. Also finds extensions that use another extension
    although design/uses.toml states no reason for this use."""
    # An extension may use another extension if design/uses.toml states the reason. The files in src
    # must never use an extension.
    builds_on = {(use.source, use.target) for use in model.allowed_uses if is_extension(use.source)}
    for use in model.uses:
        of_other = is_extension(use.target) and _extension(use.source) != _extension(use.target)
        if of_other and (use.source, use.target) not in builds_on:
            text = f"{use.source} uses the extension {use.target}"
            yield from (Finding(place, "uses-extension", text) for place in use.places)


def _numbers_of_extensions(facts: Facts) -> Iterator[Finding]:
    """Finds places in src that use a number which an extension adds to an enumeration of src. To
    add the number, the extension converts it to the type of the enumeration."""
    numbers = facts.syntax.enum_numbers
    added: dict[tuple[str, float], Place] = {
        (fact.kind, fact.number): fact.place for fact in numbers if is_extension(fact.place.file)
    }
    named = {
        (kind.name, constant.number): constant.place
        for kind in facts.syntax.classes
        for value in kind.values
        for constant in facts.syntax.values
        if constant.name == f"{kind.name}::{value.name}"
    }
    uses = [*named.items(), *(((fact.kind, fact.number), fact.place) for fact in numbers)]
    for key, place in uses:
        if key in added and not is_extension(place.file):
            extension = added[key].file
            text = f"{key[0]} has the number {key[1]} here, but {extension} adds this number"
            yield Finding(place, "uses-extension", text, "keep the number only in the extension")


def _extension(logic: str) -> list[str]:
    """Returns the two folder names that identify the extension of a logic module. Returns an empty
    list for a logic module in src."""
    return logic.split("/")[:2] if is_extension(logic) else []


def _unused(model: Model) -> Iterator[Finding]:
    for allowed in model.allowed_uses:
        if not any(_covers(allowed, use) for use in model.uses):
            text = f"{allowed.source} does not use {allowed.target}"
            yield Finding(allowed.place, "uses-unused", text)
    everybody = {use.target for use in model.allowed_uses if use.source == "*"}
    for allowed in model.allowed_uses:
        if allowed.source != "*" and allowed.target in everybody:
            text = (
                f"every module may use {allowed.target}, so the entry of {allowed.source} has no "
                "effect"
            )
            yield Finding(allowed.place, "uses-unused", text, "remove one of the two entries")


def _cycles(uses: list[Use], facts: Facts) -> Iterator[Finding]:
    """Finds cycles in the uses that the design allows. Uses that are not allowed are ignored here,
    because uses-allowed reports them."""
    declared = {frozenset(cycle.modules) for cycle in facts.declared.cycles}
    for use in uses:
        top, other = use.source.split("/")[0], use.target.split("/")[0]
        if top != other:
            graph = _graph(uses, depth=1)
            if top in descendants(other, graph):
                yield _finding(use, f"{top} and {other} use each other, directly or indirectly")
            continue
        graph = _graph(uses, depth=9)
        loop = descendants(use.target, graph)
        if use.source in loop:
            members = {m for m in loop if use.source in descendants(m, graph)}
            if not any(members <= cycle for cycle in declared):
                names = ", ".join(sorted(members))
                text = f"the uses of {names} form a cycle that design/uses.toml does not declare"
                yield _finding(use, text)


def _apart(facts: Facts) -> Iterator[Finding]:
    """Finds modules that name another module although design/uses.toml demands that the two
    modules are separate."""
    pairs = {
        pair
        for rule in facts.declared.apart
        for one, two in product(rule.modules, rule.others)
        for pair in ((one, two), (two, one))
    }
    first: dict[tuple[str, int, str, str], Place] = {}
    for user in {user for user, _ in pairs}:
        for place, target in facts.named_by(user):
            if (user, target) in pairs:
                first[place.file, place.line, user, target] = place
    for (_, _, user, target), place in first.items():
        text = (
            f"{user} names {target}, but design/uses.toml demands that these modules do not name "
            "each other"
        )
        yield Finding(place, "uses-apart", text)
    for rule in facts.declared.apart:
        for name in (*rule.modules, *rule.others):
            if name not in facts.classes:
                text = f"there is no module {name}"
                yield Finding(rule.place, "uses-apart", text, "correct the name")


def _idle_cycles(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds declared cycles that do not exist in the code."""
    graph = _graph(model.uses, depth=9)
    for cycle in facts.declared.cycles:
        for module in cycle.modules[1:]:
            first = cycle.modules[0]
            both = module in descendants(first, graph) and first in descendants(module, graph)
            if not both:
                text = f"no cycle of uses contains {module} and {first}"
                yield Finding(cycle.place, "uses-unused", text)
        for module in cycle.modules:
            if module.split("/")[0] != cycle.within:
                text = f"{module} is not within {cycle.within}"
                yield Finding(cycle.place, "uses-unused", text, "correct the folder")


def _finding(use: Use, text: str) -> Finding:
    return Finding(use.places[0], "uses-cycle", text)


def _graph(uses: Iterable[Use], depth: int) -> dict[str, set[str]]:
    graph: dict[str, set[str]] = {}
    for use in uses:
        source = "/".join(use.source.split("/")[:depth])
        target = "/".join(use.target.split("/")[:depth])
        if source != target:
            graph.setdefault(source, set()).add(target)
    return graph
