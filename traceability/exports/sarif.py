"""Exports the findings of all checks in SARIF 2.1.0. Editors and code hosts such as GitHub can show
this file."""

from __future__ import annotations

import json
from typing import Any

from traceability.checks.registry import CHECKS, Check
from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.schema import Finding

NAME = "findings.sarif"
SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def sarif_text(model: Model, report: Report) -> str:
    return json.dumps(sarif(model, report), indent=1) + "\n"


def sarif(model: Model, report: Report) -> dict[str, Any]:
    """Returns the SARIF file. It lists every check as a rule, also the checks without a finding."""
    numbers = {check.id: number for number, check in enumerate(CHECKS)}
    driver = {
        "name": "weeding_robot",
        "version": model.version,
        "rules": [_rule(check) for check in CHECKS],
    }
    return {
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [
            {
                "tool": {"driver": driver},
                "columnKind": "unicodeCodePoints",
                "results": [_result(finding, numbers) for finding in report.findings],
            }
        ],
    }


def _rule(check: Check) -> dict[str, Any]:
    return {
        "id": check.id,
        "shortDescription": {"text": check.title},
        "fullDescription": {"text": f"{check.holds} {check.why}"},
        "help": {"text": f"{check.text}"},
    }


def _result(finding: Finding, numbers: dict[str, int]) -> dict[str, Any]:
    index = {"ruleIndex": numbers[finding.check]} if finding.check in numbers else {}
    return {
        "ruleId": finding.check,
        **index,
        "level": "error",
        "message": {"text": f"{finding.text}; {finding.fix}"},
        "locations": [
            {
                "physicalLocation": {
                    "artifactLocation": {"uri": finding.place.file},
                    "region": {"startLine": max(finding.place.line, 1)},
                }
            }
        ],
    }
