"""The verification of each requirement for other programs: JSON, and JUnit."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from dataclasses import asdict
from pathlib import Path
from typing import Any

from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.reading.results import RESULTS
from traceability.reading.traces import nodes_of
from traceability.schema import Requirement

JSON, JUNIT = "verification.json", "verification.xml"


def write_exports(root: Path, site: Path, model: Model, report: Report) -> None:
    """The same table for other programs: JSON, and JUnit with a test case for each requirement."""
    texts = {
        JSON: json.dumps(table(model, report), indent=1) + "\n",
        JUNIT: ET.tostring(junit(model, report), encoding="unicode") + "\n",
    }
    for folder in (root / RESULTS, site):
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")


def table(model: Model, report: Report) -> dict[str, Any]:
    return {
        "commit": model.commit,
        "sources": model.sources_hash,
        "requirements": [row(model, report, item) for item in model.requirements.values()],
        "justified": [asdict(gap) for gap in model.line_gaps if gap.reason],
    }


def row(model: Model, report: Report, requirement: Requirement) -> dict[str, Any]:
    verdict = report.requirements[requirement.id]
    nodes = nodes_of(requirement.tree) if requirement.tree else []
    return {
        "id": requirement.id,
        "section": requirement.section,
        "state": verdict.state,
        "level": requirement.level,
        "products": requirement.products,
        "method": requirement.method,
        "partly": requirement.partly,
        "goals": requirement.goals,
        "reasons": verdict.reasons,
        "suspect": [
            f"{suspicion.kind} {suspicion.name} {suspicion.text}"
            for suspicion in requirement.suspicions
        ],
        "reviews": [
            {
                "reviewer": review.reviewer,
                "date": review.date,
                "holds": review.holds,
                "remark": review.remark,
            }
            for review in requirement.reviews
        ],
        "satisfied_by": requirement.satisfied_by,
        "tests": {
            name: {binding: result.result for binding, result in model.tests[name].results.items()}
            for name in requirement.verified_by
        },
        "tree": [
            {"node": node.label, "reachable": node.reachable, "executed": node.executed}
            for node in nodes
        ],
        "coverage": {
            binding: [asdict(method) for method in methods]
            for binding, methods in requirement.coverage.items()
        },
        "evidence": [
            asdict(evidence) | {"value": value, "holds": evidence.holds(value)}
            for evidence in requirement.evidence
            for value in [report.measured[evidence.figure]]
        ],
    }


def junit(model: Model, report: Report) -> ET.Element:
    top = ET.Element("testsuites", name="requirements")
    sections: dict[str, ET.Element] = {}
    for requirement in model.requirements.values():
        if requirement.section not in sections:
            sections[requirement.section] = ET.SubElement(
                top, "testsuite", name=requirement.section
            )
        suite = sections[requirement.section]
        case = ET.SubElement(suite, "testcase", classname=requirement.section, name=requirement.id)
        verdict = report.requirements[requirement.id]
        if verdict.state != "verified":
            texts = [*verdict.reasons, *filter(None, [requirement.partly])]
            texts += [f"{s.name} {s.text}" for s in requirement.suspicions]
            failure = ET.SubElement(case, "failure", message=verdict.state)
            failure.text = "\n".join(texts)
    for suite in [*sections.values(), top]:
        suite.set("tests", str(len(list(suite.iter("testcase")))))
        suite.set("failures", str(len(list(suite.iter("failure")))))
    return top
