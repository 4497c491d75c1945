"""Exports the verification of each requirement as JSON and in the format of JUnit, so that other
programs can read it."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from traceability.exports.model_json import schema_of
from traceability.model.design_model import Model
from traceability.model.report import Report, words_of
from traceability.reading.results import RESULTS
from traceability.reading.traces import nodes_of
from traceability.schema import LineGap, MethodCoverage, Place, Requirement

JSON, JUNIT = "verification.json", "verification.xml"
SCHEMA = "verification.schema.json"


@dataclass(frozen=True)
class ReviewResult:
    """The review of a requirement by a person. ``holds`` is true if the review is valid and no
    reviewed text has changed since the review."""

    reviewer: str
    date: str
    holds: bool
    remark: str


@dataclass(frozen=True)
class CheckedNode:
    """A call in the invocation tree of a requirement. ``reachable`` is true if the code can make
    the call. ``executed`` contains for each target whether a test made the call."""

    node: str
    reachable: bool | None
    executed: Mapping[str, bool]


@dataclass(frozen=True)
class Measurement:
    """A metric of a requirement, with its bound and its measured value. ``value`` is null if the
    metric was not measured."""

    figure: str
    relation: str
    bound: float
    unit: str
    place: Place
    value: float | None
    holds: bool


@dataclass(frozen=True)
class VerifiedRequirement:
    """A requirement with its verdict and with the results from which the verdict follows.

    ``tests`` contains for each test the result on each target. A result of older sources ends with
    ", stale". ``coverage`` contains for each target the executed lines of the methods.
    """

    id: str
    section: str
    state: str
    level: str
    products: Sequence[str]
    method: str
    partly: str
    goals: Sequence[str]
    reasons: Sequence[str]
    suspect: Sequence[str]
    reviews: Sequence[ReviewResult]
    satisfied_by: Sequence[str]
    tests: Mapping[str, Mapping[str, str | None]]
    tree: Sequence[CheckedNode]
    coverage: Mapping[str, list[MethodCoverage]]
    evidence: Sequence[Measurement]


@dataclass(frozen=True)
class Verification:
    """The verification of all requirements. ``justified`` lists source lines with a justification:
    no test of the line's requirements executes the line."""

    commit: str
    sources: str
    requirements: Sequence[VerifiedRequirement]
    justified: Sequence[LineGap]


def write_exports(root: Path, site: Path, model: Model, report: Report) -> None:
    """Writes the verification as JSON, and as a JUnit file with one test case for each
    requirement."""
    texts = {
        JSON: json.dumps(table(model, report), indent=1) + "\n",
        JUNIT: ET.tostring(junit(model, report), encoding="unicode") + "\n",
    }
    for folder in (root / RESULTS, site):
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")


def schema_text() -> str:
    title = "Verification of the weeding robot's software"
    return json.dumps(schema_of(Verification, title), indent=1)


def table(model: Model, report: Report) -> dict[str, Any]:
    rows = [row(model, report, item) for item in model.requirements.values()]
    justified = [gap for gap in model.line_gaps if gap.reason]
    return asdict(Verification(model.commit, model.sources_hash, rows, justified))


def row(model: Model, report: Report, requirement: Requirement) -> VerifiedRequirement:
    verdict = report.requirements[requirement.id]
    nodes = nodes_of(requirement.tree)
    return VerifiedRequirement(
        id=requirement.id,
        section=requirement.section,
        state=words_of(verdict.state),
        level=requirement.level,
        products=requirement.products,
        method=requirement.method,
        partly=requirement.partly,
        goals=requirement.goals,
        reasons=verdict.reasons,
        suspect=[
            f"{suspicion.kind} {suspicion.name} {suspicion.text}"
            for suspicion in requirement.suspicions
        ],
        reviews=[
            ReviewResult(review.reviewer, review.date, review.holds, review.remark)
            for review in requirement.reviews
        ],
        satisfied_by=requirement.satisfied_by,
        tests={
            name: {binding: result.words for binding, result in model.tests[name].results.items()}
            for name in requirement.verified_by
        },
        tree=[CheckedNode(node.label, node.reachable, node.executed) for node in nodes],
        coverage=requirement.coverage,
        evidence=[
            Measurement(**vars(evidence), value=value, holds=evidence.holds(value))
            for evidence in requirement.evidence
            for value in [report.measured[evidence.figure]]
        ],
    )


def junit(model: Model, report: Report) -> ET.Element:
    top = ET.Element("testsuites", name="requirements")
    sections: dict[str, ET.Element] = {}
    for requirement in model.requirements.values():
        section = requirement.section
        if section not in sections:
            sections[section] = ET.SubElement(top, "testsuite", name=section)
        case = ET.SubElement(sections[section], "testcase", classname=section, name=requirement.id)
        verdict = report.requirements[requirement.id]
        if verdict.state != "verified":
            texts = [*verdict.reasons, *filter(None, [requirement.partly])]
            texts += [f"{s.name} {s.text}" for s in requirement.suspicions]
            failure = ET.SubElement(case, "failure", message=words_of(verdict.state))
            failure.text = "\n".join(texts)
    for suite in [*sections.values(), top]:
        suite.set("tests", str(len(list(suite.iter("testcase")))))
        suite.set("failures", str(len(list(suite.iter("failure")))))
    return top
