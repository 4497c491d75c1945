"""Each check has a description. Each clause of the patterns has code that checks it."""

from __future__ import annotations

import re
from pathlib import Path

from traceability.checks.pattern_clauses import CLAUSES
from traceability.checks.registry import CHECKS, KNOWN, WHY

CHECKS_FOLDER = Path(__file__).parents[3] / "traceability" / "checks"


def test_ids_are_unique_and_texts_are_whole_sentences() -> None:
    assert len(KNOWN) == len(CHECKS)
    for check in CHECKS:
        for text in (check.why, check.holds, check.blind, check.fix):
            assert text.endswith("."), f"{check.id}: {text}"


def test_every_clause_of_the_design_has_code_and_the_other_way_round() -> None:
    declared = {name for name in KNOWN if name in CLAUSES}
    assert declared == set(CLAUSES)
    other = {
        "known",
        "change",
        "role-unknown",
        "role-missing",
        "role-required",
        "count",
        "subclass-unbound",
    }
    patterns = {name.removeprefix("pattern-") for name in KNOWN if name.startswith("pattern-")}
    assert patterns - other == {name.removeprefix("pattern-") for name in CLAUSES}


def test_every_reported_id_is_described() -> None:
    text = "".join(path.read_text(encoding="utf-8") for path in CHECKS_FOLDER.glob("*.py"))
    families = "|".join(WHY)
    used = set(re.findall(rf'"((?:{families})-[a-z-]+)"', text))
    assert used <= set(KNOWN), used - set(KNOWN)
