"""The dossier: a printable sheet for each requirement, and a page with a cover and all sheets."""

from __future__ import annotations

from collections import Counter
from typing import Any

from portal.names import VERDICTS
from portal.portal import Page, Portal
from portal.requirement_pages import sheet_of
from traceability.model.reviews import QUESTIONS
from traceability.schema import Requirement


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
    """Returns the values for the page that contains all sheets. The sheets are in the order of the
    requirements. The cover shows the number of requirements with each verdict."""
    sheets = [sheet_of(portal, requirement) for requirement in portal.model.requirements.values()]
    states = Counter(sheet.verdict.state for sheet in sheets)
    return {
        "sheets": sheets,
        "states": [(state, states[state]) for state in VERDICTS if states[state]],
        "sections": list(dict.fromkeys(sheet.requirement.section for sheet in sheets)),
        "questions": QUESTIONS,
        "wide": True,
    }
