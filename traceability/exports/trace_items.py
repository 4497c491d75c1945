"""Collects the requirements, tests and methods with their links, for the exports to requirements
tools."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from traceability.model.design_model import Model
from traceability.model.report import Report, words_of
from traceability.schema import Place

REQUIREMENT, TEST, METHOD = "requirement", "test", "method"


@dataclass(frozen=True)
class TraceItem:
    """A requirement, a test or a method, in the same form for all exports."""

    id: str
    kind: str
    title: str
    text: str
    state: str  # verdict of a requirement, or results of a test; empty for a method
    file: str
    line: int
    # additional attributes by name; empty for a test or a method
    values: dict[str, str] = field(default_factory=dict)
    # ids of the requirements that the test verifies or the method satisfies
    links: Sequence[str] = ()

    @property
    def place(self) -> str:
        return f"{self.file}:{self.line}" if self.file else ""


# The fields of a requirement that are additional attributes. Tests and methods have none.
VALUES = ("section", "rationale", "source", "priority", "level", "method", "products", "goals")


def trace_items(model: Model, report: Report) -> list[TraceItem]:
    """Returns all requirements, and then the tests and methods that have a link to a
    requirement."""
    return [*_requirements(model, report), *_tests(model), *_methods(model)]


def _requirements(model: Model, report: Report) -> list[TraceItem]:
    return [
        TraceItem(
            item.id,
            REQUIREMENT,
            item.id,
            item.text,
            words_of(report.requirements[item.id].state),
            item.place.file,
            item.place.line,
            {name: _text(getattr(item, name)) for name in VALUES},
        )
        for item in model.requirements.values()
    ]


def _text(value: str | Sequence[str]) -> str:
    return value if isinstance(value, str) else ", ".join(value)


def _tests(model: Model) -> list[TraceItem]:
    return [
        TraceItem(
            test.id,
            TEST,
            test.id,
            test.brief,
            ", ".join(f"{target}: {run.result}" for target, run in test.results.items()),
            test.place.file,
            test.place.line,
            links=test.verifies,
        )
        for test in model.tests.values()
        if test.verifies
    ]


def _methods(model: Model) -> list[TraceItem]:
    satisfied: dict[str, list[str]] = {}
    for item in model.requirements.values():
        for method in item.satisfied_by:
            satisfied.setdefault(method, []).append(item.id)
    places = {method.id: method.place for method in model.methods}
    items = []
    for name, links in sorted(satisfied.items()):
        place = places.get(name, Place("", 0))
        items.append(TraceItem(name, METHOD, name, "", "", place.file, place.line, links=links))
    return items
