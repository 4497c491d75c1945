"""The answers to the questions contain values of the present build."""

from __future__ import annotations

from pathlib import Path

import pytest
from markupsafe import Markup

from portal.answers import QUESTIONS, Question, linked_questions, with_metrics
from portal.pages import all_pages
from portal.portal import Portal
from tests.python.portal.fixture import REPORT, make_project
from tests.python.portal.page_reader import read_page
from tests.python.project_files import write_files

pytestmark = pytest.mark.reads("site")

QUESTION = """
[[question]]
ask = "How?"
answer = "So."
topic = "Verify"
clicks = ["tests.html"]
holds = ["words"]
see = ["virtual_k64.html#faults", "docs/tour.html", "docs/tour.html#first-steps"]
"""


def answer(text: str, **metrics: float | None) -> str:
    values = {name.replace("__", "."): value for name, value in metrics.items()}
    return with_metrics(Question("How?", text, "Verify", ["tests.html"]), values).answer


def test_an_answer_shows_the_value_of_a_metric() -> None:
    assert answer("{coverage.line} % of the lines", coverage__line=99.9) == "99.9 % of the lines"
    assert answer("{tests.passed} tests passed", tests__passed=1268) == "1,268 tests passed"


def test_a_missing_value_is_shown_as_missing() -> None:
    shown = answer("{coverage.line} % of the lines", coverage__line=None)
    assert shown == "(not measured in this build) % of the lines"


def test_an_answer_shows_a_value_of_the_last_record_of_a_command() -> None:
    records = {"mutation": {"commit": "0123abcd45", "tried": 3733}}
    question = Question(
        "How?", "{last.mutation.tried} at {last.mutation.commit}, {last.release.commit}", "x", []
    )
    shown = with_metrics(question, {"last": records}).answer
    assert shown == "3,733 at 0123abcd45, (not measured in this build)"


def test_the_items_of_a_list_are_one_line_in_the_table_of_the_questions() -> None:
    question = Question("How?", "Two steps:\n- Build.\n- Flash.", "x", [])
    assert question.line == "Two steps: Build. Flash."


def test_an_answer_links_to_further_evidence(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    write_files(tmp_path, {QUESTIONS: QUESTION})
    with (tmp_path / "docs/tour.rst").open("a", encoding="utf-8") as tour:
        tour.write("\nFirst steps\n-----------\n\nWalk.\n")
    portal = Portal(tmp_path, model, REPORT, [])
    (page,) = (page for page in all_pages(portal) if page.name == "answers/how")
    links = read_page(page.body).links
    assert links["@/virtual_k64.html#faults"] == "Run-time checks of the virtual board"
    assert links["@/docs/tour.html"] == "Tour"
    assert links["@/docs/tour.html#first-steps"] == "Tour: First steps"


def test_a_quoted_question_is_a_link_to_its_answer() -> None:
    question = Question("Does it stop?", "Yes.", "x", [])
    html = linked_questions([question], Markup("See “Does it stop?” and “Is it on?”."))
    address = "@/answers/does-it-stop.html"
    assert html == f'See “<a href="{address}">Does it stop?</a>” and “Is it on?”.'


def test_an_answer_cannot_name_an_unknown_metric() -> None:
    with pytest.raises(KeyError, match=r"coverage\.lines"):
        answer("{coverage.lines} % of the lines", coverage__line=99.9)
