"""syntax-error, doc-warning and design-entry: the tools can read the code, the comments, the pages
and the files of design/ without an error."""

from __future__ import annotations

from pathlib import Path

from traceability.checks.link_checks import missing_parts
from traceability.checks.list_checks import wrong_counts, wrong_totals
from traceability.checks.option_checks import literal_exit_codes, missing_options, wrong_values
from traceability.checks.path_checks import missing_paths
from traceability.checks.pin_checks import wrong_pins
from traceability.model.design_model import Model
from traceability.reading.comments import TAGS
from traceability.reading.source_facts import Facts
from traceability.schema import Finding, Place
from traceability.sources import DESIGN, files_below

READ = ("src", "extensions", "sim", "tests", "requirements", "design", "docs", "README.md")

TEXT_CHECKS = (
    *(missing_paths, missing_options, wrong_values, literal_exit_codes),
    *(missing_parts, wrong_pins, wrong_counts, wrong_totals),
)


def check(_model: Model, facts: Facts) -> list[Finding]:
    findings = [Finding(place, "syntax-error", text) for place, text in facts.syntax.errors]
    for find in TEXT_CHECKS:
        findings += find(facts.root)
    for problem in facts.declared.entries.problems:
        findings.append(Finding(problem.place, "design-entry", problem.text, problem.fix))
    findings += [Finding(place, "doc-warning", text.rstrip(" .")) for place, text in facts.warnings]
    return findings + _unknown_tags(facts)


def _unknown_tags(facts: Facts) -> list[Finding]:
    fix = f"use one of: {', '.join(sorted(TAGS))}"
    return [
        Finding(tag.place, "doc-warning", f"there is no tag @{tag.name}", fix)
        for comment in facts.comments.below((*DESIGN, "tests", "requirements"))
        for tag in comment.tags
        if tag.name and tag.name not in TAGS
    ]


def not_text(root: Path) -> list[Finding]:
    """Returns a finding for each source that is not UTF-8, at the line of its first wrong byte."""
    findings: list[Finding] = []
    for path in files_below(root, READ):
        data = path.read_bytes()
        try:
            data.decode()
        except UnicodeDecodeError as error:
            place = Place(str(path.relative_to(root)), data.count(b"\n", 0, error.start) + 1)
            text = f"the byte {data[error.start]:#x} is not UTF-8"
            findings.append(Finding(place, "doc-warning", text, "write the file in UTF-8"))
    return findings
