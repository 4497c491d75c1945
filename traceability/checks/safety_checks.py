"""hazard-*: the safety case is complete. Its parts name only parts that exist, and no necessary
link between two parts is missing."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Sequence

from traceability.model.design_model import Model
from traceability.model.safety_case import scenario_state, scenarios_of
from traceability.reading.formulas import value_of
from traceability.reading.plain_constants import plain_constants
from traceability.reading.source_facts import Facts
from traceability.schema import Assumption, Finding, Hazard, Place, SafetyGoal

ID = {"HZ": "hazard", "SG": "safety goal", "AU": "assumption of use"}
LIMIT = "SystemConstants::velocityLimit"  # [0.1 rpm] at the motor shaft
GEAR = "plant::DriveTrain::kRatio"
RADIUS = "plant::DriveTrain::kRadius"  # [m]
TOLERANCE = 0.01
PRIORITIES = ("low", "medium", "high")
WITHIN = re.compile(r"\bwithin ([\d.]+) ms\b")  # the longest time of an expectation


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    if not model.safety.goals and not model.safety.hazards:
        return
    for find in (_names, _hazards, _goals, _times, _velocities, _assumptions):
        yield from find(model, facts)
    for find_in in (_bounds, _requirements, _scenarios, _priorities):
        yield from find_in(model)


def _names(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds ids with a wrong form (the id of a hazard must be HZ-n). Also finds names in the safety
    case that are not declared."""
    case = model.safety
    kinds = (("HZ", case.hazards), ("SG", case.goals), ("AU", case.assumptions))
    for prefix, items in kinds:
        for item in items.values():
            if not re.fullmatch(rf"{prefix}-\d+", item.id):
                text = f"{item.id} is not an id of a {ID[prefix]}"
                fix = f"write {prefix}- and a number"
                yield Finding(_at(facts, item), "hazard-name", text, fix)
    named: list[tuple[Hazard | SafetyGoal, Sequence[str], Collection[str]]] = []
    for hazard in case.hazards.values():
        named += [(hazard, hazard.goals, case.goals), (hazard, hazard.scenarios, case.scenarios)]
        named.append((hazard, hazard.assumptions, case.assumptions))
    named += [(goal, goal.safe_states, case.safe_states) for goal in case.goals.values()]
    for owner, names, declared in named:
        for name in names:
            if name not in declared:
                text = f"{owner.id} names {name}, which is not declared"
                yield Finding(facts.line_in(owner.place, name), "hazard-name", text)


def _at(facts: Facts, item: Assumption | Hazard | SafetyGoal) -> Place:
    """Returns the line with the id of an entry."""
    return facts.line_in(item.place, item.id)


