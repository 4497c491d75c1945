"""req-unknown: each id in a text belongs to a requirement, hazard, safety goal or assumption."""

from __future__ import annotations

import re
from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import text_lines
from traceability.schema import Finding

IDS = {
    "requirement": r"N?FR-\d+",
    "hazard": r"HZ-\d+",
    "safety goal": r"SG-\d+",
    "assumption": r"AU-\d+",
}
ID = re.compile(rf"(?<![\w-])({'|'.join(IDS.values())})(?!\w)")
# Entries of TOML files, and tags. They are left out here, because other findings report the wrong
# ids in them.
ENTRY = re.compile(r'"[A-Z]+-\d+"|@(?:satisfies|verifies|goal) [A-Z]+-\d+')


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    safety = model.safety
    ids = {*model.requirements, *safety.hazards, *safety.goals, *safety.assumptions}
    for place, line in text_lines(facts.root):
        for name in ID.findall(ENTRY.sub("", line)) if "-" in line else ():
            if name not in ids:
                yield Finding(place, "req-unknown", f"there is no {_kind(name)} {name}")


def _kind(name: str) -> str:
    return next(kind for kind, ids in IDS.items() if re.fullmatch(ids, name))
