"""fsm-*: each state machine in design/fsm has the same transitions as the code, and each of these
transitions occurs in a passed test."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

from traceability.model.design_model import Model
from traceability.model.state_machines import Change, MachineCode, is_stay, matching, read_machine
from traceability.reading.ast_facts import BodyFact
from traceability.reading.source_facts import Facts
from traceability.reading.traces import nodes_of
from traceability.schema import Finding, Place, Requirement, StateMachine, Transition

_WITH_UNIT = re.compile(
    r"(?<![\w.])\d[\d.]*\s*(?:[mu]?s|mm?|m?[VA]|%|rpm|cycles|degrees?|steps/s)(?!\w)"
)
_ALIKE = (
    "another transition of this state has the same event, and no guard distinguishes the two "
    "transitions",
    "remove one of the two transitions, or write a different guard for each",
)


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _machines_missing(model, facts)
    for machine in model.machines.values():
        problems = list(_declared(machine, model, facts))
        yield from problems
        if problems:
            continue
        code = read_machine(machine, facts)
        yield from _code(machine, code, facts)
        yield from _conditions(machine, code)
        yield from _actions(machine, code, facts)
        if not model.results_stale:
            yield from _seen(machine)
            yield from _shown(machine, model, facts)


def _machines_missing(model: Model, facts: Facts) -> Iterator[Finding]:
    declared = {machine.application for machine in model.machines.values()}
    for name in facts.declared.applications.keys() - declared:
        application = model.patterns.get(name)
        if application and application.pattern == "State":
            text = f"the states of {application.id} have no state machine"
            yield Finding(application.place, "fsm-declared", text)


def _declared(machine: StateMachine, model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds states, events, operations and requirements that do not exist although a state machine
    names them."""

    def finding(text: str, fix: str, name: str, entry: Place = machine.place) -> Finding:
        return Finding(facts.line_in(entry, name), "fsm-declared", text, fix)

    declared = facts.declared.applications.get(machine.application)
    if declared is None or declared.pattern != "State":
        text = (
            f"{machine.id} names the application {machine.application}, which is not an "
            "application of the State pattern"
        )
        yield finding(text, "correct the application", "application")
        return
    states = set(declared.roles.get("Concrete State", []))
    for name in sorted(states ^ set(machine.states.values())):
        has, kind = ("no state for", "a") if name in states else ("the state", "not a")
        text = f"{machine.id} has {has} {name}, which is {kind} Concrete State of {declared.id}"
        yield finding(text, "correct the states of the machine", f'"{name}"')
    base = declared.roles.get("State", [""])[0]
    for event, operation in machine.events.items():
        if facts.method(base, operation) is None:
            text = f"the event '{event}' calls {base}::{operation}, which does not exist"
            yield finding(text, "name the operation of the state that the event calls", event)
    if machine.initial not in machine.states:
        text = f"the initial state {machine.initial} is not a state of {machine.id}"
        yield finding(text, "name one of its states", "initial")
    for number, step in enumerate(machine.transitions):
        problems = [*_wrong_names(step, machine), *_asked_for(step, machine, model, facts)]
        for text, fix, word in problems:
            yield finding(text, fix, word, step.place)
        if _like_another(step, number, machine):
            yield finding(*_ALIKE, "from", step.place)
    for event in machine.events.keys() - {step.event for step in machine.transitions}:
        yield finding(f"no transition uses the event '{event}'", "remove it", event)


def _wrong_names(step: Transition, machine: StateMachine) -> Iterator[tuple[str, str, str]]:
    """Yields the faults in the states and the event of a transition. Also yields a fault if the
    transition has no requirement. Each fault has a text, a fix, and the word to which the finding
    points."""
    for name in (step.source, step.target):
        if name not in machine.states:
            yield f"there is no state {name}", "correct the name", name
    if step.event not in machine.events:
        fix = "write the operation of the event in [events], or correct the name of the event"
        yield f"the event '{step.event}' has no operation", fix, step.event
    if not step.requirements:
        yield f"{words(step)} serves no requirement", "name its requirements", "requirements"


