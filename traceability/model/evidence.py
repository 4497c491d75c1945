"""Evidence for requirements that calls of methods cannot fulfil, for example a limit of the flash
memory. The tag @evidence of a requirement compares a metric with a bound."""

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
    """Reads an @evidence such as ``coverage.line at least 98 %``. Its parts are the metric, the
    relation, the bound and the unit. The relation is empty if the text cannot be read."""
    match = WRITTEN.fullmatch(text)
    if match is None:
        return Evidence(text, "", 0, "", place)
    return Evidence(match[1], match[2], float(match[3]), match[4] or "", place)


def measured_values(
    model: Model, figures: Mapping[str, Any], findings: Iterable[Finding], checks: Collection[str]
) -> dict[str, float | None]:
    """Returns the values of all metrics that an @evidence names. A value is ``None`` if the run did
    not measure the metric."""
    counts = Counter(finding.check for finding in findings)
    values: dict[str, float | None] = {}
    for name in {
        evidence.figure for item in model.requirements.values() for evidence in item.evidence
    }:
        if name.startswith(CHECKS):
            matching = fnmatch.filter(checks, name.removeprefix(CHECKS))
            values[name] = float(sum(counts[check] for check in matching)) if matching else None
        else:
            values[name] = figure_of(figures, name)
    return values


def figure_of(figures: Mapping[str, Any], name: str) -> float | None:
    """Returns the value of the metric with the key ``name``. For a key such as
    ``bench.scenarios.max_ms``, the value is the maximum over all scenarios. The value is None if
    this run did not measure the metric."""
    value = figures.get(name)
    if value is None:
        above, _, part = name.rpartition(".")
        parts = figures.get(above)
        if not isinstance(parts, list) or not parts:
            return None
        values = [item.get(part) for item in parts]
        return None if None in values else float(max(values))
    return float(value) if isinstance(value, (int, float)) else None


def reasons(evidence: Evidence, value: float | None) -> list[str]:
    """Returns a list with the reason why an @evidence does not verify its requirement. The list is
    empty if the metric meets its bound."""
    if not evidence.relation:
        return [f"its evidence cannot be read: {evidence.figure}"]
    if value is None:
        return [f"{evidence.figure} was not measured"]
    if not evidence.holds(value):
        return [f"{evidence.figure} is {value:g} and must be {evidence.demand}"]
    return []
