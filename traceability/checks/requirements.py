"""req-*, suspect-*: each requirement is satisfied by code, verified by tests that ran and passed, and
its links were reviewed."""

from __future__ import annotations

import re

from traceability.model.declared import JUSTIFIED
from traceability.model.facts import Facts
from traceability.model.results import RESULTS, RUNS
from traceability.model.reviews import REVIEWS
from traceability.model.schema import HOST, Finding, Model, Place

_VERBS = {"method": "satisfies", "test": "verifies"}


def check(model: Model, facts: Facts) -> list[Finding]:
    families = (_tags, _requirements, _unknown, _stale, _results, _lines, _suspects)
    return [finding for family in families for finding in family(model)] + _reasons(model, facts)


def _stale(model: Model) -> list[Finding]:
    return [
        Finding(
            Place(f"{RESULTS}/{RUNS[binding]}.json", 1),
            "req-stale",
            f"there are no test results of the {binding}"
            if made_from is None
            else f"the test results of the {binding} are older than the sources",
            "run ./wr test",
        )
        for binding, made_from in model.results_hashes.items()
        if model.stale_on(binding)
    ]


def _requirements(model: Model) -> list[Finding]:
    found: list[Finding] = []
    for requirement in model.requirements.values():
        if not requirement.satisfied_by:
            found.append(
                Finding(
                    requirement.place,
                    "req-satisfied",
                    f"no method satisfies {requirement.id}",
                    f"tag the method that does the work with @satisfies {requirement.id}",
                )
            )
        if not requirement.verified_by:
            found.append(
                Finding(
                    requirement.place,
                    "req-verified",
                    f"no test verifies {requirement.id}",
                    f"tag a test with @verifies {requirement.id}",
                )
            )
    return found


def _results(model: Model) -> list[Finding]:
    words = {"failed": "failed", "skipped": "was skipped", None: "did not run"}
    return [
        Finding(
            test.place,
            "req-passed",
            f"{test.id} {words[one.result]} on the {binding}, and it verifies "
            f"{', '.join(test.verifies)}",
            "correct the code or the test, then run ./wr test",
        )
        for test in model.tests.values()
        for binding, one in test.results.items()
        if test.verifies and one.result != "passed" and not one.stale
    ]


def _unknown(model: Model) -> list[Finding]:
    tagged = [(test.place, name) for test in model.tests.values() for name in test.verifies]
    for module in model.modules.values():
        for method in module.methods:
            tagged += [(method.place, name) for name in method.satisfies]
    for machine in model.machines.values():
        for transition in machine.transitions:
            tagged += [(transition.place, name) for name in transition.requirements]
    for scenario in model.closed_loop:
        names = [figure.requirement for figure in scenario.figures if figure.requirement]
        tagged += [(scenario.place, name) for name in names]
    return [
        Finding(place, "req-unknown", f"there is no requirement {name}", "correct the id")
        for place, name in tagged
        if name not in model.requirements
    ]


def _tags(model: Model) -> list[Finding]:
    """A test that is named after a requirement verifies it."""
    found: list[Finding] = []
    for test in model.tests.values():
        match = re.match(r"(N?FR)_?(\d+)_", test.name)
        if match is None:
            continue
        name = f"{match[1]}-{match[2]}"
        if name not in test.verifies:
            found.append(
                Finding(
                    test.place,
                    "req-name",
                    f"{test.id} is named after {name} and does not verify it",
                    f"write @verifies {name} above it, or rename it",
                )
            )
    return found


def _lines(model: Model) -> list[Finding]:
    """Each line of a method is executed by tests of its requirements, or justified."""
    if model.stale_on(HOST):
        return []
    return [
        Finding(
            gap.place,
            "req-line",
            f"no test of {', '.join(gap.requirements) or 'any requirement'} executes "
            f"{_listed(gap.lines)} of {gap.method}",
            f"test it for its requirement, remove it, or justify it in {JUSTIFIED}",
        )
        for gap in model.line_gaps
        if not gap.reason
    ]


def _listed(lines: list[int]) -> str:
    return f"line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines))}"


def _reasons(model: Model, facts: Facts) -> list[Finding]:
    """No reason for what needs none."""
    if model.stale_on(HOST):
        return []
    gaps = {gap.method for gap in model.line_gaps}
    return [
        Finding(
            one.place,
            "req-line",
            f"tests of its requirements execute all lines of {one.method}, which is justified here",
            "remove the entry",
        )
        for one in facts.declared.justified.values()
        if one.method not in gaps
    ]


def _suspects(model: Model) -> list[Finding]:
    found = [
        Finding(
            one.place,
            f"suspect-{one.kind}",
            f"{one.name} {one.text}"
            if one.kind == "requirement"
            else f"{one.name}, which {_VERBS[one.kind]} {requirement.id}, {one.text}",
            f"look at it: ./wr review {requirement.id}",
        )
        for requirement in model.requirements.values()
        for one in requirement.suspicions
    ]
    return found + [
        Finding(
            Place(str(REVIEWS), 1),
            "suspect-requirement",
            f"{name} was reviewed and is no more",
            "remove its entry",
        )
        for name in model.reviews_of_nothing
    ]
