"""The questions of a newcomer. Each answer is at most three clicks from the first page."""

from __future__ import annotations

import re
import tomllib
from typing import Any

import pytest

from tests.python.site.content import FIRST, SITE, clicks, content, section, words

FILE = SITE.parents[1] / "design" / "questions.toml"
QUESTIONS: list[dict[str, Any]] = tomllib.loads(FILE.read_text(encoding="utf-8"))["question"]
NEAR = 3  # greatest number of clicks
NUMBER = re.compile(r"\b\d+\b")


def test_there_are_twelve_questions_or_more() -> None:
    asked = [question["ask"] for question in QUESTIONS]
    assert len(set(asked)) == len(asked) >= 12


@pytest.mark.parametrize("question", QUESTIONS, ids=[one["ask"] for one in QUESTIONS])
def test_links_of_the_content_lead_to_the_answer(question: dict[str, Any]) -> None:
    at = FIRST
    for address in question["clicks"]:
        assert address in content(at.partition("#")[0]).links, f"{at} has no link to {address}"
        at = address
    assert len(question["clicks"]) <= NEAR
    text = section(f"{at.partition('#')[0]}#{question['part']}" if "part" in question else at)
    assert [held for held in question["holds"] if held not in text] == []
    assert [number for number in NUMBER.findall(question["answer"]) if number not in text] == []
    lines = [words(line).strip() for line in question.get("code", "").splitlines()]
    assert [line for line in lines if line not in text] == []


@pytest.mark.parametrize("question", QUESTIONS, ids=[one["ask"] for one in QUESTIONS])
def test_no_answer_stands_on_the_first_page_by_chance(question: dict[str, Any]) -> None:
    assert not all(held in section(FIRST) for held in question["holds"])
    assert clicks()[question["clicks"][-1].partition("#")[0]] <= NEAR


def test_the_links_to_the_evidence_show_titles_and_no_addresses() -> None:
    names = [path.name for path in (SITE / "answers").glob("*.html") if path.name != "index.html"]
    assert len(names) == len(QUESTIONS)
    assert [name for name in names if ".html" in section(f"answers/{name}#evidence")] == []


TOURS = tomllib.loads(FILE.with_name("tours.toml").read_text(encoding="utf-8"))["tour"]


@pytest.mark.parametrize("tour", TOURS, ids=[one["id"] for one in TOURS])
def test_each_stop_of_a_tour_is_a_place_and_the_tour_ends_with_a_command(
    tour: dict[str, Any],
) -> None:
    for stop in tour["stops"]:
        page, _, part = stop["address"].partition("#")
        assert not part or part in content(page).ids
        assert content(page).text
    assert tour["action"]["command"].startswith("./wr ")
    assert f"tours/{tour['id']}.html" in content(FIRST).links
