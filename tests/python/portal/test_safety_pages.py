"""The pages of the safety case, made from a small one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from portal.navigation import verify
from portal.pages import all_pages
from portal.portal import Portal
from portal.safety_pages import Compared, cycles, longest
from portal.search import safety_entries
from tests.python.model.small_case import make_model, report_of, write_case
from tests.python.portal.fixture import REPORT, make_project
from traceability.model.design_model import Model
from traceability.model.safety_case import safety_of
from traceability.reading.declared import Declared
from traceability.reading.declared_safety import read_sources
from traceability.schema import BenchRun, BenchScenario, SafetyCost, Spread, TouchedFile

TIMES = Spread(0.2, 0.1, 0.25)
RUN = BenchRun(report_ms=TIMES, load=TIMES, start_us=TIMES, jitter_us=0, times_us=[], cycles=1)
RECORD = {"steps": BenchScenario({"no-wait-states": RUN})}


@pytest.fixture
def portal(tmp_path: Path) -> Portal:
    """A project with a safety case of one goal."""
    model = make_project(tmp_path)
    write_case(tmp_path)
    other = make_model(tmp_path)
    sources = read_sources("goal: SG-1; decision: of FR-15")
    model = replace(
        model,
        requirements={
            **model.requirements,
            "FR-1": replace(other.requirements["FR-1"], sources=sources),
        },
        tests={**model.tests, **other.tests},
    )
    facts: Any = SimpleNamespace(root=tmp_path, declared=Declared(safety=other.safety))
    model = replace(model, safety=safety_of(model, facts))
    return portal_of(tmp_path, model)


def portal_of(root: Path, model: Model, state: str = "verified") -> Portal:
    report = report_of(model, {"FR-1": state, "FR-15": "verified"})
    return Portal(root, model, replace(report, clauses=REPORT.clauses), [])


def pages(portal: Portal) -> dict[str, str]:
    return {page.name: page.body for page in all_pages(portal)}


def test_the_case_has_its_pages(portal: Portal) -> None:
    wanted = {"safety/index", "safety/hazards", "safety/cost", "safety/SG-1"}
    assert wanted <= pages(portal).keys()
    assert {"safety", "safety_cost"} <= {entry.id for entry in verify(portal.model, 1, 1)}


def test_a_project_without_a_case_has_none(tmp_path: Path) -> None:
    portal = Portal(tmp_path, make_project(tmp_path), REPORT, [])
    assert not [name for name in pages(portal) if name.startswith("safety/")]
    assert "safety" not in {entry.id for entry in verify(portal.model, 1, 1)}


def test_goal_and_requirement_lead_to_each_other(portal: Portal) -> None:
    made = pages(portal)
    assert 'href="@/requirements/FR-1.html"' in made["safety/SG-1"]
    assert 'href="@/safety/SG-1.html"' in made["requirements/FR-1"]


def test_the_overview_says_what_it_is_not(portal: Portal) -> None:
    body = pages(portal)["safety/index"]
    assert "an example analysis, not a certificate" in body
    assert 'id="AU-1"' in body
    assert 'href="@/safety/hazards.html#HZ-1"' in body


def test_a_hazard_names_its_goal_and_its_assumption(portal: Portal) -> None:
    body = pages(portal)["safety/hazards"]
    assert 'id="HZ-1"' in body
    assert 'href="@/safety/SG-1.html"' in body
    assert 'href="@/safety/index.html#AU-1"' in body


@pytest.mark.parametrize(("state", "word"), [("verified", "verified"), ("failed", "failed")])
def test_the_page_of_a_goal_has_its_verdict(portal: Portal, state: str, word: str) -> None:
    portal = portal_of(portal.root, portal.model, state)
    assert f"{word}</span>" in pages(portal)["safety/SG-1"].split("</div>")[1]


def test_an_open_goal_says_why(portal: Portal) -> None:
    portal = portal_of(portal.root, portal.model, "unverified")
    assert "is not verified in this run" in pages(portal)["safety/SG-1"]


def test_a_requirement_shows_what_is_not_verified(portal: Portal) -> None:
    portal.model.requirements["FR-1"] = replace(
        portal.model.requirements["FR-1"], partly="only half of it."
    )
    body = pages(portal)["requirements/FR-1"]
    assert "partly verified" in body
    assert "only half of it." in body
    assert "real board: none yet" in body


def test_without_history_the_cost_is_not_available(portal: Portal) -> None:
    body = pages(portal)["safety/cost"]
    assert "not available" in body
    assert "not measured" in body


def test_the_cost_lists_touched_files_and_corrections(portal: Portal) -> None:
    touched = [TouchedFile("src/Mode.cpp", 2, 1), TouchedFile("src/Hall.cpp", 5, 5, "A bug.")]
    cost = SafetyCost("0123456", "abcdef0", ["extensions/safety/Stop.cpp"], 40, touched, 3)
    model = replace(portal.model, safety=replace(portal.model.safety, cost=cost))
    portal = portal_of(portal.root, model)
    body = pages(portal)["safety/cost"]
    assert body.index("src/Mode.cpp") < body.index("<code>Stop.cpp</code>")
    assert body.index("A bug.") < body.index("src/Hall.cpp")
    assert "not available" not in body


def test_the_search_finds_goals_hazards_and_assumptions(portal: Portal) -> None:
    found = {entry[2]: entry[4] for entry in safety_entries(portal)}
    assert found == {
        "SG-1": "safety/SG-1.html",
        "HZ-1": "safety/hazards.html#HZ-1",
        "AU-1": "safety/index.html#AU-1",
    }


def test_the_longest_cycle_is_read_where_it_was_measured() -> None:
    assert longest(RECORD, "steps") == 0.25
    assert longest(RECORD, "other") is None
    assert longest(None, "steps") is None


def test_a_product_that_was_not_measured_has_no_difference(portal: Portal) -> None:
    (row,) = cycles(portal)
    assert (row.safe, row.paper, row.difference) == (None, None, None)
    assert Compared("", "ms", 0.5, longest(RECORD, "steps")).difference == 0.25
