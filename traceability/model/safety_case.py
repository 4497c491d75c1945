"""Reads ``design/safety_case.toml`` and settles what this run shows of its goals."""

from __future__ import annotations

import ast
import itertools
import operator
import re
from collections.abc import Callable, Iterable
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

from traceability.model.entries import Entries, Entry, Keys
from traceability.model.link_texts import texts_of_test
from traceability.model.safety_cost import read_cost
from traceability.model.schema import (
    SOURCE_KINDS,
    Assumption,
    BindingResult,
    Correction,
    FaultScenario,
    Hazard,
    Model,
    Place,
    Requirement,
    SafeState,
    SafetyCase,
    SafetyGoal,
    SourceReference,
    Test,
)
from traceability.sources import files_below

if TYPE_CHECKING:
    from traceability.model.facts import Facts

FILE = Path("design/safety_case.toml")
SCENARIOS = Path("sim/scenario/safety")
GOAL_LINE = re.compile(r"#\s*goals?:?\s+(SG-\d+(?:[\s,]+SG-\d+)*)\s*$")
COLUMNS, ROWS = ("C0", "C1", "C2", "C3"), ("E0", "E1", "E2", "E3", "E4")

SAFE_STATE: Keys = {"id": str, "says": str, "safe": str, "not_safe": str}
ASSUMPTION: Keys = {"id": str, "title": str, "text": str, "by": str, "confirm": str}
GOAL: Keys = {
    **{"id": str, "title": str, "text": str, "safe_states": list, "time": Real, "formula": str},
    **{"because": str, "reaction": Real, "reacts": str, "requirements": list, "scenarios": list},
}
HAZARD: Keys = {
    **{"id": str, "title": str, "situation": str, "harm": str, "severity": str, "exposure": str},
    **{"avoidance": str, "goals": list, "assumptions": list, "answer": str},
}
OPERATORS: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}


def read_safety_case(root: Path, entries: Entries) -> SafetyCase:
    """The case as it is declared, with its scenarios; empty without the file."""
    path = root / FILE
    if not path.exists():
        return SafetyCase()
    item: dict[str, Any] = entries.value(path, "item", {})
    risk: dict[str, Any] = entries.value(path, "risk", {})
    case = SafetyCase(
        base=str(entries.value(path, "base", "")),
        says=str(item.get("says", "")),
        conditions=list(item.get("conditions", [])),
        limits=list(item.get("limits", [])),
        risk_source=str(risk.get("source", "")),
        levels=list(risk.get("levels", [])),
        graph={name: rows for name, rows in risk.items() if re.fullmatch(r"S\d", name)},
        words=dict(risk.get("words", {})),
        priorities=dict(risk.get("priority", {})),
        data_sheets=list(entries.value(path, "data_sheets", [])),
        scenarios=read_scenarios(root),
    )

    def read(name: str, keys: Keys) -> list[Entry]:
        return entries.tables(path, name, keys, own="id")

    states, assumed = read("safe_state", SAFE_STATE), read("assumption", ASSUMPTION)
    case.safe_states = {item["id"]: SafeState(**item, place=at) for item, at in states}
    case.assumptions = {item["id"]: Assumption(**item, place=at) for item, at in assumed}
    case.goals = {item["id"]: SafetyGoal(**item, place=at) for item, at in read("goal", GOAL)}
    case.hazards = {item["id"]: Hazard(**item, place=at) for item, at in read("hazard", HAZARD)}
    case.corrections = [
        Correction(i["paths"], i["why"], p, i.get("for_safety", 0))
        for i, p in entries.tables(
            path, "correction", {"paths": list, "why": str}, {"for_safety": int}
        )
    ]
    link(case)
    return case


def link(case: SafetyCase) -> None:
    """Derives levels, times and the links from goals and assumptions back to hazards."""
    for hazard in case.hazards.values():
        hazard.level = level_of(case, hazard.severity, hazard.exposure, hazard.avoidance)
        for name in hazard.goals:
            if name in case.goals:
                case.goals[name].hazards.append(hazard.id)
        for name in hazard.assumptions:
            if name in case.assumptions:
                case.assumptions[name].hazards.append(hazard.id)
    for goal in case.goals.values():
        goal.computed = evaluate(goal.formula)
        goal.level = highest(case, [case.hazards[name].level for name in goal.hazards])


def level_of(case: SafetyCase, severity: str, exposure: str, avoidance: str) -> str:
    """The performance level that the risk graph requires; empty when it has no such place."""
    rows = case.graph.get(severity, [])
    if exposure not in ROWS or avoidance not in COLUMNS or len(rows) != len(ROWS):
        return ""
    levels = rows[ROWS.index(exposure)].split()
    return levels[COLUMNS.index(avoidance)] if len(levels) == len(COLUMNS) else ""


def highest(case: SafetyCase, levels: Iterable[str]) -> str:
    known = [level for level in levels if level in case.levels]
    return max(known, key=case.levels.index) if known else ""


def evaluate(formula: str) -> float | None:
    """The value of a formula of numbers; ``None`` when it is none."""
    try:
        return _value(ast.parse(formula, mode="eval").body)
    except (SyntaxError, ValueError, ZeroDivisionError):
        return None


