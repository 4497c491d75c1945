"""change-kit: for each likely change, a folder shows how to make it. The recipe of the pattern
demands a role for the new class, and lists altered modules. The folder adds a class with this role,
or edits a file of a listed module."""

from __future__ import annotations

from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.reading.change_kits import Kit
from traceability.reading.source_facts import Facts
from traceability.schema import HOST, VIRTUAL_K64, Finding, LikelyChange, MadeChange


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    if not facts.declared.patterns:
        return
    kits = facts.declared.kits
    for name, kit in kits.items():
        if name not in model.changes:
            yield Finding(kit.place, "change-kit", f"there is no application {name}")
    for name, change in model.changes.items():
        if change.made is None:
            text = f"no folder of changes/ shows how to make the likely change of {name}"
            yield Finding(model.patterns[name].place, "change-kit", text)
        else:
            for text in _change(model, facts, change, change.made, kits[name]):
                yield Finding(change.made.place, "change-kit", text)


def _change(
    model: Model, facts: Facts, change: LikelyChange, made: MadeChange, kit: Kit
) -> Iterator[str]:
    if not made.classes and not made.patched:
        yield "the folder of the change names no class and edits no file"
    for name in made.classes:
        if name not in kit.bases and name not in model.modules:
            yield f"there is no class {name}"
        elif not _plays(model, facts, change, kit, name):
            parts = " or ".join(change.derives or change.altered)
            role = f"{name} has no role in {change.application}"
            uses = "" if change.derives else f", and does not use {parts}"
            yield f"{role}: it does not derive from {parts}{uses}"
    if not made.classes and not _touches(model, change, made):
        yield f"the folder of the change edits none of {', '.join(change.altered)}"
    targets = {test.target for test in made.tests}
    for target in sorted({HOST, VIRTUAL_K64} - targets):
        yield f"the change has no test on {target}"
    for name in set(kit.named_tests) - set(model.tests):
        yield f"there is no test {name}"
    if made.patched and not made.why:
        yield "the change edits existing files, but its folder states no reason"


def _plays(model: Model, facts: Facts, change: LikelyChange, kit: Kit, name: str) -> bool:
    """Returns whether a class in the folder has one of the roles that the recipe demands for the
    new class."""
    above = _above(facts, kit, name)
    if change.derives:
        return not above.isdisjoint(change.derives)
    kin = {
        base
        for module in change.altered
        for base in (*model.modules[module].bases, *model.modules[module].uses)
    }
    uses = set(model.modules[name].uses) if name in model.modules else set()
    altered = set(change.altered)
    return bool(above & kin or uses & altered or _touches(model, change, change.made))


def _touches(model: Model, change: LikelyChange, made: MadeChange | None) -> bool:
    """Returns whether the folder edits the file of a module that the recipe lists as altered."""
    headers = [model.modules[name].place.file for name in change.altered]
    files = {*headers, *(name.replace(".hpp", ".cpp") for name in headers)}
    return made is not None and not files.isdisjoint(made.patched)


def _above(facts: Facts, kit: Kit, name: str) -> set[str]:
    """Returns all base classes of a class in the design or in the folder of the change."""
    if name in facts.classes:
        return facts.bases_of(name)
    base = kit.bases.get(name)
    return {base, *_above(facts, kit, base)} if base else set()
