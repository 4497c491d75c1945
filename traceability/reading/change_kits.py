"""Reads the folders of ``changes/`` and the results of their tests. Each folder contains one likely
change that was really made."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from traceability.reading.baseline_record import count_patch
from traceability.reading.gtest_cases import read_tests
from traceability.reading.products import PAPER
from traceability.reading.results import RESULTS, read_fresh, results_in
from traceability.reading.task_record import CHANGES
from traceability.reading.toml_reader import Entries
from traceability.schema import HOST, VIRTUAL_K64, BindingResult, Place
from traceability.sources import text_of

FOLDER = Path("changes")
RESULT = RESULTS / "changes.json"
DECLARED, PATCH, IMAGE = "change.toml", "composition.patch", "change_"
# Folders of the composition, whose files create the objects and connect them.
COMPOSITION = ("src/construction/", "src/k64/start_up/")
# The composition of the pattern design. The comparison with the baseline design uses this file.
COMPARED = "tests/usual_design/patterns/PatternDesign."
# If the name of a test suite ends with this word, the suite executes the firmware image of a change
# on the virtual K64.
ON_BOARD = "OnBoard"
CLASS = re.compile(r"^class (\w+)(?: final)?(?: : public (\w+))?", re.MULTILINE)
PART_OF_PATCH = re.compile(r"^--- .*?(?=^--- |\Z)", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True)
class TouchedLines:
    """The existing files that a patch edits, and numbers of lines in these files."""

    outside: int = 0  # lines outside the composition that the patch removes or edits
    composition: int = 0  # lines of the composition that the patch removes or edits
    added: int = 0  # new lines
    files: Sequence[str] = ()


@dataclass
class Kit:
    """One likely change: its declaration, its added files, and the lines that it edits."""

    application: str
    event: str
    place: Place
    # description of the change in the list of hard changes on the page of the likely changes; "" if
    # the list does not contain the change
    hard: str = ""
    why: str = ""  # reason why the change must edit existing files
    # added classes that have the role ``adds`` of the recipe
    classes: list[str] = field(default_factory=list)
    extension: str = ""  # folder of the extension that makes the change
    image: str = ""
    base: str = PAPER  # firmware image without the change, for the comparison
    # Suite.Name of a test -> place of the test
    tests: dict[str, Place] = field(default_factory=dict)
    # names of tests that are part of an extension
    named_tests: list[str] = field(default_factory=list)
    files: list[str] = field(default_factory=list)  # added files, without tests
    bases: dict[str, str] = field(default_factory=dict)  # class in an added file -> its base class
    touched: TouchedLines = TouchedLines()


@dataclass(frozen=True)
class KitRecord:
    """The results of the tests of all changes, and the costs of the firmware images with the
    changes."""

    tests: Mapping[str, BindingResult]
    # for each image: flash and RAM [byte], and instructions in a cycle
    images: Mapping[str, Mapping[str, float]]


def read_kits(root: Path, entries: Entries) -> dict[str, Kit]:
    """Returns the likely changes by the id of their pattern application. Each folder with a
    declaration contains one change."""
    kits = [_kit(root, path, entries) for path in sorted((root / FOLDER).glob(f"*/{DECLARED}"))]
    return {kit.application: kit for kit in kits if kit}


def _kit(root: Path, path: Path, entries: Entries) -> Kit | None:
    item: dict[str, Any] = dict(entries.whole(path))
    place = Place(str(path.relative_to(root)), 1)
    texts = dict.fromkeys(("hard", "why", "extension", "image", "base"), str)
    may = texts | dict.fromkeys(("classes", "tests", "files"), list)
    if not entries.fits(item, place, {"event": str}, may):
        return None
    folder = path.parent
    item["named_tests"] = item.pop("tests", [])
    kit = Kit(application=folder.name, place=place, **item)
    kit.image = kit.image or IMAGE + folder.name
    own = sorted(path for path in folder.iterdir() if path.suffix in (".hpp", ".cpp"))
    for source in own:
        if source.stem.endswith("Test"):
            kit.tests |= tests_in(root, source)
        else:
            kit.files.append(str(source.relative_to(root)))
            text = source.read_text(encoding="utf-8")
            kit.bases |= {match[1]: match[2] or "" for match in CLASS.finditer(text)}
    kit.touched = touched_lines(text_of(folder / PATCH))
    return kit


def touched_lines(patch: str) -> TouchedLines:
    parts = [count_patch(part) for part in PART_OF_PATCH.findall(patch)]
    composed = sum(
        one.lines_touched
        for one in parts
        if all(name.startswith((*COMPOSITION, COMPARED)) for name in one.files_changed)
    )
    return TouchedLines(
        outside=sum(one.lines_touched for one in parts) - composed,
        composition=composed,
        added=sum(one.lines_added for one in parts),
        files=[name for one in parts for name in one.files_changed],
    )


def tests_in(root: Path, source: Path) -> dict[str, Place]:
    """Returns the place of each test in a file, by ``Suite.Name``."""
    file, text = str(source.relative_to(root)), source.read_text(encoding="utf-8")
    return {case.id: Place(file, case.line) for case in read_tests(text)}


def target_of(test: str) -> str:
    return VIRTUAL_K64 if test.partition(".")[0].endswith(ON_BOARD) else HOST


def read_record(root: Path) -> KitRecord | None:
    """Returns the results of the changes. Returns None if they do not belong to the present
    sources."""
    data = read_fresh(root, RESULT, CHANGES)
    return KitRecord(results_in(data), data["images"]) if data else None


def images_of(kits: Iterable[Kit]) -> list[str]:
    """Returns the names of the firmware images with the changes, and of the images with which they
    are compared."""
    return sorted({image for kit in kits for image in (kit.image, kit.base)})