def _asked_for(
    step: Transition, machine: StateMachine, model: Model, facts: Facts
) -> Iterator[tuple[str, str, str]]:
    """Yields the faults in the requirements of a transition. Each fault has a text, a fix, and the
    word to which the finding points."""
    requirements = []
    for name in step.requirements:
        if name in model.requirements:
            requirements.append(model.requirements[name])
        else:
            yield f"there is no requirement {name}", "correct the id", name
    ends = {machine.states[name] for name in (step.source, step.target) if name in machine.states}
    family = ends.union(*(facts.classes[end].bases for end in ends if end in facts.classes))
    fix = "name the requirement that demands the transition, or tag the method"
    for requirement in requirements:
        named = f"the transition {words(step)} names {requirement.id}, but"
        if not any(method.split("::")[0] in family for method in _serving(requirement)):
            methods = f"no method of {' or '.join(sorted(ends))}"
            yield f"{named} {methods} serves this requirement", fix, requirement.id
        if step.event in machine.events and not _serves_event(requirement, step, machine):
            methods = f"neither {machine.events[step.event]} nor the action"
            yield f"{named} {methods} serves this requirement", fix, requirement.id
    for part in (step.event, step.guard, step.action):
        for figure in _not_asked(part, requirements):
            text = f"no requirement of {words(step)} states the number '{figure[0]}'"
            yield text, "write a number that the requirement states", figure[0]


def _serves_event(requirement: Requirement, step: Transition, machine: StateMachine) -> bool:
    """Returns whether the event or the action of a transition serves a requirement. The event
    serves the requirement through its operation, and the action through one of its methods."""
    operation, actions = machine.events[step.event], machine.actions.get(step.action, [])
    return any(
        method.rpartition("::")[2] == operation or method in actions
        for method in _serving(requirement)
    )


def _serving(requirement: Requirement) -> list[str]:
    """Returns the methods that have a tag @satisfies for a requirement, and the methods in the
    invocation tree of this requirement."""
    nodes = nodes_of(requirement.tree) if requirement.tree else []
    called = [name for node in nodes for name in (node.label, node.resolved or "")]
    return [*requirement.satisfied_by, *called]


def _like_another(step: Transition, number: int, machine: StateMachine) -> bool:
    """Returns true if the guards do not distinguish the transition ``step`` from another transition
    that has the same state and the same event."""
    others = [
        (other.guard, place)
        for place, other in enumerate(machine.transitions)
        if place != number and (other.source, other.event) == (step.source, step.event)
    ]
    same = any(guard == step.guard and place < number for guard, place in others)
    return same or (not step.guard and any(guard for guard, _ in others))


def words(step: Transition) -> str:
    guard = f" [{step.guard}]" if step.guard else ""
    return f"{step.source} > {step.target} on {step.event}{guard}"


def _code(machine: StateMachine, code: MachineCode, facts: Facts) -> Iterator[Finding]:
    if not code.storage or not code.holders:
        with_states = "class of the robot that contains all states of the machine"
        part = with_states if code.holders else "Context"
        text = f"the code has no {part}, so no check can compare the transitions of {machine.id}"
        yield Finding(machine.place, "fsm-code", text, "compose the states in one class")
        return
    yield from _initial(machine, code, facts)
    for state in machine.states:
        for operation in code.operations:
            yield from _operation(machine, code, state, operation)


def _initial(machine: StateMachine, code: MachineCode, facts: Facts) -> Iterator[Finding]:
    if code.initial == {machine.initial}:
        return
    given = ", ".join(sorted(code.initial)) or "no state"
    text = f"{code.storage} begins with {given}, but the machine begins with {machine.initial}"
    fix = "correct 'initial', or pass the initial state of the machine to the Context"
    place = facts.line_in(machine.place, "initial")
    yield Finding(place, "fsm-code", text, fix)


def _operation(
    machine: StateMachine, code: MachineCode, state: str, operation: str
) -> Iterator[Finding]:
    """Compares the state changes in one operation of a state with the declared transitions. For
    each target state, the code must contain as many changes as the machine has transitions."""
    rows = _rows(machine, state, operation)
    changes = code.of(state, operation)
    for target in {change.target for change in changes} | {row.target for row in rows}:
        here = [row for row in rows if row.target == target and not is_stay(row)]
        made = [change for change in changes if change.target == target]
        if len(made) > len(here):
            yield from (_undeclared(machine, change) for change in made[len(here) :])
        elif len(here) > len(made):
            yield from (_not_made(row, state, operation) for row in here[len(made) :])
        elif len(rows) == 1:
            yield from (_guarded(here[0], change) for change in made if _differs(here[0], change))
    yield from _out_of_order(rows, changes)
    if not code.stays(state, operation):
        for row in rows:
            if is_stay(row):
                text = (
                    f"{state}::{operation} always changes the state, so the transition "
                    f"{words(row)} cannot stay in the state"
                )
                yield Finding(row.place, "fsm-code", text)


