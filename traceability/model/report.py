"""The report: the findings, the verdicts and the measured values of a run. The model does not
contain them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from traceability.schema import Clause, Finding

# State of a requirement or of a fault scenario -> its words, if they differ from the state.
WORDS = {"partly": "partly verified", "unverified": "not verified"}


def words_of(state: str) -> str:
    """Returns the words for a state on the pages and in the exported files."""
    return WORDS.get(state, state)


@dataclass(frozen=True)
class Verdict:
    """The state of a requirement or of a safety goal, and the reasons if it is not verified.

    The state of a requirement is "verified", "partly", "suspect", "failed", "stale" or
    "unverified". The state of a goal is "verified", "open" or "failed"."""

    state: str
    reasons: Sequence[str] = ()


@dataclass(frozen=True)
class Report:
    """The findings, verdicts and measured values of a run. The keys of each mapping are the ids or
    names of the items that the values describe."""

    findings: Sequence[Finding] = ()
    requirements: Mapping[str, Verdict] = field(default_factory=dict)
    goals: Mapping[str, Verdict] = field(default_factory=dict)
    # Fault scenario -> "verified", "failed", "stale" or "unverified".
    scenarios: Mapping[str, str] = field(default_factory=dict)
    # id of a pattern application -> clauses of this application
    clauses: Mapping[str, Sequence[Clause]] = field(default_factory=dict)
    # metric that is evidence for a requirement -> measured value
    measured: Mapping[str, float | None] = field(default_factory=dict)