def _hazards(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds hazards that have neither a goal nor an assumption. Also finds hazards for which the
    risk graph has no level."""
    for hazard in model.safety.hazards.values():
        if not hazard.goals and not hazard.assumptions:
            text = f"{hazard.id} has no safety goal and no assumption of use"
            fix = "name the goal that prevents it, or the assumption that covers it"
            yield Finding(_at(facts, hazard), "hazard-covered", text, fix)
        if not hazard.level:
            risk = f"{hazard.severity}, {hazard.exposure}, {hazard.avoidance}"
            text = f"the risk graph has no level for {risk} of {hazard.id}"
            fix = "write S0 to S3, E0 to E4 and C0 to C3, or complete the graph"
            yield Finding(_at(facts, hazard), "hazard-covered", text, fix)


def _goals(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds safety goals for which a hazard, the requirements or the safe state is missing."""
    for goal in model.safety.goals.values():
        parts = {
            "hazard": (goal.hazards, "name it in the goals of a hazard, or remove it"),
            "requirement": (goal.requirements, f"write @goal {goal.id} below a requirement"),
            "safe state": (goal.safe_states, "name a safe state that is declared"),
        }
        for part, (there, fix) in parts.items():
            if not there:
                yield Finding(_at(facts, goal), "hazard-goal", f"{goal.id} has no {part}", fix)


def _times(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds safety goals with a wrong time. The time must agree with the value of the goal's
    formula, and must not be shorter than the reaction time of the firmware. If the key ``parts`` of
    the goal contains a formula, the reaction time must agree with the value of this formula."""
    for goal in model.safety.goals.values():
        if goal.computed is None:
            text = f"the formula of {goal.id} has no value: {goal.formula}"
            yield Finding(_at(facts, goal), "hazard-time", text)
        elif goal.time > goal.computed + 1e-9 or goal.time < 0.9 * goal.computed:
            time, computed = f"{goal.time:g} s", f"{goal.computed:.3g} s"
            text = f"the time of {goal.id} is {time}, but the value of its formula is {computed}"
            yield Finding(_at(facts, goal), "hazard-time", text)
        parts = value_of(goal.parts, model.constants) if goal.parts else 1000 * goal.reaction
        if parts is None:
            text = f"the formula 'parts' of {goal.id} has no value: {goal.parts}"
            yield Finding(_at(facts, goal), "hazard-time", text)
        elif not 0.999 * parts <= 1000 * goal.reaction <= 1.1 * parts:
            reaction, needed = f"{goal.reaction:g} s", f"{parts:.4g} ms"
            text = f"the reaction time of {goal.id} is {reaction}, but its formula gives {needed}"
            yield Finding(_at(facts, goal), "hazard-time", text, "correct the reaction time")
        if goal.reaction > goal.time:
            needed, allowed = f"{goal.reaction:g} s", f"{goal.time:g} s"
            text = f"the firmware needs {needed} for {goal.id}, but the goal allows {allowed}"
            yield Finding(_at(facts, goal), "hazard-time", text)


def _velocities(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds safety goals whose velocity differs from the greatest velocity that the robot accepts
    in an order. Also finds velocities that the formula of the goal does not contain."""
    simulated = plain_constants(facts.root)
    limit, gear, radius = model.constants.get(LIMIT), simulated.get(GEAR), simulated.get(RADIUS)
    for goal in model.safety.goals.values():
        if not goal.velocity:
            continue
        velocity = f"{goal.velocity:g}"
        if velocity not in re.findall(r"[\d.]+", goal.formula):
            text = f"the formula of {goal.id} does not contain its velocity of {velocity} m/s"
            yield Finding(_at(facts, goal), "hazard-time", text)
        if limit and gear and radius:
            turns = limit.number / 10 / 60 / gear.number
            greatest = turns * 2 * math.pi * radius.number
            if abs(goal.velocity - greatest) > TOLERANCE * greatest:
                text = (
                    f"{goal.id} declares a velocity of {velocity} m/s, but the greatest ordered "
                    f"velocity is {greatest:.2f} m/s"
                )
                fix = "calculate the formula and the time of the goal again"
                yield Finding(_at(facts, goal), "hazard-time", text, fix)


def _bounds(model: Model) -> Iterator[Finding]:
    """Finds scenarios that accept a slower reaction than their safety goal allows. Goals with
    declared exceptions are not checked."""
    for goal in model.safety.goals.values():
        for scenario in () if goal.exceptions else scenarios_of(model, goal):
            for line, expectation in scenario.expects.items():
                allows = WITHIN.search(expectation)
                bound = float(allows[1]) / 1000 if allows else 0
                if bound > goal.time:
                    accepts, allowed = f"accepts {bound:g} s", f"allows {goal.time:g} s"
                    text = f"the scenario {scenario.name} {accepts}, but {goal.id} {allowed}"
                    fix = f"shorten the time, or add an exception to {goal.id}"
                    yield Finding(Place(scenario.place.file, line), "hazard-time", text, fix)


def _requirements(model: Model) -> Iterator[Finding]:
    """Finds requirements whose @goal does not exist."""
    for requirement in model.requirements.values():
        for name in [name for name in requirement.goals if name not in model.safety.goals]:
            text = f"{requirement.id} names the goal {name}, which does not exist"
            yield Finding(requirement.place, "hazard-requirement", text, "correct the tag @goal")


def _scenarios(model: Model) -> Iterator[Finding]:
    """Finds fault scenarios that name no goal, or a goal that does not exist. Finds hazards and
    fault scenarios without a common goal, if the hazard lists the scenario. Also finds fault
    scenarios that are listed in no hazard or played in no test, and fault scenarios whose tests did
    not pass."""
    hazards = model.safety.hazards.values()
    for scenario in model.safety.scenarios.values():
        where, check = scenario.place, "hazard-scenario"
        if not scenario.goals:
            fix = "write the goal as a comment, such as '# goal SG-1', below the title"
            yield Finding(where, check, f"the scenario {scenario.name} names no goal", fix)
        for name in [name for name in scenario.goals if name not in model.safety.goals]:
            text = f"the scenario {scenario.name} names the goal {name}, which does not exist"
            yield Finding(where, check, text)
        listing = [hazard for hazard in hazards if scenario.name in hazard.scenarios]
        existing = model.safety.goals.keys() & scenario.goals
        for hazard in listing if existing else ():
            if existing.isdisjoint(hazard.goals):
                said = f"{hazard.id} lists the scenario {scenario.name}"
                text = f"{said}, but the hazard and the scenario have no goal in common"
                fix = (
                    "in the scenario, name a goal of the hazard; or remove the scenario from the "
                    "hazard"
                )
                yield Finding(where, check, text, fix)
        if not listing:
            text = f"the scenario {scenario.name} is listed in no hazard"
            fix = "add it to the scenarios of a hazard in design/safety_case.toml"
            yield Finding(where, check, text, fix)
        if not scenario.tests:
            text = f"the scenario {scenario.name} is played in no test"
            yield Finding(where, check, text)
        elif (state := scenario_state(model, scenario)) in ("failed", "unverified"):
            word = "failed" if state == "failed" else "did not pass"
            text = f"the scenario {scenario.name} {word} in {', '.join(scenario.tests)}"
            yield Finding(where, check, text)


def _assumptions(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds assumptions of use that are named in no hazard."""
    for assumption in model.safety.assumptions.values():
        if not assumption.hazards:
            text = f"{assumption.id} covers no hazard"
            yield Finding(_at(facts, assumption), "hazard-assumption", text)


def _priorities(model: Model) -> Iterator[Finding]:
    """Finds requirements with a priority that is too low. A requirement serves safety goals. The
    levels of these goals determine the lowest permitted priority of the requirement."""
    case = model.safety
    for requirement in model.requirements.values():
        demanded = [
            case.priorities[case.goals[name].level]
            for name in requirement.goals
            if name in case.goals and case.goals[name].level in case.priorities
        ]
        least = max(demanded, key=PRIORITIES.index, default="low")
        present = requirement.priority
        if present in PRIORITIES and PRIORITIES.index(present) < PRIORITIES.index(least):
            text = f"{requirement.id} has the priority {present}, but its goals demand {least}"
            yield Finding(requirement.place, "hazard-priority", text)