def _value(node: ast.expr) -> float:
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        return OPERATORS[type(node.op)](_value(node.left), _value(node.right))
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return float(node.value)
    raise ValueError("not a number")


def words_of(texts: Iterable[str]) -> list[str]:
    """The names in texts such as "SG-1, SG-2"."""
    return [word for text in texts for word in re.split(r"[\s,]+", text.strip(" .")) if word]


def read_sources(text: str) -> list[SourceReference]:
    """The references of a text such as "goal: SG-2; paper: Section VII"; other words: no kind."""
    found: list[SourceReference] = []
    for part in filter(None, (one.strip() for one in text.split(";"))):
        kind, colon, name = part.partition(":")
        known = bool(colon) and kind.strip() in SOURCE_KINDS
        found.append(
            SourceReference(kind.strip(), name.strip().rstrip("."))
            if known
            else SourceReference("", part)
        )
    return found


# ---- fault scenarios ------------------------------------------------------------


def read_scenarios(root: Path) -> dict[str, FaultScenario]:
    """Name -> scenario: the first comment is its title, "# goal SG-1" names its goals."""
    paths = files_below(root, (str(SCENARIOS),), (".scenario",))
    return {path.stem: _scenario(root, path) for path in paths}


def _scenario(root: Path, path: Path) -> FaultScenario:
    lines = path.read_text(encoding="utf-8").splitlines()
    goals = [match[1] for line in lines if (match := GOAL_LINE.match(line))]
    first = itertools.takewhile(lambda line: line.startswith("#"), lines)
    title = " ".join(line.strip("# ") for line in first if not GOAL_LINE.match(line))
    place = Place(str(path.relative_to(root)), 1)
    return FaultScenario(path.stem, title or path.stem, words_of(goals), place)


def add_safety(model: Model, facts: Facts) -> None:
    """The case with the tests that play its scenarios, and what git counts.

    A parameterised test that names their folder may play each of them, until it has run.
    """
    model.safety = facts.declared.safety
    if not model.safety.goals:
        return
    model.safety.cost = read_cost(facts.root, model.safety)
    texts = {test.place.file: "" for test in model.tests.values()}
    texts = {file: _playing(facts.root / file) for file in texts}
    for test in model.tests.values():
        body = " ".join(texts_of_test(texts[test.place.file], test.id))
        runs = [name for result in test.results.values() for name in result.recordings]
        every = not runs and body.startswith("TEST_P") and str(SCENARIOS) in texts[test.place.file]
        for scenario in model.safety.scenarios.values():
            if every or plays(scenario.name, test.name, body, runs):
                scenario.tests.append(test.id)


def _playing(path: Path) -> str:
    """The text of a file of tests that may play scenarios; empty of another one."""
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return text if "scenario" in text.lower() else ""


def plays(scenario: str, case: str, body: str, runs: Iterable[str]) -> bool:
    """Whether a test names a scenario in its body, or has an instance with its name."""
    named = re.search(rf'"(?:[\w/.]*/)?{re.escape(scenario)}(?:\.scenario)?"', body)
    return named is not None or any(run.endswith(f".{case}_{scenario}") for run in runs)


# ---- verdicts -------------------------------------------------------------------


def settle_safety(model: Model) -> None:
    """The state of each scenario and each goal, after that of the requirements."""
    for scenario in model.safety.scenarios.values():
        scenario.state = scenario_state(model, scenario)
    for goal in model.safety.goals.values():
        goal.reasons = [*_reasons(model, goal)]
        states = [one.state for one in requirements_of(model, goal)]
        states += [one.state for one in scenarios_of(model, goal)]
        goal.state = "open" if goal.reasons else "verified"
        if "failed" in states:
            goal.state = "failed"


def requirements_of(model: Model, goal: SafetyGoal) -> list[Requirement]:
    return [model.requirements[name] for name in goal.requirements if name in model.requirements]


def scenarios_of(model: Model, goal: SafetyGoal) -> list[FaultScenario]:
    known = model.safety.scenarios
    return [known[name] for name in goal.scenarios if name in known]


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
    """The result of the instance that plays a scenario; of the whole test where there is none."""
    end = f".{test.name}_{scenario.name}"
    own = [result for name, result in run.instances.items() if name.endswith(end)]
    return next(iter(own), run.result)


def _reasons(model: Model, goal: SafetyGoal) -> Iterable[str]:
    """Why a goal is not verified in this run."""
    if not goal.requirements:
        yield "no requirement serves it"
    for name in goal.requirements:
        requirement = model.requirements.get(name)
        if requirement is None:
            yield f"there is no requirement {name}"
        elif requirement.state == "partly":
            yield f"{name} is partly verified: {requirement.partly}"
        elif requirement.state != "verified":
            yield f"{name} is {STATES[requirement.state]}"
    if not goal.scenarios:
        yield "no fault scenario is about it"
    for name in goal.scenarios:
        scenario = model.safety.scenarios.get(name)
        if scenario is None:
            yield f"there is no scenario {name}"
        elif scenario.state != "verified":
            yield f"the scenario {name} is {STATES[scenario.state]}"


STATES = {
    "failed": "failed",
    "stale": "verified by results that are older than the sources",
    "suspect": "suspect: it or what it is linked to changed since the review",
    "unverified": "not verified in this run",
}
