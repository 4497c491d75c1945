"""Requirements that are verified by the measurements of tools."""

from __future__ import annotations

import pytest

from traceability.checks.registry import KNOWN
from traceability.checks.requirement_checks import unmet
from traceability.model.design_model import Model
from traceability.model.evidence import measured_values, read_evidence
from traceability.model.verdicts import make_report
from traceability.schema import Finding, Place, Requirement

PLACE = Place("requirements/a.dox", 3)
FIGURES = {
    "coverage.line": 98.5,
    "firmware.flash_bytes": None,
    "bench.scenarios": [{"name": "a", "max_ms": 0.2}, {"name": "b", "max_ms": 0.4}],
    "patterns.by_pattern": {"State": 5},
}


def model_with(text: str) -> Model:
    evidence = [read_evidence(text, PLACE)]
    requirement = Requirement("NFR-9", "It shall.", "Qualities", PLACE, evidence=evidence)
    return Model("", "", "", {}, requirements={"NFR-9": requirement})


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("coverage.line at least 98 %", []),
        ("coverage.line at most 98.5 %", []),
        ("coverage.line exactly 98.5", []),
        ("coverage.line at least 99 %", ["coverage.line is 98.5 and must be at least 99 %"]),
        ("coverage.line at most 98", ["coverage.line is 98.5 and must be at most 98"]),
        ("coverage.line exactly 98", ["coverage.line is 98.5 and must be exactly 98"]),
        ("bench.scenarios.max_ms at most 0.4 ms", []),
        (
            "bench.scenarios.max_ms at most 0.3 ms",
            ["bench.scenarios.max_ms is 0.4 and must be at most 0.3 ms"],
        ),
        ("bench.scenarios.avg_ms at most 9", ["bench.scenarios.avg_ms was not measured"]),
        ("firmware.flash_bytes at most 9", ["firmware.flash_bytes was not measured"]),
        ("patterns.by_pattern at most 9", ["patterns.by_pattern was not measured"]),
        ("checks.module-names at most 0", ["checks.module-names was not measured"]),
        ("nothing at most 9", ["nothing was not measured"]),
        ("coverage.line above 98", ["its evidence cannot be read: coverage.line above 98"]),
        ("checks.uses-extension exactly 0 findings", []),
        ("checks.module-* exactly 2 findings", []),
        ("checks.module-name at most 0", ["checks.module-name is 1 and must be at most 0"]),
    ],
)
def test_evidence_holds_or_says_why_not(text: str, wrong: list[str]) -> None:
    model = model_with(text)
    found = [Finding(PLACE, check, "", "") for check in ("module-name", "module-spec")]
    measured = measured_values(model, FIGURES, found, KNOWN)
    verdict = make_report(model, [], {}, measured).requirements["NFR-9"]
    assert verdict.reasons == wrong
    assert verdict.state == ("unverified" if wrong else "verified")
    # The check module-name already reports the counted findings.
    own = [] if text.startswith("checks.module-name ") else wrong
    assert [one.check for one in unmet(model, measured, found)] == ["req-evidence"] * len(own)


def test_with_stale_results_a_missing_measurement_is_no_finding() -> None:
    model = model_with("firmware.flash_bytes at most 9")
    stale = Finding(PLACE, "req-stale", "", "")
    measured = measured_values(model, FIGURES, [stale], KNOWN)
    assert list(unmet(model, measured))
    assert not list(unmet(model, measured, [stale]))


def test_what_was_not_measured_yet_verifies_nothing() -> None:
    model = model_with("coverage.line at least 98 %")
    assert make_report(model, [], {}, {}).requirements["NFR-9"].state == "unverified"
