"""The state machines, with the changes of state that the code can make and the changes of state
that the tests made.

The files in ``design/fsm`` declare the machines. The states of a machine are the Concrete States in
an application of the State pattern. This module finds the changes of state in the methods of the
state classes and in the recorded calls of the tests."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.ast_facts import ANY_CLASS, CallFact
from traceability.reading.result_cache import cached_result, code_of
from traceability.reading.source_facts import Facts
from traceability.reading.traces import Traces
from traceability.schema import HOST, Place, StateMachine, Transition


@dataclass
class Change:
    """A change of state that an operation of a state can make."""

    source: str  # name of the state
    operation: str
    target: str  # "" if the new state is not known from the code
    place: Place
    # the methods through which the operation reaches the change, in the order of the calls
    path: tuple[str, ...]
    sometimes: bool
    asked: list[str] = field(default_factory=list)  # operands of the conditions before the change


@dataclass
class MachineCode:
    """The facts about a state machine that are read from the code."""

    # Context -> method of the Context that changes the state
    holders: dict[str, str] = field(default_factory=dict)
    # Operations that the Context may call on a state.
    operations: list[str] = field(default_factory=list)
    runs: dict[str, dict[str, str]] = field(default_factory=dict)  # state -> operation -> method
    changes: list[Change] = field(default_factory=list)
    initial: set[str] = field(default_factory=set)
    storage: str = ""  # class with an object of each state

    def of(self, source: str, operation: str) -> list[Change]:
        return [c for c in self.changes if (c.source, c.operation) == (source, operation)]

    def stays(self, source: str, operation: str) -> bool:
        """Returns whether an operation can end without a change of the state."""
        return all(change.sometimes for change in self.of(source, operation))


def is_stay(step: Transition) -> bool:
    return step.source == step.target


def read_machine(machine: StateMachine, facts: Facts) -> MachineCode:
    code = MachineCode()
    roles = _roles(machine, facts)
    base = next(iter(roles.get("State", [])), "")
    if base not in facts.classes:
        return code
    code.holders = _holders(base, roles.get("Context", []), facts)
    code.operations = _operations(base, facts)
    code.storage = _storage(machine, facts)
    for state, module in machine.states.items():
        methods = {name: facts.method(module, name) for name in code.operations}
        code.runs[state] = {name: method.id for name, method in methods.items() if method}
    reader = _Changes(machine, base, code, facts)
    for state in machine.states:
        for operation in code.operations:
            code.changes += reader.of(state, operation)
    code.initial = reader.initial()
    return code


def _holders(base: str, contexts: list[str], facts: Facts) -> dict[str, str]:
    """Returns a map from each Context to its method that changes the present state. This method
    assigns a member that refers to a State. A Context without such a method is left out."""
    holders: dict[str, str] = {}
    for context in contexts:
        fields = {
            f"{context}::{member.name}"
            for member in (facts.classes[context].fields if context in facts.classes else [])
            if member.refers and member.classes == [base]
        }
        for body in facts.syntax.bodies:
            constructor = body.id == f"{body.owner}::{body.owner}"
            if not constructor and any(name in fields for name, _ in body.assigns):
                holders.setdefault(context, body.id)
    return holders


def _operations(base: str, facts: Facts) -> list[str]:
    """Returns the virtual operations of the State class."""
    return [m.name for m in facts.classes[base].methods if m.virtual and "~" not in m.name]


def _storage(machine: StateMachine, facts: Facts) -> str:
    """Returns the class in ``src`` that has an object of each state as a member. Returns an empty
    text if there is no such class."""
    for fact in facts.classes.values():
        kinds = {kind for member in fact.fields if not member.refers for kind in member.classes}
        if set(machine.states.values()) <= kinds and fact.place.file.startswith("src/"):
            return fact.name
    return ""


class _Changes:
    """The search in the code for the changes of state that the operations of a state can make."""

    def __init__(self, machine: StateMachine, base: str, code: MachineCode, facts: Facts) -> None:
        self.base = base
        self.code = code
        self.facts = facts
        self.references = facts.references
        self.names = {module: state for state, module in machine.states.items()}
        self.states = machine.states
        self.family = {base, *facts.subclasses.get(base, [])}
        methods = set(code.holders.values())
        # If a call is in a template, the class of the called method can be unknown. The fact about
        # the call then contains ANY_CLASS instead of this class.
        self.changers = methods | {
            f"{ANY_CLASS}::{method.rpartition('::')[2]}" for method in methods
        }

    def of(self, state: str, operation: str) -> list[Change]:
        method = self.code.runs[state].get(operation)
        if method is None:
            return []
        changes = self._below(method, (), {})
        return [replace(change, source=state, operation=operation) for change in changes]

    def _below(
        self, method: str, path: tuple[str, ...], given: dict[str, list[str]]
    ) -> Iterator[Change]:
        """Yields the changes of state that a method makes itself or through other methods of the
        state. In these changes, the source and the operation are empty."""
        for body in self.references.own_bodies(method):
            for call in body.calls:
                args = [
                    [p for place in arg for p in given.get(place, [place])] for arg in call.args
                ]
                if call.target in self.changers:
                    for target in self._targets(args[0] if args else []):
                        yield Change("", "", target, call.place, path, call.sometimes, call.asked)
                elif self._is_own(call, body.place.file) and call.target not in path:
                    inner = {f"param {call.target} {k}": arg for k, arg in enumerate(args)}
                    for change in self._below(call.target, (*path, call.target), inner):
                        yield replace(
                            change,
                            sometimes=change.sometimes or call.sometimes,
                            asked=call.asked + change.asked,
                        )

    def _is_own(self, call: CallFact, file: str) -> bool:
        """Returns true if a call executes a method of the state object itself, and this method
        cannot be overridden. Also returns true if the call executes a function outside classes in
        the same file."""
        beside = self.references.own_bodies(call.target)
        if beside and all(not body.owner and body.place.file == file for body in beside):
            return True
        on_itself = not call.on or all(instance.startswith("this ") for instance in call.on)
        return on_itself and not call.virtual and call.target.rpartition("::")[0] in self.family

    def _targets(self, places: list[str]) -> list[str]:
        """Returns the states to which an argument may refer, in the order in which the code names
        them. In ``wanted ? first : second``, the state for a true condition is named first."""
        states = [
            state
            for place in places
            for state in sorted(
                self.names[instance.kind]
                for instance in self.references.objects([place], self.base)
                if instance.name.startswith(f"{self.code.storage}::")
                and instance.kind in self.names
            )
        ]
        return list(dict.fromkeys(states)) or [""]

    def initial(self) -> set[str]:
        """Returns the initial states. The class with the objects of the states passes states to
        other objects. An initial state is passed to an object that is not a state."""
        members = {
            f"field {self.code.storage}::{member.name}": self.names[kind]
            for fact in [self.facts.classes.get(self.code.storage)]
            for member in (fact.fields if fact else [])
            for kind in member.classes
            if kind in self.names and not member.refers
        }
        states: set[str] = set()
        for flow in self.facts.syntax.flows:
            word, _, into = flow.into.partition(" ")
            owner = into.split(" ")[0].rpartition("::")[0]
            changer = into.split(" ")[0] in self.code.holders.values()
            to_state = owner in self.family or changer
            if word == "param" and flow.file.startswith("src/") and not to_state:
                states |= {members[source] for source in flow.sources if source in members}
        return states


# ---- changes in the tests ----------------------------------------------------


@dataclass(frozen=True)
class Seen:
    """A recorded call of an operation of a state. If the call did not change the state, ``target``
    is the same state as ``source``."""

    source: str
    operation: str
    target: str
    path: tuple[str, ...] = ()


class Watcher:
    """The search for the states of a Context in the recorded calls of a test.

    Only the calls inside a method of the Context are examined, because the Context calls only the
    present state. After a change of state, all states are possible at first. Each further call
    excludes the states that do not have the called method, until only one state is left."""

    def __init__(self, code: MachineCode, operations: set[str], family: set[str]) -> None:
        self.code = code
        self.runners: dict[str, set[str]] = {}  # method -> states that have this method
        for state, methods in code.runs.items():
            for operation in operations & set(methods):
                self.runners.setdefault(methods[operation], set()).add(state)
        every = {f"{name}::{operation}" for name in family for operation in operations}
        self.foreign = every - set(self.runners)  # methods of the states of other machines
        self.helpers = {method for change in code.changes for method in change.path}
        self.changers = set(code.holders.values())
        self.constructors = {f"{name}::{name}" for name in code.holders}

    def known(self) -> list[object]:
        """Returns the inputs that determine the result of the search. The result is cached under
        these inputs."""
        runners = [(method, sorted(states)) for method, states in sorted(self.runners.items())]
        others = (self.foreign, self.helpers, self.changers, self.constructors)
        return [runners, self.code.runs, self.code.holders, *(sorted(item) for item in others)]

    def turns(self, method: str) -> bool:
        """Returns whether the Context may have a different state after a call of the method."""
        return method in self.changers | self.constructors | self.foreign

    def concerns(self, method: str) -> bool:
        concerned = method in self.runners or method in self.foreign or method in self.helpers
        return concerned or method.rpartition("::")[0] in self.code.holders

    def watch(self, calls: Iterator[tuple[str, bool]]) -> list[Seen]:
        """Returns the changes of state that the recorded calls show. ``calls`` has a pair for each
        entry and each exit of a method. The second value of the pair is true for an entry."""
        run = _Run(self)
        for method, entered in calls:
            if entered:
                run.enter(method)
            else:
                run.leave()
        return run.found


class _Run:
    """The progress of the search in one recording."""

    def __init__(self, watcher: Watcher) -> None:
        self.watcher = watcher
        self.found: list[Seen] = []
        self.stack: list[str] = []
        self.running: int | None = None  # index in ``stack``: the operation of the present state
        self.changed: tuple[str, ...] | None = None  # methods on the path to the change
        self._forget()

    def _forget(self) -> None:
        self.present = set(self.watcher.code.runs)
        self.pending: Seen | None = None

    def enter(self, method: str) -> None:
        holders = self.watcher.code.holders
        below = any(call.rpartition("::")[0] in holders for call in self.stack)
        self.stack.append(method)
        if method in self.watcher.constructors:
            self._forget()
        elif method in self.watcher.changers:
            self._change()
        elif self.running is None and below and method in self.watcher.runners:
            self._begin(method)
        elif self.running is None and below and method in self.watcher.foreign:
            self._forget()

    def _change(self) -> None:
        if self.running is None:
            self._forget()
        else:
            between = self.stack[self.running + 1 : -1]
            self.changed = tuple(method for method in between if method in self.watcher.helpers)

    def _begin(self, method: str) -> None:
        """Records that an operation of the present state begins. Excludes all states that do not
        have this operation."""
        states = self.watcher.runners[method]
        if not self.present & states:
            self._forget()
        self.present &= states
        if self.pending and len(self.present) == 1:
            self.found.append(replace(self.pending, target=next(iter(self.present))))
            self.pending = None
        self.running = len(self.stack) - 1

    def leave(self) -> None:
        method = self.stack.pop() if self.stack else ""
        if len(self.stack) != self.running:
            return
        operation = method.rpartition("::")[2]
        source = next(iter(self.present)) if len(self.present) == 1 else ""
        if self.changed is not None:
            self._forget()
            self.pending = Seen(source, operation, "", self.changed) if source else None
        elif source:
            self.found.append(Seen(source, operation, source))
        self.running, self.changed = None, None


def machines_of(
    model: Model, facts: Facts, recordings: dict[str, Traces], cache: Path
) -> dict[str, StateMachine]:
    """Returns the state machines. Each transition contains its places in the code, and the passing
    tests that executed it."""
    machines: dict[str, StateMachine] = {}
    passing = model.passing(model.tests, HOST).items()
    for name, machine in facts.declared.machines.items():
        code = read_machine(machine, facts)
        watcher = Watcher(code, set(machine.events.values()), _family(machine, facts))
        seen = watch_all(watcher, recordings[HOST], cache / f"{name}.pickle")
        shown = [(test, change) for file, test in passing for change in seen.get(file, [])]
        machines[name] = _shown(machine, code, shown)
    return machines


def matching(machine: StateMachine, step: Transition, code: MachineCode) -> list[Change]:
    """Returns the changes in the code that belong to a transition.

    Several transitions may have the same source, event and target. If the code has the same number
    of such changes, the first transition gets the first change, the second transition gets the
    second change, and so on. Otherwise, each of these transitions gets all these changes."""
    operation = machine.events.get(step.event, "")
    changes = [c for c in code.of(step.source, operation) if c.target == step.target]
    ends = (step.source, step.event, step.target)
    rows = [row for row in machine.transitions if (row.source, row.event, row.target) == ends]
    if len(rows) == len(changes):
        return [changes[next(i for i, row in enumerate(rows) if row is step)]]
    return changes


def watch_all(watcher: Watcher, traces: Traces, cache: Path) -> dict[str, list[Seen]]:
    """Returns a map from each recording to the changes of state that the recording shows."""
    names = {a: m for a, m in traces.symbols.items() if watcher.concerns(m)}
    runners = traces.addresses(watcher.runners.keys())
    turning = {a for a, m in names.items() if watcher.turns(m)}

    def watch() -> dict[str, list[Seen]]:
        return {
            recording: list(dict.fromkeys(watcher.watch(traces.calls(recording, names, turning))))
            for recording in sorted(traces.tests)
            if not runners.isdisjoint(traces.events(recording))
        }

    code = code_of("model/state_machines", "reading/traces")
    parts = [traces.state, names, sorted(turning), watcher.known(), *code]
    return cached_result(cache, parts, watch)


def _roles(machine: StateMachine, facts: Facts) -> dict[str, list[str]]:
    """Returns the modules with each role in the application of the State pattern."""
    declared = facts.declared.applications.get(machine.application)
    return declared.roles if declared else {}


def _family(machine: StateMachine, facts: Facts) -> set[str]:
    bases = _roles(machine, facts).get("State", [])
    return {module for base in bases for module in (base, *facts.subclasses.get(base, []))}


def _shown(machine: StateMachine, code: MachineCode, seen: list[tuple[str, Seen]]) -> StateMachine:
    """Returns the machine. Each transition contains its places in the code and the tests that
    executed it. The changes of state without a transition are in ``undeclared``, with the tests
    that made them."""
    changes = [matching(machine, step, code) for step in machine.transitions]
    tests: list[dict[str, None]] = [{} for _ in changes]
    undeclared: dict[str, list[str]] = {}
    for test, seen_changes in seen:
        shown = False
        for step, there, makers in zip(machine.transitions, changes, tests, strict=True):
            if (step.source, step.target) != (seen_changes.source, seen_changes.target):
                continue
            if machine.events.get(step.event) != seen_changes.operation:
                continue
            if is_stay(step) or seen_changes.path in {change.path for change in there}:
                shown = True
                makers[test] = None
        if not shown and seen_changes.source != seen_changes.target:
            words = (seen_changes.source, seen_changes.operation, seen_changes.target)
            undeclared.setdefault(" ".join(words), []).append(test)
    transitions = [
        replace(step, changes=[change.place for change in there], tests=list(makers))
        for step, there, makers in zip(machine.transitions, changes, tests, strict=True)
    ]
    return replace(machine, transitions=transitions, undeclared=undeclared)