def _out_of_order(rows: list[Transition], changes: list[Change]) -> Iterator[Finding]:
    """Finds pairs of transitions if the order of their guards in the code differs from their order
    in the declaration. If both guards are true at the same time, the order in the code decides
    which transition occurs."""
    places: dict[str, list[int]] = {}
    for number, change in enumerate(changes):
        places.setdefault(change.target, []).append(number)
    compared = [(row, places[row.target].pop(0)) for row in rows if places.get(row.target)]
    for (before, earlier), (after, later) in itertools.pairwise(compared):
        if before.event == after.event and earlier > later:
            text = (
                f"the transition {words(before)} is declared before the transition "
                f"{words(after)}, but the code evaluates their guards in the other order"
            )
            yield Finding(before.place, "fsm-code", text, "exchange the transitions")


def _differs(row: Transition, change: Change) -> bool:
    """Compares the change in the code with the declared transition ``row``. Returns true if only
    the change or only the transition has a condition.

    An event with a time, such as "after 2 s", is regarded as a condition of the transition. A guard
    about the state of another machine ("in ...") is not compared, because the code that calls the
    operation checks this guard.
    """
    if _is_state_of_other(row.guard):
        return False
    return change.sometimes != bool(row.guard or _WITH_UNIT.search(row.event))


def _is_state_of_other(guard: str) -> bool:
    """Returns whether a guard names a state of another machine, such as "in Reconnecting"."""
    return guard.startswith("in ") and guard[3:4].isupper()


def _rows(machine: StateMachine, state: str, operation: str) -> list[Transition]:
    return [
        row
        for row in machine.transitions
        if row.source == state and machine.events[row.event] == operation
    ]


def _asked(machine: StateMachine, row: Transition) -> set[str]:
    """Returns the conditions that the code must check for a transition. The table [guards] of the
    machine's file lists these conditions for the guard and for the event."""
    return {*machine.guards.get(row.guard, ()), *machine.guards.get(row.event, ())}


def _known_before(machine: StateMachine, code: MachineCode, change: Change) -> set[str]:
    """Returns all declared conditions that the code may have checked before a change: the
    conditions of the change itself, and of the changes above it in the same operation."""
    changes = code.of(change.source, change.operation)
    before = changes[: changes.index(change) + 1]
    # One call can have several possible new states. ``code.changes`` then contains several changes
    # at the same place.
    before += [other for other in changes if other.place == change.place]
    evaluated = {way for other in changes for way in other.path}
    for row in _rows(machine, change.source, change.operation):
        made = matching(machine, row, code)
        if any(other in before for other in made) or is_stay(row):
            evaluated |= _asked(machine, row)
    return evaluated


def _conditions(machine: StateMachine, code: MachineCode) -> Iterator[Finding]:
    """Compares the conditions that the code checks before a state change with the conditions of the
    declared guards."""
    for row in [row for row in machine.transitions if not is_stay(row)]:
        if row.guard and row.guard not in machine.guards and not _is_state_of_other(row.guard):
            text = f"the table [guards] lists no condition for the guard '{row.guard}'"
            yield Finding(row.place, "fsm-code", text, "add a condition, or correct the guard")
        for change in matching(machine, row, code):
            for question in sorted(_asked(machine, row) - set(change.asked)):
                text = (
                    f"{words(row)} needs '{question}', but the code does not check this condition"
                )
                fix = "correct the guard, or the code"
                yield Finding(change.place, "fsm-code", text, fix)
    for change in code.changes:
        evaluated = _known_before(machine, code, change)
        for question in sorted(set(change.asked) - evaluated):
            change_text = f"the change from {change.source} to {change.target}"
            text = f"{change_text} checks '{question}', but no guard contains this condition"
            fix = f"declare the condition in [guards] of {machine.place.file}, or remove its check"
            yield Finding(change.place, "fsm-code", text, fix)


