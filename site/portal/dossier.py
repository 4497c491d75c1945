"""The dossier: a printable sheet for each requirement, and a page with a cover and all sheets."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any

from portal.names import VERDICTS
from portal.portal import Page, Portal
from portal.requirement_pages import outside_tree, played_scenarios
from traceability.model.report import Verdict
from traceability.model.reviews import NAMES_OF_TEXTS, QUESTIONS
from traceability.schema import FaultScenario, Requirement, Test, TreeNode


@dataclass
class Sheet:
    """The content of the sheet of a requirement."""

    requirement: Requirement
    verdict: Verdict
    nodes: list[tuple[int, TreeNode]]
    outside_tree: list[str]  # methods that satisfy the requirement, but are not in the tree
    scenarios: dict[str, list[FaultScenario]]  # targets -> fault scenarios played on them
    tests: list[Test]
    changes: list[str]  # texts that have changed since their baseline


def sheet_of(portal: Portal, requirement: Requirement) -> Sheet:
    return Sheet(
        requirement,
        portal.report.requirements[requirement.id],
        portal.flat(requirement.tree) if requirement.tree else [],
        outside_tree(portal.model, requirement),
        played_scenarios(portal.model, requirement),
        [
            portal.model.tests[name]
            for name in requirement.verified_by
            if name in portal.model.tests
        ],
        [
            f"{NAMES_OF_TEXTS[suspicion.kind].format(suspicion.name)} {suspicion.text}"
            for suspicion in requirement.suspicions
        ],
    )


def dossier_page(portal: Portal, requirement: Requirement) -> Page:
    return portal.page(
        f"dossier/{requirement.id}",
        f"{requirement.id}: sheet",
        "dossier",
        "dossier_sheet",
        sheet=sheet_of(portal, requirement),
        questions=QUESTIONS,
    )


def dossier(portal: Portal) -> dict[str, Any]:
    """Returns the values of the page with all sheets. The sheets are in the order of the
    requirements, and the cover shows the number of requirements with each verdict."""
    sheets = [sheet_of(portal, requirement) for requirement in portal.model.requirements.values()]
    states = Counter(sheet.verdict.state for sheet in sheets)
    return {
        "sheets": sheets,
        "states": [(state, states[state]) for state in VERDICTS if states[state]],
        "sections": list(dict.fromkeys(sheet.requirement.section for sheet in sheets)),
        "questions": QUESTIONS,
        "wide": True,
    }
