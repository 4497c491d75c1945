"""The safety case with the tests of its scenarios, and the verdicts of its safety goals in this
run."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace

from traceability.model.design_model import Model
from traceability.model.report import Verdict
from traceability.reading.declared_safety import SCENARIOS
from traceability.reading.gtest_cases import read_tests
from traceability.reading.safety_cost import read_cost
from traceability.reading.source_facts import Facts
from traceability.schema import BindingResult, FaultScenario, SafetyCase, SafetyGoal, Test
from traceability.sources import text_of


def safety_of(model: Model, facts: Facts) -> SafetyCase:
    """Returns the safety case with the requirements of each goal, the tests that execute the
    scenarios, and the cost of the safety functions.

    If the file of a parameterised test names the folder of the scenarios, the test may execute any
    scenario. The recordings of the test show which scenarios the test executed. If such a test has
    no recordings, it is regarded as a test of all scenarios."""
    case = facts.declared.safety
    if not case.goals:
        return case
    playing: dict[str, list[str]] = {}
    files = dict.fromkeys(test.place.file for test in model.tests.values())
    texts = {file: text_of(facts.root / file) for file in files}
    playing_texts = (text for text in texts.values() if "scenario" in text.lower())
    code = {case.id: case.code for text in playing_texts for case in read_tests(text)}
    for test in model.tests.values():
        body = code.get(test.id, "")
        runs = [name for result in test.results.values() for name in result.recordings]
        every = not runs and body.startswith("TEST_P") and str(SCENARIOS) in texts[test.place.file]
        for name in case.scenarios:
            if every or plays(name, test.name, body, runs):
                playing.setdefault(name, []).append(test.id)
    scenarios = {
        name: replace(scenario, tests=playing.get(name, []))
        for name, scenario in case.scenarios.items()
    }
    goals = {
        name: replace(
            goal,
            requirements=[item.id for item in model.requirements.values() if name in item.goals],
        )
        for name, goal in case.goals.items()
    }
    return replace(case, scenarios=scenarios, goals=goals, cost=read_cost(facts.root, case))


def plays(scenario: str, case: str, body: str, runs: Iterable[str]) -> bool:
    """Returns true in two cases: the code of a test contains the name of a scenario as a string, or
    an instance of the test has the name of the scenario."""
    named = re.search(rf'"(?:[\w/.]*/)?{re.escape(scenario)}(?:\.scenario)?"', body)
    return named is not None or any(run.endswith(f".{case}_{scenario}") for run in runs)


# ---- verdicts -------------------------------------------------------------------


def safety_verdicts(
    model: Model, requirements: Mapping[str, Verdict]
) -> tuple[dict[str, str], dict[str, Verdict]]:
    """Returns the states of the fault scenarios, and the verdicts of the goals."""
    scenarios = {
        name: scenario_state(model, scenario) for name, scenario in model.safety.scenarios.items()
    }
    states = scenarios | {name: verdict.state for name, verdict in requirements.items()}
    goals = {name: _verdict(model, goal, states) for name, goal in model.safety.goals.items()}
    return scenarios, goals


def _verdict(model: Model, goal: SafetyGoal, states: Mapping[str, str]) -> Verdict:
    reasons = [*_reasons(model, goal, states)]
    failed = "failed" in {states[name] for name in (*goal.requirements, *goal.scenarios)}
    return Verdict("failed" if failed else "open" if reasons else "verified", reasons)


def scenarios_of(model: Model, goal: SafetyGoal) -> list[FaultScenario]:
    return [model.safety.scenarios[name] for name in goal.scenarios]


def scenario_state(model: Model, scenario: FaultScenario) -> str:
    tests = [model.tests[name] for name in scenario.tests]
    if any(run.stale for test in tests for run in test.results.values()):
        return "stale"
    results = [own_result(scenario, test, run) for test in tests for run in test.results.values()]
    if "failed" in results:
        return "failed"
    passed = bool(results) and all(result == "passed" for result in results)
    return "verified" if passed else "unverified"


def own_result(scenario: FaultScenario, test: Test, run: BindingResult) -> str | None:
    """Returns the result of the test instance that executes a scenario. If no instance executes the
    scenario, returns the result of the whole test."""
    end = f".{test.name}_{scenario.name}"
    own = [result for name, result in run.instances.items() if name.endswith(end)]
    return next(iter(own), run.result)


def _reasons(model: Model, goal: SafetyGoal, states: Mapping[str, str]) -> Iterable[str]:
    yield from (f"known exception: {case}" for case in goal.exceptions)
    yield from (f"open point: {point}" for point in goal.open_points)
    if not goal.requirements:
        yield "no requirement serves this goal"
    for name in goal.requirements:
        state = states[name]
        if state == "partly":
            yield f"{name} is partly verified: {model.requirements[name].partly}"
        elif state != "verified":
            yield f"{name} is {STATES[state]}"
    if not goal.scenarios:
        yield "no fault scenario tests this goal"
    for name in goal.scenarios:
        if states[name] != "verified":
            yield f"the scenario {name} is {STATES[states[name]]}"


STATES = {
    "failed": "not verified: a test failed",
    "stale": "verified by results that are older than the sources",
    "suspect": "suspect: a text on which its verdict depends changed since the baseline",
    "unverified": "not verified in this run",
}
