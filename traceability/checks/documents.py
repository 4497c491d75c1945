"""syntax-error, doc-warning and design-entry: the sources can be read."""

from __future__ import annotations

import re
from pathlib import Path

from traceability.checks.links import missing_paths
from traceability.model.facts import Facts
from traceability.model.schema import Finding, Model, Place
from traceability.sources import files_below

READ = ("src", "extensions", "sim", "tests", "requirements", "design", "docs", "README.md")
SECOND_REQUIREMENT = re.compile(r"duplicate requirement ID '([^']+)'")
UNKNOWN_REQUIREMENT = re.compile(r"(satisfies|verifies)|[Rr]equirement")


def check(_model: Model, facts: Facts) -> list[Finding]:
    found = [
        Finding(place, "syntax-error", text, "correct the code")
        for place, text in facts.syntax.errors
    ]
    found += missing_paths(facts.root)
    for problem in facts.declared.entries.problems:
        found.append(Finding(problem.place, "design-entry", problem.text, problem.mend))
    for warning in facts.annotations.warnings:
        double = SECOND_REQUIREMENT.search(warning.text)
        if double:
            text = f"{double[1]} is the id of another requirement already"
            found.append(Finding(warning.place, "req-text", text, "give it an id of its own"))
            continue
        unknown = UNKNOWN_REQUIREMENT.search(warning.text)
        known = "req-unknown" if unknown else "doc-warning"
        mend = "name a requirement that exists" if unknown else "correct the comment"
        found.append(Finding(warning.place, known, warning.text.rstrip(" ."), mend))
    return found


def not_text(root: Path) -> list[Finding]:
    """The first line of each source that is not UTF-8."""
    found: list[Finding] = []
    for path in files_below(root, READ):
        data = path.read_bytes()
        try:
            data.decode()
        except UnicodeDecodeError as error:
            place = Place(str(path.relative_to(root)), data.count(b"\n", 0, error.start) + 1)
            text = f"the byte {data[error.start]:#x} is not UTF-8"
            found.append(Finding(place, "doc-warning", text, "write the file in UTF-8"))
    return found
