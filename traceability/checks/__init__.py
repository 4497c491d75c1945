"""The checks. Each check reads the model and reports findings."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from traceability.checks import (
    architecture_checks,
    board_checks,
    change_checks,
    document_checks,
    execution_checks,
    file_checks,
    id_checks,
    kit_checks,
    link_checks,
    module_checks,
    name_checks,
    number_checks,
    paper_checks,
    pattern_checks,
    proof_checks,
    protocol_checks,
    register_checks,
    requirement_checks,
    safety_checks,
    scenario_checks,
    secret_checks,
    stack_checks,
    state_machine_checks,
    swap_checks,
    test_checks,
    time_checks,
    tree_checks,
    tuned_checks,
    use_checks,
)
from traceability.checks.registry import KNOWN
from traceability.model.design_model import Model
from traceability.model.evidence import measured_values
from traceability.model.metrics import figures
from traceability.model.report import Report
from traceability.model.verdicts import make_report
from traceability.reading.source_facts import Facts
from traceability.schema import Finding

FAMILIES = (
    *(document_checks.check, name_checks.check, module_checks.check, file_checks.check),
    *(swap_checks.check, pattern_checks.check, change_checks.check, kit_checks.check),
    *(tuned_checks.check, use_checks.check, register_checks.check, secret_checks.check),
    *(board_checks.check, paper_checks.check, architecture_checks.check, execution_checks.check),
    *(stack_checks.check, time_checks.check, state_machine_checks.check, proof_checks.check),
    *(tree_checks.check, requirement_checks.check, id_checks.check, number_checks.check),
    *(protocol_checks.check, safety_checks.check, scenario_checks.check, test_checks.check),
)


def run_checks(model: Model, facts: Facts) -> Report:
    """Runs all checks and returns the report with their sorted findings. The links of the site are
    not checked here, because the site is built later."""
    families = FAMILIES[:1] if facts.declared.entries.unreadable else FAMILIES
    all_findings = [finding for family in families for finding in family(model, facts)]
    clauses, broken = pattern_checks.decide(model, facts)
    all_findings += broken
    measured = measured_values(model, figures(model, clauses), all_findings, KNOWN)
    findings = sort([*all_findings, *requirement_checks.unmet(model, measured, all_findings)])
    return make_report(model, findings, clauses, measured)


def run_link_checks(model: Model, facts: Facts, site: Path) -> list[Finding]:
    """Returns the dead links of the built site, and the expected pages that do not exist."""
    pages = paper_checks.check_pages(model, facts, site)
    return sort([*link_checks.check(model, site), *pages, *link_checks.dead_clicks(site)])


def sort(findings: list[Finding]) -> list[Finding]:
    """Returns the findings, sorted by file and line. A finding without a fix gets the fix of its
    check."""
    return sorted(
        (replace(each, fix=each.fix or KNOWN[each.check].fix.rstrip(".")) for each in findings),
        key=lambda finding: (finding.place.file, finding.place.line, finding.check, finding.text),
    )


def message(finding: Finding) -> str:
    place = f"{finding.place.file}:{finding.place.line}"
    return f"{place}: [{finding.check}] {finding.text}; {finding.fix}"
