"""The pages of mutants, of the reverse direction and of requirements that tools measure."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from portal.pages import all_pages
from portal.portal import Portal
from tests.python.portal.fixture import REPORT, make_project
from traceability.model.design_model import Model
from traceability.model.report import Report, Verdict
from traceability.schema import Evidence, Justified, Mutant, Mutation, Place, Requirement

PLACE = Place("requirements/a.dox", 5)


def shown(root: Path, model: Model, name: str, report: Report = REPORT) -> str:
    portal = Portal(root, model, report, [])
    return next(page.body for page in all_pages(portal) if page.name == name)


def test_mutants_that_were_not_tried_are_no_figures(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    assert model.mutation is None
    assert "not run on these sources" in shown(tmp_path, model, "mutation")
    assert "not run on these sources" in shown(tmp_path, model, "requirements/FR-15")


def test_the_score_of_a_requirement_counts_what_its_own_tests_find(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    place = Place("src/main_control/operation_modes/RC.cpp", 3)
    model = replace(
        model,
        mutation=Mutation(
            seed=7,
            minutes=1.5,
            total=40,
            tried=[
                Mutant(place, "RC::read", "constant", "1 + 1", ["RcTest.Reads"], {"FR-15": True}),
                Mutant(place, "RC::read", "relation", "a < b", ["RcTest.Reads"], {"FR-15": False}),
                Mutant(place, "RC::read", "return", "at once", [], {"FR-15": False}),
            ],
        ),
    )
    page = shown(tmp_path, model, "mutation")
    assert "2<small>/3</small>" in page
    assert "33 %" in page
    assert "67 %" in page
    assert "at once" in page
    assert "1 + 1" not in page, "only what no test finds is listed"
    page = " ".join(shown(tmp_path, model, "requirements/FR-15").split())
    assert "Its own tests find 1 of the 3 that were tried." in page
    assert "a &lt; b" in page
    assert "1 + 1" not in page


def test_a_measured_requirement_shows_figure_and_bound(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    evidence = [
        Evidence("coverage.line", "at least", 98, "%", PLACE),
        Evidence("firmware.ram_bytes", "at most", 5, "bytes", PLACE),
        Evidence("firmware.flash_bytes", "at most", 5, "bytes", PLACE),
    ]
    requirement = Requirement("NFR-9", "It shall.", "Qualities", PLACE, evidence=evidence)
    model.requirements["NFR-9"] = requirement
    names = [one.figure for one in evidence]
    verdicts = {**REPORT.requirements, "NFR-9": Verdict("unverified")}
    measured = dict(zip(names, (98.5, 6, None), strict=True))
    report = replace(REPORT, requirements=verdicts, measured=measured)
    page = shown(tmp_path, model, "requirements/NFR-9", report)
    assert "1<small>/3</small>" in page
    assert "98.5" in page
    assert "at least 98 %" in page
    assert "not kept</span>" in page
    assert "not measured</span>" in page
    assert 'href="#tree"' not in page, "no call fulfils it"


def test_a_justification_is_shown_with_what_needs_it(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    model = replace(
        model,
        justified=[
            Justified("method", ["RC::read"], "It is a tool.", PLACE, ["RC::read"]),
            Justified("test", ["tests/"], "They are many.", PLACE, ["RcTest.Reads"] * 13),
        ],
    )
    page = shown(tmp_path, model, "reverse")
    assert "It is a tool." in page
    assert "<summary>13 tests</summary>" in page
