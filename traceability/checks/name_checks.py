"""doc-name: each name of the code in a text exists in the code or in the paper.

A text is a comment of the code, a literal of a page of docs/, or a text of design/.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.comments import code_of, comment_tokens
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.schema import Finding, Place
from traceability.sources import DESIGN, files_below

# Forms of names in comments. No English word has one of these forms: HallCount, Wheel::stop,
# kPeriod, read().
IN_COMMENT = re.compile(
    r"`([A-Za-z_]\w*(?:::\w+)*)`|\b([A-Z]\w*(?:::\w+)+|[A-Z][a-z]+(?:[A-Z][a-z0-9]+)+"
    r"|k[A-Z][a-z]{2,}\w*|[a-z]\w*(?=\(\)))"
)
IN_PAGE = re.compile(r"``([A-Z]\w*(?:::\w+)+|[A-Z][a-z]+(?:[A-Z][a-z0-9]+)+)``")
IN_DESIGN = re.compile(r"`([A-Za-z_]\w*(?:::\w+)*)`")
IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
FOR_A_TOOL = ("NOLINT", "clang-format")
PLACEHOLDER = "Class"  # In docs/, Class::method is an example that represents any method.
# File of design/ -> the check that reports wrong names in this file. For all other texts, this
# check is doc-name.
CHECKS = {"concordance": "paper-stale", "changes": "pattern-change"}


@dataclass
class Words:
    """All names that a text may contain: names of the code and names of the paper."""

    code: set[str]
    paper: set[str]
    facts: Facts

    def knows(self, name: str) -> bool:
        owner, _, member = name.rpartition("::")
        if not owner:
            return name in self.code or name in self.paper
        if owner == PLACEHOLDER:
            return True
        fact = self.facts.classes.get(owner)
        if fact is None:
            return all(part in self.code for part in name.split("::"))
        return member in self.members(owner)

    def members(self, owner: str) -> set[str]:
        """Returns the names of the members of a class: own members, inherited members and nested
        classes."""
        fact = self.facts.classes.get(owner)
        if fact is None:
            return set()
        names = {method.name for method in fact.methods} | {field.name for field in fact.fields}
        names |= {value.name for value in fact.values}
        inner = f"{owner}::"
        names |= {name.removeprefix(inner) for name in self.facts.classes if name.startswith(inner)}
        return names.union(*(self.members(base) for base in fact.bases))


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    words = _words(model, facts)
    named = [*_comments(facts), *_pages(facts.root), *_design(facts.root)]
    for place, name in named:
        if not words.knows(name):
            text = f"the text names {name}, which the code does not have"
            yield Finding(
                place,
                CHECKS.get(Path(place.file).stem, "doc-name"),
                text,
                "write the name that the code has now",
            )


def _words(model: Model, facts: Facts) -> Words:
    code: set[str] = set()
    for path in files_below(facts.root, (*DESIGN, "sim", "traceability/reading/products.py")):
        if path.suffix in (".hpp", ".cpp", ".py"):
            code.update(IDENTIFIER.findall(code_of(path.read_text(encoding="utf-8"))))
    paper = {word for entry in model.paper for word in re.findall(r"[\w:]+", entry.name)}
    return Words(code, paper, facts)


def _comments(facts: Facts) -> Iterator[tuple[Place, str]]:
    for path in files_below(facts.root, DESIGN, (".hpp", ".cpp")):
        file = str(path.relative_to(facts.root))
        for line, _, written in comment_tokens(path.read_text(encoding="utf-8")):
            for number, text in enumerate(written.split("\n"), line):
                if not any(mark in text for mark in FOR_A_TOOL):
                    for match in IN_COMMENT.finditer(text):
                        yield Place(file, number), match[1] or match[2]


def _pages(root: Path) -> Iterator[tuple[Place, str]]:
    for place, line in lines_below(root, ("docs",), (".rst",)):
        for match in IN_PAGE.finditer(line):
            yield place, match[1]


def _design(root: Path) -> Iterator[tuple[Place, str]]:
    for place, line in lines_below(root, ("design",), (".toml",)):
        for match in IN_DESIGN.finditer("" if line.startswith("#") else line):
            yield place, match[1]
