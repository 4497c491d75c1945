"""./wr campaign loads: the longest control cycles of random drives, and the bound for them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from tools.campaign.loads import LISTED, summarise
from traceability.checks.time_checks import exceeded
from traceability.reading.published import Published
from traceability.schema import PathBound, TimeProof

CASES = [
    {"seed": number, "noise": False, "longest_ns": 1_000_000 - 1_000 * number}
    for number in range(99)
]
NOISY = {"seed": 99, "noise": True, "longest_ns": 1_500_000}
PATH = PathBound("order", "Order to duty cycle", [("wait", 100.0), ("cycle", 1.0)], 101.0, "why")
PROOF = TimeProof(
    contexts=[],
    cycle_ms=1.0,
    noise_ms=2.0,
    seen_ms=None,
    paths=[PATH],
    unbound=[],
    unresolved=[],
)


def findings(
    longest_ms: float, proof: TimeProof = PROOF, noise_ms: float | None = None
) -> list[str]:
    outcomes = {"longest_ms": longest_ms, "noise_ms": noise_ms}
    record = Published("./wr campaign loads", "c", "d", {"outcomes": outcomes})
    model: Any = SimpleNamespace(times=proof, campaigns={"loads": record})
    facts: Any = None
    return [finding.text for finding in exceeded(model, facts)]


def test_the_summary_has_the_longest_drives(tmp_path: Path) -> None:
    summary = summarise(tmp_path, [*reversed(CASES), NOISY])
    assert summary["outcomes"] == {
        "longest_ms": 1.0,
        "median_ms": 0.951,
        "noise_ms": 1.5,
        "noisy": 1,
    }
    assert [case["seed"] for case in summary["longest"]] == [99, *range(LISTED - 1)]


def test_a_random_drive_that_exceeds_the_bound_is_a_finding() -> None:
    assert findings(1.0) == []
    (text,) = findings(1.001)
    assert "a control cycle of a random drive took 1.001 ms" in text


def test_a_drive_with_noise_has_its_own_bound() -> None:
    assert findings(1.0, noise_ms=2.0) == []
    (text,) = findings(1.0, noise_ms=2.001)
    assert "a control cycle of a random drive with noise took 2.001 ms" in text


def test_a_path_that_takes_longer_than_its_bound_is_a_finding() -> None:
    (text,) = findings(1.0, replace(PROOF, paths=[replace(PATH, seen_ms=101.1)]))
    assert (
        "the path 'Order to duty cycle' took 101.100 ms, which is more than the bound of 101.000"
        in text
    )


def test_a_lock_of_the_interrupts_without_a_bound_is_a_finding() -> None:
    (text,) = findings(1.0, replace(PROOF, unbound_locks=[("now", None)]))
    assert text == "a lock of the interrupts in now contains a loop or a call, and has no bound"


def test_without_a_bound_nothing_exceeds_it() -> None:
    assert not [
        text for text in findings(9.0, replace(PROOF, unbound=[("f", None)])) if "took" in text
    ]
