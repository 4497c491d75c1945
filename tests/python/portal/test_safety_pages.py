"""The pages of a small safety case."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from portal.navigation import verify
from portal.pages import all_pages
from portal.portal import Portal
from portal.requirement_pages import played_scenarios
from portal.safety_pages import Compared, evidence, longest, open_points, product_runs
from portal.search import safety_entries
from tests.python.model.small_case import make_model, report_of, write_case
from tests.python.portal.fixture import REPORT, make_project
from tests.python.portal.page_reader import Shown, read_page
from traceability.model.safety_case import safety_of
from traceability.reading.declared import Declared
from traceability.reading.declared_safety import read_sources
from traceability.schema import (
    HOST,
    VIRTUAL_K64,
    BenchRun,
    BenchScenario,
    BindingResult,
    SafetyCost,
    Spread,
    TouchedFile,
)

pytestmark = pytest.mark.reads("site")

TIMES = Spread(0.2, 0.1, 0.25)
RUN = BenchRun(report_ms=TIMES, load=TIMES, start_us=TIMES, jitter_us=0, times_us=[], cycles=1)
RECORD = {"steps": BenchScenario({"no-wait-states": RUN})}
COST = SafetyCost(
    "0123456", "abcdef0", ["extensions/safety/Stop.cpp"], 40,
    [TouchedFile("src/Mode.cpp", 2, 1), TouchedFile("src/Hall.cpp", 5, 5, "A bug.")], 3,
)  # fmt: skip


def portal_of(root: Path, state: str, cost: SafetyCost | None = None) -> Portal:
    """Returns the portal of a project. Its safety case has one goal, and the requirement of the
    goal has the given state."""
    model = make_project(root)
    write_case(root)
    other = make_model(root)
    sources = read_sources("goal: SG-1; decision: of FR-15")
    requirement = replace(other.requirements["FR-1"], sources=sources)
    model.requirements["FR-1"] = requirement
    model.tests.update(other.tests)
    facts: Any = SimpleNamespace(root=root, declared=Declared(safety=other.safety))
    files = [*model.files, *(one.place.file for one in other.safety.scenarios.values())]
    model = replace(model, safety=replace(safety_of(model, facts), cost=cost), files=files)
    report = report_of(model, {"FR-1": state, "FR-15": "verified"})
    return Portal(root, model, replace(report, clauses=REPORT.clauses), [])


def pages(portal: Portal) -> dict[str, Shown]:
    return {page.name: read_page(page.body) for page in all_pages(portal)}


def test_a_project_without_a_case_has_no_pages_of_it(tmp_path: Path) -> None:
    portal = Portal(tmp_path, make_project(tmp_path), REPORT, [])
    assert not [page.name for page in all_pages(portal) if page.name.startswith("safety/")]
    assert "safety" not in {entry.id for entry in verify(portal.model, 1, 1)}


def test_the_pages_of_a_case_lead_to_each_other(tmp_path: Path) -> None:
    portal = portal_of(tmp_path, "verified", COST)
    found = pages(portal)
    assert "@/requirements/FR-1.html" in found["safety/SG-1"].links
    assert "@/safety/SG-1.html" in found["requirements/FR-1"].links
    assert "@/safety/hazards.html#HZ-1" in found["safety/index"].links
    hazards = found["safety/hazards"].links
    assert {"@/safety/SG-1.html", "@/safety/index.html#AU-1"} <= hazards.keys()
    assert "an example analysis, not a certificate" in found["safety/index"].text
    cost = found["safety/cost"].text
    assert cost.index("src/Mode.cpp") < cost.index("A bug.") < cost.index("src/Hall.cpp")
    assert {"safety", "safety_cost"} <= {entry.id for entry in verify(portal.model, 1, 1)}
    assert {entry[2]: entry[4] for entry in safety_entries(portal)} == {
        "Hazards": "safety/hazards.html",
        "SG-1": "safety/SG-1.html",
        "HZ-1": "safety/hazards.html#HZ-1",
        "AU-1": "safety/index.html#AU-1",
    }


def test_the_page_of_a_goal_shows_what_its_scenarios_expect(tmp_path: Path) -> None:
    found = pages(portal_of(tmp_path, "verified"))
    file = "source/sim/scenario/safety/lost.scenario"
    assert "at 50 expect braking 1 within 300 ms" in found["safety/SG-1"].text
    assert f"@/{file}.html#L1" in found["safety/SG-1"].links.keys() & found["safety/hazards"].links
    assert "at 100 end" in found[file].text


def test_the_table_of_hazards_counts_the_scenarios(tmp_path: Path) -> None:
    portal = portal_of(tmp_path, "verified")
    row = ["HZ-1", "No stop", "S2 E3 C3", "AgPL c", "SG-1", "AU-1"]
    assert [*row, "1"] in pages(portal)["safety/index"].rows
    hazard = replace(portal.model.safety.hazards["HZ-1"], scenarios=[])
    case = replace(portal.model.safety, hazards={"HZ-1": hazard})
    portal = Portal(tmp_path, replace(portal.model, safety=case), portal.report, [])
    assert [*row, "none"] in pages(portal)["safety/index"].rows


def test_the_page_lists_all_exceptions_and_open_points(tmp_path: Path) -> None:
    portal = portal_of(tmp_path, "verified")
    goal = replace(portal.model.safety.goals["SG-1"], exceptions=["Late."], open_points=["Slope."])
    case = replace(portal.model.safety, goals={"SG-1": goal})
    requirement = replace(portal.model.requirements["FR-1"], partly="only one product.")
    model = replace(portal.model, safety=case, requirements={"FR-1": requirement})
    assert list(open_points(Portal(tmp_path, model, portal.report, []))) == [
        ("SG-1", "known exception", "Late."),
        ("SG-1", "open point", "Slope."),
        ("FR-1", "partly verified", "only one product."),
    ]


def test_the_page_lists_the_products_that_the_tests_ran(tmp_path: Path) -> None:
    portal = portal_of(tmp_path, "verified")
    test = portal.model.tests["Safety.FR1_Stops"]
    run = replace(test.results[HOST], images=["weeding_robot", "weeding_robot_paper_calls"])
    portal.model.tests[test.id] = replace(test, results={VIRTUAL_K64: run})
    rows = {one.name: (one.safe, one.tests, one.scenarios) for one in product_runs(portal)}
    assert rows["weeding_robot"] == (True, 1, 1)
    assert rows["weeding_robot_pc"] == (True, 0, 0)
    assert rows["weeding_robot_paper"] == (False, 0, 0), "the image for recordings is another image"
    found = pages(portal)
    assert "no fault scenario was played with these images" in found["safety/index"].text
    assert "@/safety/index.html#tested" in found["safety/SG-1"].links


def test_the_page_of_a_requirement_lists_the_scenarios_that_its_tests_play(tmp_path: Path) -> None:
    portal = portal_of(tmp_path, "verified")
    model = portal.model
    test = model.tests["Safety.FR1_Stops"]
    board = replace(test, id="Board.NFR6", results={VIRTUAL_K64: BindingResult("passed")})
    model.tests[board.id] = board
    scenario = replace(model.safety.scenarios["lost"], tests=[test.id, board.id])
    model = replace(model, safety=replace(model.safety, scenarios={"lost": scenario}))
    requirement = model.requirements["FR-1"]
    assert played_scenarios(model, requirement) == {"host, virtual K64": [scenario]}
    assert played_scenarios(model, model.requirements["FR-15"]) == {}
    found = pages(Portal(tmp_path, model, portal.report, []))
    assert "@/safety/SG-1.html#lost" in found["requirements/FR-1"].links
    assert "lost: host, virtual K64" in found["dossier/FR-1"].text


def test_evidence_without_a_result_is_marked(tmp_path: Path) -> None:
    portal = portal_of(tmp_path, "verified")
    results = {title: bool(result) for title, _, _, result in evidence(portal)}
    assert results["distances, settling times and other values"]
    assert not results["stack, measured"]
    text = pages(portal)["safety/index"].text
    assert text.count("no result in this build") == list(results.values()).count(False)


@pytest.mark.parametrize(
    ("state", "words"),
    [("failed", "failed"), ("unverified", "is not verified in this run")],
)
def test_the_page_of_a_goal_has_its_verdict(tmp_path: Path, state: str, words: str) -> None:
    found = pages(portal_of(tmp_path, state))
    assert words in found["safety/SG-1"].text
    assert "not available" in found["safety/cost"].text, (
        "without a git history, the page must state that the cost is not available"
    )


def test_a_product_that_was_not_measured_has_no_difference() -> None:
    assert longest(RECORD, "steps") == 0.25
    assert longest(RECORD, "other") is None
    assert longest(None, "steps") is None
    assert Compared("", "ms", 0.5, 0.25).difference == 0.25
    assert Compared("", "ms", None, 0.25).difference is None
