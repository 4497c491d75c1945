"""Collects the requirements, tests and methods with their links, for the exports to requirements
tools."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from traceability.model.design_model import Model
from traceability.model.report import Report, words_of

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


# The names of the additional attributes. Only requirements have them.
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
            {
                "section": item.section,
                "rationale": item.rationale,
                "source": item.source,
                "priority": item.priority,
                "level": item.level,
                "method": item.method,
                "products": ", ".join(item.products),
                "goals": ", ".join(item.goals),
            },
        )
        for item in model.requirements.values()
    ]


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
    places = {
        method.id: method.place for module in model.modules.values() for method in module.methods
    }
    return [
        TraceItem(
            name,
            METHOD,
            name,
            "",
            "",
            places[name].file if name in places else "",
            places[name].line if name in places else 0,
            links=links,
        )
        for name, links in sorted(satisfied.items())
    ]
