"""The report: the results of this run. No step writes them into the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from traceability.schema import Clause, Finding


@dataclass(frozen=True)
class Verdict:
    """The state of a requirement or of a safety goal, with the reason why it is not verified.

    The state of a requirement is "verified", "partly", "suspect", "failed", "stale" or
    "unverified". The state of a goal is "verified", "open" or "failed".
    """

    state: str
    reasons: Sequence[str] = ()


@dataclass(frozen=True)
class Report:
    """The findings, verdicts and measured values of a run, each by the id or name of its
    subject."""

    findings: Sequence[Finding] = ()
    requirements: Mapping[str, Verdict] = field(default_factory=dict)
    goals: Mapping[str, Verdict] = field(default_factory=dict)
    # Fault scenario -> "verified", "failed", "stale" or "unverified".
    scenarios: Mapping[str, str] = field(default_factory=dict)
    clauses: Mapping[str, Sequence[Clause]] = field(default_factory=dict)  # application -> clauses
    # key: the metric of an evidence
    measured: Mapping[str, float | None] = field(default_factory=dict)
