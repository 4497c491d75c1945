"""The checks: each reads the model and reports findings."""

from __future__ import annotations

from pathlib import Path

from traceability.checks import (
    architecture,
    board,
    changes,
    documents,
    execution,
    files,
    links,
    machines,
    modules,
    numbers,
    paper,
    patterns,
    registers,
    requirements,
    safety,
    secrets,
    stack,
    trees,
    uses,
    words,
)
from traceability.checks.registry import KNOWN
from traceability.metrics import figures
from traceability.model.build import set_states
from traceability.model.evidence import settle_evidence
from traceability.model.schema import Finding, Model

FAMILIES = (
    documents.check,
    words.check,
    numbers.check,
    modules.check,
    files.check,
    patterns.check,
    changes.check,
    uses.check,
    registers.check,
    secrets.check,
    board.check,
    paper.check,
    architecture.check,
    execution.check,
    stack.check,
    machines.check,
    trees.check,
    requirements.check,
    safety.check,
)


def run_checks(model: Model) -> list[Finding]:
    """All findings but those of the site's links, sorted. The model keeps them too."""
    assert model.facts is not None, "the model was not built from sources"
    waits = bool(model.facts.declared.entries.unreadable)
    families = FAMILIES[:1] if waits else FAMILIES
    found = [finding for family in families for finding in family(model, model.facts)]
    settle_evidence(model, figures(model.facts.root, model), found, KNOWN)
    set_states(model)
    model.findings = sort(found + requirements.unmet(model))
    return list(model.findings)


def run_link_checks(model: Model, site: Path) -> list[Finding]:
    """The dead links of the built site, and the pages that it should have."""
    clicks = links.dead_clicks(site) if model.facts else []
    return sort(links.check(model, site) + paper.check_pages(model, site) + clicks)


def sort(findings: list[Finding]) -> list[Finding]:
    return sorted(findings, key=lambda one: (one.place.file, one.place.line, one.check, one.text))


def message(finding: Finding) -> str:
    place = f"{finding.place.file}:{finding.place.line}"
    return f"{place}: [{finding.check}] {finding.text}; {finding.mend}"
