"""./wr campaign loads: the longest cycles of its drives, and their bound."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from tools.campaign.loads import LISTED, summarise
from traceability.checks.time_checks import check
from traceability.reading.published import Published
from traceability.schema import TimeProof

CASES = [{"seed": number, "longest_ns": 1_000_000 - 1_000 * number} for number in range(99)]
PROOF = TimeProof(contexts=[], cycle_ms=1.0, seen_ms=None, unbound=[], unresolved=[])


def findings(longest_ms: float, proof: TimeProof = PROOF) -> list[str]:
    record = Published("./wr campaign loads", "c", "d", {"outcomes": {"longest_ms": longest_ms}})
    model: Any = SimpleNamespace(times=proof, campaigns={"loads": record})
    facts: Any = None
    return [finding.text for finding in check(model, facts)]


def test_the_summary_has_the_longest_drives(tmp_path: Path) -> None:
    summary = summarise(tmp_path, list(reversed(CASES)))
    assert summary["outcomes"] == {"longest_ms": 1.0, "median_ms": 0.951}
    assert [case["seed"] for case in summary["longest"]] == list(range(LISTED))


def test_a_random_drive_that_exceeds_the_bound_is_a_finding() -> None:
    assert findings(1.0) == []
    (text,) = findings(1.001)
    assert "a control cycle of a random drive took 1.001 ms" in text


def test_without_a_bound_nothing_exceeds_it() -> None:
    assert not [
        text for text in findings(9.0, replace(PROOF, unbound=[("f", None)])) if "took" in text
    ]
