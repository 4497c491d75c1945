"""Finds the likely changes that were really made, and the results of their tests. A folder below
``changes`` or an extension makes such a change."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from traceability.model.design_model import Model
from traceability.reading.change_kits import Kit, KitRecord, target_of
from traceability.schema import HOST, VIRTUAL_K64, KitTest, MadeChange


def made(
    model: Model,
    kits: Mapping[str, Kit],
    record: KitRecord | None,
    examples: Mapping[str, list[str]],
) -> dict[str, MadeChange]:
    """Returns the likely changes that were made, by the id of the pattern application."""
    return {
        name: _made(model, kit, record, kit.classes or examples.get(name, []))
        for name, kit in kits.items()
    }


def _made(model: Model, kit: Kit, record: KitRecord | None, classes: list[str]) -> MadeChange:
    images = record.images if record else {}
    changed, unchanged = images.get(kit.image, {}), images.get(kit.base, {})

    def added(key: str) -> float | None:
        both = key in changed and key in unchanged
        return changed[key] - unchanged[key] if both else None

    return MadeChange(
        application=kit.application,
        event=kit.event,
        hard=kit.hard,
        why=kit.why,
        classes=classes,
        extension=kit.extension,
        files=kit.files or _files_of(model, kit, classes),
        patched=kit.touched.files,
        composition_lines=kit.touched.composition,
        outside_lines=kit.touched.outside,
        added_lines=kit.touched.added,
        flash=added("flash"),
        ram=added("ram"),
        instructions=added("instructions"),
        tests=[*_own_tests(kit, record), *_named_tests(model, kit)],
        place=kit.place,
    )


def _files_of(model: Model, kit: Kit, classes: list[str]) -> list[str]:
    """Returns the files that an extension adds for the change: the headers of the classes, their
    ``.cpp`` files, and the file of the main program, if the extension has one."""
    headers = [model.modules[name].place.file for name in classes if name in model.modules]
    sources = [name.replace(".hpp", ".cpp") for name in headers]
    composition = [file for file in model.files if file.startswith(f"{kit.extension}/k64/main")]
    return [*headers, *(source for source in sources if source in model.files), *composition[:1]]


def _own_tests(kit: Kit, record: KitRecord | None) -> Iterator[KitTest]:
    for name, place in kit.tests.items():
        result = record.tests.get(name) if record else None
        yield KitTest(name, target_of(name), result.result if result else None, place)


def _named_tests(model: Model, kit: Kit) -> Iterator[KitTest]:
    for name in kit.named_tests:
        if test := model.tests.get(name):
            for binding, outcome in test.results.items():
                result = None if model.stale_on(binding) else outcome.result
                yield KitTest(name, binding, result, test.place)


def proven(change: MadeChange | None) -> bool:
    return change is not None and not unproven(change)


def unproven(change: MadeChange) -> str:
    """Returns the reason why the tests do not prove that a change works. The reason is empty if all
    tests of the change passed with the present sources, and each target has at least one of these
    tests."""
    results = {test.result for test in change.tests}
    missing = sorted({HOST, VIRTUAL_K64} - {test.target for test in change.tests})
    if failed := [test.id for test in change.tests if test.result not in ("passed", None)]:
        return f"{failed[0]} did not pass"
    if None in results:
        return "its tests did not run with the present sources: run ./wr test --all"
    return f"the change has no test on this target: {', '.join(missing)}" if missing else ""
