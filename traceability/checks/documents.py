"""syntax-error and doc-warning: the sources can be read."""

from __future__ import annotations

import re

from traceability.model.facts import Facts
from traceability.model.schema import Finding, Model

UNKNOWN_REQUIREMENT = re.compile(r"(satisfies|verifies)|[Rr]equirement")


def check(_model: Model, facts: Facts) -> list[Finding]:
    found = [
        Finding(place, "syntax-error", text, "correct the code")
        for place, text in facts.syntax.errors
    ]
    for warning in facts.annotations.warnings:
        unknown = UNKNOWN_REQUIREMENT.search(warning.text)
        known = "req-unknown" if unknown else "doc-warning"
        mend = "name a requirement that exists" if unknown else "correct the comment"
        found.append(Finding(warning.place, known, warning.text.rstrip(" ."), mend))
    return found
