"""What the pages and the exports tell of the verification of each requirement."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from traceability.model.results import RESULTS
from traceability.model.schema import (
    HOST,
    VIRTUAL_K64,
    MethodCoverage,
    Model,
    Requirement,
)
from traceability.model.traces import nodes_of

JSON, JUNIT = "verification.json", "verification.xml"


@dataclass
class Share:
    """How many of something were executed."""

    part: int
    whole: int

    @property
    def per_cent(self) -> float:
        return round(100 * self.part / self.whole, 1)

    def __str__(self) -> str:
        return f"{self.part}/{self.whole}"


def share(hits: Iterable[bool]) -> Share | None:
    values = list(hits)
    return Share(sum(values), len(values)) if values else None


def lines_of(methods: Iterable[MethodCoverage]) -> Share | None:
    return share(hit for method in methods for hit in method.lines.values())


def branches_of(methods: Iterable[MethodCoverage]) -> Share | None:
    return share(hit for method in methods for hit in method.branches or [])


@dataclass
class Bar:
    """A row of the chart: what the tests of the requirements of a section executed."""

    section: str
    host_lines: Share | None
    host_branches: Share | None
    board_lines: Share | None


def chart(sections: dict[str, list[Requirement]]) -> list[Bar]:
    """A method that stands in several trees counts in each of them."""

    def methods(items: list[Requirement], binding: str) -> list[MethodCoverage]:
        return [method for item in items for method in item.coverage.get(binding, [])]

    return [
        Bar(
            section,
            lines_of(methods(items, HOST)),
            branches_of(methods(items, HOST)),
            lines_of(methods(items, VIRTUAL_K64)),
        )
        for section, items in sections.items()
    ]


@dataclass
class Facets:
    """What a requirement is filtered by."""

    state: str
    logic: list[str]
    pattern: list[str]
    method: list[str]
    binding: list[str]
    level: list[str]
    goal: list[str]


def facets(model: Model, requirement: Requirement) -> Facets:
    names = [method.split("::")[0] for method in requirement.satisfied_by]
    for node in nodes_of(requirement.tree) if requirement.tree else []:
        names.append(node.module)
    modules = [model.modules[name] for name in dict.fromkeys(names) if name in model.modules]
    passed = {
        binding for test in requirement.verified_by for binding in model.tests[test].gave("passed")
    }
    return Facets(
        requirement.state,
        sorted({module.logic for module in modules}),
        sorted({role.application for module in modules for role in module.roles}),
        [requirement.method] if requirement.method else [],
        [binding for binding in model.results_hashes if binding in passed],
        [requirement.level] if requirement.level else [],
        requirement.goals,
    )


def options(found: Iterable[Facets], pick: Callable[[Facets], list[str]]) -> list[str]:
    return sorted({value for one in found for value in pick(one)})


# ---- exports -------------------------------------------------------------------


def write_exports(root: Path, site: Path, model: Model) -> None:
    """The same table for other programs: JSON, and JUnit with a test case for each requirement."""
    texts = {
        JSON: json.dumps(table(model), indent=1) + "\n",
        JUNIT: ET.tostring(junit(model), encoding="unicode") + "\n",
    }
    for folder in (root / RESULTS, site):
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")


def table(model: Model) -> dict[str, Any]:
    return {
        "commit": model.commit,
        "sources": model.sources_hash,
        "requirements": [row(model, item) for item in model.requirements.values()],
        "justified": [asdict(gap) for gap in model.line_gaps if gap.reason],
    }


def row(model: Model, requirement: Requirement) -> dict[str, Any]:
    nodes = nodes_of(requirement.tree) if requirement.tree else []
    return {
        "id": requirement.id,
        "section": requirement.section,
        "state": requirement.state,
        "level": requirement.level,
        "products": requirement.products,
        "method": requirement.method,
        "partly": requirement.partly,
        "goals": requirement.goals,
        "reasons": requirement.reasons,
        "suspect": [f"{one.kind} {one.name} {one.text}" for one in requirement.suspicions],
        "review": requirement.review
        and {"reviewer": requirement.review.reviewer, "date": requirement.review.date},
        "satisfied_by": requirement.satisfied_by,
        "tests": {
            name: {binding: one.result for binding, one in model.tests[name].results.items()}
            for name in requirement.verified_by
        },
        "tree": [
            {"node": one.label, "reachable": one.reachable, "executed": one.executed}
            for one in nodes
        ],
        "coverage": {
            binding: [asdict(method) for method in methods]
            for binding, methods in requirement.coverage.items()
        },
        "evidence": [asdict(one) | {"holds": one.holds} for one in requirement.evidence],
    }


def junit(model: Model) -> ET.Element:
    top = ET.Element("testsuites", name="requirements")
    sections: dict[str, ET.Element] = {}
    for requirement in model.requirements.values():
        if requirement.section not in sections:
            sections[requirement.section] = ET.SubElement(
                top, "testsuite", name=requirement.section
            )
        suite = sections[requirement.section]
        case = ET.SubElement(suite, "testcase", classname=requirement.section, name=requirement.id)
        if requirement.state != "verified":
            texts = [*requirement.reasons, *filter(None, [requirement.partly])]
            texts += [f"{s.name} {s.text}" for s in requirement.suspicions]
            failure = ET.SubElement(case, "failure", message=requirement.state)
            failure.text = "\n".join(texts)
    for suite in [*sections.values(), top]:
        suite.set("tests", str(len(list(suite.iter("testcase")))))
        suite.set("failures", str(len(list(suite.iter("failure")))))
    return top