def _actions(machine: StateMachine, code: MachineCode, facts: Facts) -> Iterator[Finding]:
    """Compares the calls in an operation of a state with the actions that the transitions of this
    operation declare."""
    for state, operations in code.runs.items():
        for operation, method in operations.items():
            rows = _rows(machine, state, operation)
            ways = {way for change in code.of(state, operation) for way in change.path}
            bodies = [body for name in (method, *ways) for body in facts.bodies.get(name, [])]
            called = {call.target for body in bodies for call in body.calls}
            declared = {name for row in rows for name in machine.actions.get(row.action, ())}
            every = {name for names in machine.actions.values() for name in names}
            for row in rows:
                made = matching(machine, row, code)
                actions = machine.actions.get(row.action, ["an entry in [actions]"])
                before = called if is_stay(row) else _before(made, bodies)
                for name in actions if row.action else ():
                    if name not in before:
                        text = f"the action '{row.action}' of {words(row)} lacks {name}"
                        yield Finding(row.place, "fsm-code", text)
                always = (
                    _always(method, facts) if is_stay(row) else _just_before(made, code, bodies)
                )
                for name in sorted((declared & always).difference(actions)):
                    text = f"{words(row)} does not declare {name}, but the code calls this method"
                    yield Finding(row.place, "fsm-code", text)
            for name in sorted((every & called) - declared):
                text = f"{method} calls {name}, but no transition has this action"
                yield Finding(bodies[0].place, "fsm-code", text)


def _before(changes: list[Change], bodies: list[BodyFact]) -> set[str]:
    """Returns the methods that can be called before a state change. A call in the same function as
    the change must be above the change."""
    return {
        call.target
        for change in changes
        for body in bodies
        for call in body.calls
        if not _is_in(body, change.place) or call.place.line <= change.place.line
    }


def _just_before(changes: list[Change], code: MachineCode, bodies: list[BodyFact]) -> set[str]:
    """Returns the methods that the function with a state change always calls before this change.
    Only the calls after the previous change of this function are certain, because a function often
    ends after a change."""
    lines = {(change.place.file, change.place.line) for change in code.changes}
    return {
        call.target
        for change in changes
        for body in bodies
        for call in body.calls
        if _is_in(body, change.place) and call.place.line <= change.place.line
        if set(call.asked) <= set(change.asked)
        if not any(
            file == change.place.file and call.place.line <= line < change.place.line
            for file, line in lines
        )
    }


def _always(method: str, facts: Facts) -> set[str]:
    """Returns the methods that are called on every path through a method."""
    return {
        call.target
        for body in facts.bodies.get(method, [])
        for call in body.calls
        if not call.sometimes
    }


def _is_in(body: BodyFact, place: Place) -> bool:
    return body.place.file == place.file and body.place.line <= place.line <= body.end


def _guarded(row: Transition, change: Change) -> Finding:
    made = "on some paths only" if change.sometimes else "on every path"
    declared = "a guard" if row.guard else "no guard"
    maker = f"{change.source}::{change.operation}"
    text = f"{words(row)} has {declared}, but {maker} makes this transition {made}"
    return Finding(change.place, "fsm-code", text)


def _undeclared(machine: StateMachine, change: Change) -> Finding:
    where = f"{change.source}::{change.operation}"
    if not change.target:
        text = f"{where} changes to a state, but no builder passes this state to {change.source}"
        fix = "change to a state that a builder passes to the constructor"
        return Finding(change.place, "fsm-code", text, fix)
    text = (
        f"{where} changes the state to {change.target}, but {machine.id} does not declare this "
        "transition"
    )
    return Finding(change.place, "fsm-code", text)


def _not_made(row: Transition, state: str, operation: str) -> Finding:
    text = f"{words(row)} is declared, but {state}::{operation} does not make this transition"
    return Finding(row.place, "fsm-code", text)


def _seen(machine: StateMachine) -> Iterator[Finding]:
    for step in machine.transitions:
        if not step.tests:
            text = f"no passing test makes the transition {words(step)}"
            yield Finding(step.place, "fsm-seen", text)
    for change, tests in machine.undeclared.items():
        source, operation, target = change.split(" ")
        text = (
            f"{tests[0]} changes the state from {source} to {target} in {operation}, but the "
            "machine does not declare this transition"
        )
        yield Finding(machine.place, "fsm-seen", text)


def _shown(machine: StateMachine, model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds transitions that name a requirement, although no passed test of this requirement makes
    the transition."""
    for step in machine.transitions:
        for name in step.requirements:
            if step.tests and set(model.requirements[name].verified_by).isdisjoint(step.tests):
                text = f"no passing test of {name} makes the transition {words(step)}"
                yield Finding(facts.line_in(step.place, name), "fsm-seen", text)


def _not_asked(text: str, requirements: list[Requirement]) -> list[re.Match[str]]:
    """Returns each number with a unit in a text (for example "2 s"), if none of the given
    requirements states the number."""
    numbers = {
        re.sub(r"\s+", " ", number) for r in requirements for number in _WITH_UNIT.findall(r.text)
    }
    return [
        match for match in _WITH_UNIT.finditer(text) if re.sub(r"\s+", " ", match[0]) not in numbers
    ]
