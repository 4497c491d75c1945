"""The side navigation: the same on every page, with counts from the model."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from traceability.documents.portal import Portal

FIRST = ("tour", "quick_start")
EXPLAIN = {"tour", "execution_model", "glossary", "annotations", "add_reading_mode"}


@dataclass
class Doc:
    """A hand-written page."""

    name: str
    title: str

    @property
    def address(self) -> str:
        return f"docs/{self.name}.html"


@dataclass
class Entry:
    id: str
    title: str
    address: str
    key: str = ""
    count: int | None = None


@dataclass
class Group:
    id: str
    title: str
    entries: list[Entry]


def hand_written(folder: Path) -> list[Doc]:
    """The pages below ``docs/``, the ones to begin with first."""
    pages = [
        Doc(str(path.relative_to(folder).with_suffix("")), first_title(path))
        for path in sorted(folder.rglob("*.rst"))
    ]
    return sorted(pages, key=lambda doc: (doc.name not in FIRST, doc.title.lower()))


def first_title(path: Path) -> str:
    """The text above the first underline of a page."""
    lines = path.read_text(encoding="utf-8").splitlines()
    for above, line in pairwise(lines):
        if above.strip() and len(line) > 2 and set(line) <= set("=-~#*^"):
            return above.strip()
    return path.stem


class Navigation:
    """Three groups, as there are three reasons to come here."""

    def __init__(self, portal: Portal) -> None:
        model = portal.model
        modules = [m for m in model.modules.values() if not m.datatype]
        trees = sum(requirement.tree is not None for requirement in model.requirements.values())
        tour = [d for d in portal.docs if d.name == "tour"]
        explain = [d for d in portal.docs if d.name in EXPLAIN and d not in tour]
        use = [d for d in portal.docs if d.name not in EXPLAIN]
        understand = [
            Entry("architecture", "Architecture", "architecture.html"),
            Entry("structure", "Module structure", "structure.html", "", len(modules)),
            Entry("guide", "Module guide", "guide.html", "G"),
            Entry("interfaces", "Interfaces", "interfaces.html", "I"),
            Entry(
                "datatypes", "Data types", "datatypes.html", "", len(model.modules) - len(modules)
            ),
            Entry(
                "patterns", "Pattern applications", "patterns/index.html", "P", len(model.patterns)
            ),
            Entry("machines", "State machines", "machines.html", "", len(model.machines)),
            Entry("uses", "Uses", "uses.html"),
        ]
        verify = [
            Entry(
                "requirements",
                "Requirements",
                "requirements/index.html",
                "R",
                len(model.requirements),
            ),
            Entry("trees", "Invocation trees", "trees.html", "", trees),
            Entry("tests", "Tests", "tests.html", "T", len(model.tests)),
            Entry("checks", "Checks", "checks/index.html", "", len(portal.checks)),
        ]
        self.groups = [
            Group(
                "understand", "Understand", [*map(entry, tour), *understand, *map(entry, explain)]
            ),
            Group("verify", "Verify", verify),
            Group(
                "build",
                "Build and use",
                [*map(entry, use), Entry("source", "Source", "source/index.html", "S")],
            ),
        ]

    def data(self) -> list[dict[str, object]]:
        return [asdict(group) for group in self.groups]

    def group_of(self, nav: str) -> str:
        for group in self.groups:
            if any(entry.id == nav for entry in group.entries):
                return group.id
        return ""


def entry(doc: Doc) -> Entry:
    return Entry(f"docs/{doc.name}", doc.title, doc.address)
