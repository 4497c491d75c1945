"""Answers to questions show values of the present build."""

from __future__ import annotations

import pytest

from portal.answers import Question, with_metrics


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


def test_an_answer_cannot_name_an_unknown_metric() -> None:
    with pytest.raises(KeyError, match=r"coverage\.lines"):
        answer("{coverage.lines} % of the lines", coverage__line=99.9)
