"""The questions of newcomers, and the page that answers each question."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from markupsafe import Markup

from portal.links import ROOT
from traceability.sources import text_of

QUESTIONS = Path("design/questions.toml")
# The name of a metric in an answer. A name such as {last.mutation.commit} means a value of the last
# record of a command.
METRIC = re.compile(r"\{([a-z]+\.[a-z_]+(?:\.[a-z_]+)?)\}")
LAST = "last."
ITEM = "\n- "  # begins an item of a list in an answer


@dataclass
class Question:
    """A question, its answer, and the links that a reader of the portal clicks to reach the
    answer."""

    ask: str
    answer: str
    topic: str
    clicks: list[str]
    holds: list[str] = field(default_factory=list)
    part: str = ""
    also: str = ""  # additional words by which the search finds the question
    code: str = ""  # commands or source lines that the page of the question shows after the answer
    see: list[str] = field(default_factory=list)  # addresses of further pages with evidence

    @property
    def line(self) -> str:
        """Returns the answer without the marks of list items, for one line of text."""
        return self.answer.replace(ITEM, " ")

    @property
    def page(self) -> str:
        return "answers/" + re.sub(r"[^a-z0-9]+", "-", self.ask.lower()).strip("-")

    @property
    def address(self) -> str:
        return f"{ROOT}{self.page}.html"

    @property
    def steps(self) -> list[str]:
        """Returns the addresses of the pages to open, in order. The last address also contains the
        anchor of the answer on its page."""
        last = self.clicks[-1]
        return [*self.clicks[:-1], f"{last.partition('#')[0]}#{self.part}" if self.part else last]


def questions_of(root: Path) -> list[Question]:
    entries = tomllib.loads(text_of(root / QUESTIONS)).get("question", [])
    return [Question(**entry) for entry in entries]


def linked_questions(questions: Iterable[Question], html: Markup) -> Markup:
    """Returns a text of HTML in which each quoted question is a link to its answer."""
    for question in questions:
        link = Markup('“<a href="{}">{}</a>”').format(question.address, question.ask)
        html = html.replace(Markup("“{}”").format(question.ask), link)
    return html


def with_metrics(question: Question, metrics: Mapping[str, Any]) -> Question:
    """Returns a copy of the question. In its answer, the value of this build replaces the name of
    each metric."""

    def value(match: re.Match[str]) -> str:
        return metric_text(metrics, match[1])

    return replace(question, answer=METRIC.sub(value, question.answer))


def metric_text(metrics: Mapping[str, Any], name: str, unit: str = "") -> str:
    """Returns the value of a metric with its unit, or states that the metric was not measured."""
    found = value_of(metrics, name)
    if found is None:
        return "(not measured in this build)"
    return f"{found if isinstance(found, str) else f'{found:,}'} {unit}".rstrip()


def value_of(metrics: Mapping[str, Any], name: str) -> Any:
    """Returns the value of a metric, or a value of the last record of a command. Returns None if
    the metric was not measured, or if the command has no record."""
    if not name.startswith(LAST):
        return metrics[name]
    command, _, key = name.removeprefix(LAST).partition(".")
    record = metrics["last"].get(command)
    return None if record is None else record[key]
