"""Requirements that no call fulfils: what a tool must have measured in this run."""

from __future__ import annotations

import fnmatch
import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from traceability.model.design_model import Model
from traceability.schema import Evidence, Finding, Place

WRITTEN = re.compile(r"(\S+) (at most|at least|exactly) (-?\d+(?:\.\d+)?)(?: (.+))?")
CHECKS = "checks."


def read_evidence(text: str, place: Place) -> Evidence:
    """``coverage.line at least 98 %``: figure, relation, bound and unit."""
    match = WRITTEN.fullmatch(text)
    if match is None:
        return Evidence(text, "", 0, "", place)
    return Evidence(match[1], match[2], float(match[3]), match[4] or "", place)


def settle_evidence(
    model: Model, figures: Mapping[str, Any], findings: Iterable[Finding], checks: Collection[str]
) -> None:
    """Gives each evidence the figure that was measured. What was not measured stays missing."""
    counts = Counter(finding.check for finding in findings)
    for requirement in model.requirements.values():
        for evidence in requirement.evidence:
            if evidence.figure.startswith(CHECKS):
                pattern = evidence.figure.removeprefix(CHECKS)
                known = fnmatch.filter(checks, pattern)
                evidence.value = float(sum(counts[one] for one in known)) if known else None
            else:
                evidence.value = figure_of(figures, evidence.figure)


def figure_of(figures: Mapping[str, Any], name: str) -> float | None:
    """A figure by its key. ``bench.scenarios.max_ms`` is the greatest of those of all scenarios."""
    value = figures.get(name)
    if value is None:
        above, _, part = name.rpartition(".")
        parts = figures.get(above)
        if not isinstance(parts, list) or not parts:
            return None
        values = [item.get(part) for item in parts]
        return None if None in values else float(max(values))
    return float(value) if isinstance(value, (int, float)) else None


def reasons(evidence: Evidence) -> list[str]:
    """Why the evidence does not verify its requirement; nothing when it does."""
    if not evidence.relation:
        return [f"its evidence cannot be read: {evidence.figure}"]
    if evidence.value is None:
        return [f"{evidence.figure} was not measured"]
    if not evidence.holds:
        return [f"{evidence.figure} is {evidence.value:g} and must be {evidence.demand}"]
    return []
