"""The verdicts of requirements and of the safety case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from traceability.model.design_model import Model
from traceability.model.evidence import reasons as reasons_of_evidence
from traceability.model.report import Report, Verdict
from traceability.model.safety_case import safety_verdicts
from traceability.reading.traces import nodes_of
from traceability.schema import BINDINGS, Clause, Finding, Requirement


def make_report(
    model: Model,
    findings: Sequence[Finding],
    clauses: Mapping[str, Sequence[Clause]],
    measured: Mapping[str, float | None],
) -> Report:
    requirements = {
        name: requirement_verdict(model, requirement, measured)
        for name, requirement in model.requirements.items()
    }
    scenarios, goals = safety_verdicts(model, requirements)
    return Report(findings, requirements, goals, scenarios, clauses, measured)


def requirement_verdict(
    model: Model, requirement: Requirement, measured: Mapping[str, float | None]
) -> Verdict:
    reasons = _reasons(model, requirement, measured)
    if any(model.tests[name].gave("failed") for name in requirement.verified_by):
        return Verdict("failed", reasons)
    if reasons:
        return Verdict("unverified", reasons)
    return Verdict("stale" if model.results_stale else _sound_state(requirement), reasons)


def _sound_state(requirement: Requirement) -> str:
    """Returns the state of a requirement if its tests passed and its measured values meet their
    bounds."""
    if requirement.suspicions:
        return "suspect"
    return "partly" if requirement.partly else "verified"


def _reasons(
    model: Model, requirement: Requirement, measured: Mapping[str, float | None]
) -> list[str]:
    reasons: list[str] = []
    for evidence in requirement.evidence:
        reasons += reasons_of_evidence(evidence, measured.get(evidence.figure))
    if requirement.by_calls and not requirement.satisfied_by:
        reasons.append("no method satisfies this requirement")
    if not requirement.evidence and not requirement.verified_by:
        reasons.append("no test verifies this requirement")
    for result, words in (("failed", "failed"), ("skipped", "skipped"), (None, "did not run")):
        for binding in BINDINGS:
            tests = [n for n in requirement.verified_by if binding in model.tests[n].gave(result)]
            if tests:
                reasons.append(f"{words} on the {binding}: {', '.join(tests)}")
    if requirement.tree is None:
        without = "this requirement has no tree of invocations"
        return [*reasons, without] if requirement.by_calls else reasons
    nodes = nodes_of(requirement.tree)
    reasons += [f"no call reaches {node.label}" for node in nodes if not node.reachable]
    if not requirement.runs:
        reasons.append("no passing test executed the tree of invocations")
    return reasons
