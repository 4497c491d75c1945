"""The largest stack use of the firmware image. It is computed from all calls that an execution
context may make.

The reports of the compiler contain the stack frames and the calls. For an indirect call, the syntax
tree shows the objects that the builders passed to the caller. The call can execute the methods of
these objects.

A chain of calls through decorators contains each Concrete Decorator of the pattern at most once. No
other method occurs twice in a chain of calls."""

from __future__ import annotations

import fnmatch
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.grouping import grouped
from traceability.model.design_model import Model
from traceability.model.execution import DISPATCH
from traceability.model.image_code import ImageCode
from traceability.reading.ast_facts import CallFact
from traceability.reading.call_graph import (
    Function,
    short_name,
    symbol_value,
    uses_floats,
)
from traceability.reading.graphs import reached_from
from traceability.reading.source_facts import Facts, References
from traceability.schema import Place, StackCall, StackContext, StackProof

DECLARED = Path("design/stack.toml")
RUN_OF_THREAD = "ControlThread::run"
# ARMv7-M ARM, B1.5.6: the frame that the hardware stores when it starts a handler, and one word for
# the alignment of the frame.
FRAME = 32 + 4
FRAME_WITH_FLOATS = 104 + 4


@dataclass
class Declared:
    faults: list[str] = field(default_factory=list)
    # Function with a call through a pointer -> pattern of the symbols that it may call, with ``*``.
    calls: dict[str, str] = field(default_factory=dict)
    # Class -> number of its objects in a chain, including the objects of its subclasses. In a
    # chain, each object wraps the next object.
    entries: dict[str, int] = field(default_factory=dict)
    # Class of an object in a chain -> the classes of all later objects in the chain.
    inner: dict[str, frozenset[str]] = field(default_factory=dict)


def read_declared(root: Path, facts: Facts) -> Declared:
    file = root / DECLARED
    if not file.exists():
        return Declared()
    data = tomllib.loads(file.read_text(encoding="utf-8"))
    inner: dict[str, frozenset[str]] = {}
    for chain in data.get("chain", []):
        inner |= later_classes(facts.robot, chain["name"], chain["last"])
    return Declared(
        faults=data.get("faults", []),
        calls={entry["from"]: entry["to"] for entry in data.get("call", [])},
        entries=objects_in_chains(set(inner), facts),
        inner=inner,
    )


def objects_in_chains(classes: set[str], facts: Facts) -> dict[str, int]:
    """Returns a map from each class to the greatest number of its objects in a chain, including the
    objects of its subclasses. The classes are those of the chains, and their base classes. A chain
    contains at most one object of each class. A base class with a subclass outside the chains is
    left out."""
    objects = dict.fromkeys(classes, 1)
    for base, subclasses in facts.subclasses.items():
        concrete = [name for name in subclasses if not facts.classes[name].abstract]
        if base not in classes and concrete and classes.issuperset(concrete):
            objects[base] = len(concrete)
    return objects


def later_classes(robot: References, first: str, last: str) -> dict[str, frozenset[str]]:
    """Returns a map from each class of a chain to the classes of all later objects in the chain. In
    a chain, the constructor of each object gets the next object. Returns no class if ``first`` does
    not lead to ``last``."""
    classes = reached_from([first], robot.arguments)
    later = {name: reached_from(robot.arguments(name), robot.arguments) for name in classes}
    chain = {name for name in classes if name == last or last in later[name]}
    return {name: frozenset(chain.intersection(later[name])) for name in chain if last in classes}


def prove(root: Path, model: Model, facts: Facts, image: ImageCode | None) -> StackProof | None:
    """Returns the proof of the stack size for the firmware image of the robot. Returns None if no
    firmware image was built from the present sources."""
    if image is None or not model.contexts:
        return None
    frame = FRAME_WITH_FLOATS if uses_floats(image.elf) else FRAME
    proof = Prover(image.graph, facts, model, read_declared(root, facts)).prove(frame)
    runs = [run for scenario in model.closed_loop or [] for run in scenario.runs.values()]
    seen = max((run.stack for run in runs if run.stack is not None), default=None)
    return replace(proof, limit=symbol_value(image.elf, "stackSize"), seen=seen)


def most_entries(model: Model, declared: Declared) -> dict[str, int]:
    """Some classes have objects in chains. For each method of these classes, returns the greatest
    number of nested calls. The objects in an application of the Decorator pattern are a chain.
    ``design/stack.toml`` declares the other chains."""
    entries = {
        method.id: most
        for name, most in declared.entries.items()
        if name in model.modules
        for method in model.modules[name].methods
    }
    for application in model.patterns.values():
        if application.pattern != "Decorator":
            continue
        concrete = [r.module for r in application.roles if r.role == "Concrete Decorator"]
        for role in application.roles:
            if role.role in ("Decorator", "Concrete Decorator") and role.module in model.modules:
                most = len(concrete) if role.role == "Decorator" else 1
                entries |= {method.id: most for method in model.modules[role.module].methods}
    return entries


def _class_of(method: str) -> str:
    return method.rpartition("::")[0]


class Prover:
    def __init__(
        self, graph: dict[str, Function], facts: Facts, model: Model, declared: Declared
    ) -> None:
        self.graph = graph
        self.facts = facts
        self.model = model
        self.declared = declared
        # short name -> symbols
        self.symbols = grouped(graph, lambda symbol: short_name(graph[symbol].name))
        self.written: dict[tuple[str, int], list[tuple[str, CallFact]]] = {}
        for body in facts.syntax.bodies:
            for call in body.calls:
                key = (call.place.file, call.place.line)
                self.written.setdefault(key, []).append((body.id, call))
        self.most = most_entries(model, declared)
        self.contexts: list[StackContext] = []
        self.unresolved: list[tuple[str, Place]] = []
        self.cycles: list[list[str]] = []
        self.untold: list[str] = []
        self.body = ""  # the command that the present thread executes

    def prove(self, frame: int) -> StackProof:
        for context in self.model.contexts.values():
            self.body = context.body
            roots = [s for handler in context.handlers for s in self.symbols.get(handler, [])]
            deepest = [self.deepest(symbol) for symbol in roots]
            if deepest:
                worst = max(deepest, key=lambda chain: sum(call.bytes for call in chain))
                self._add(context.id, context.name, context.kind, context.priority, worst)
        self.body = ""
        for handler in self.declared.faults:
            for symbol in self.symbols.get(handler, []):
                self._add("faults", "faults", "fault", -1, self.deepest(symbol))
        return StackProof(
            exception_frame=frame,
            contexts=self.contexts,
            unresolved=self.unresolved,
            cycles=self.cycles,
            dynamic=sorted(function.name for function in self.graph.values() if function.dynamic),
            untold=self.untold,
        )

    def _add(
        self, context: str, name: str, kind: str, priority: int | None, chain: list[StackCall]
    ) -> None:
        depth = sum(call.bytes for call in chain)
        self.contexts.append(StackContext(context, name, kind, priority, depth, chain))

    # ---- the deepest chain of calls -------------------------------------------------

    def deepest(self, symbol: str) -> list[StackCall]:
        cache: dict[tuple[str, tuple[tuple[str, int], ...]], list[StackCall]] = {}
        return self._below(symbol, {}, [], cache)

    def _below(
        self,
        symbol: str,
        entered: dict[str, int],
        path: list[str],
        cache: dict[tuple[str, tuple[tuple[str, int], ...]], list[StackCall]],
    ) -> list[StackCall]:
        function = self.graph[symbol]
        if function.measured and function.blind and function.name.startswith("wr::"):
            self.untold += {function.name}.difference(self.untold)
        method = short_name(function.name)
        if method in self.most:
            entered = {**entered, method: entered.get(method, 0) + 1}
        key = (symbol, tuple(sorted(entered.items())))
        if key in cache:
            return cache[key]
        worst: list[StackCall] = []
        for target in self._callees(function):
            if self.is_full(target, entered):
                continue
            way = [*path, symbol]
            if target in way and not self._in_chain(way, target):
                self._note_cycle(way, target)
                continue
            below = self._below(target, entered, way, cache)
            if sum(call.bytes for call in below) > sum(call.bytes for call in worst):
                worst = below
        cache[key] = [StackCall(method, function.frame, function.measured), *worst]
        return cache[key]

    def is_full(self, symbol: str, entered: Mapping[str, int]) -> bool:
        """Returns true if a further nested call of a method is impossible. This is true in two
        cases: all objects with this method in the chain already execute the method, or a later
        object of the chain already executes one of its methods."""
        method = short_name(self.graph[symbol].name)
        if method not in self.most:
            return False
        inner = self.declared.inner.get(_class_of(method), frozenset())
        return entered.get(method, 0) >= self.most[method] or any(
            _class_of(other) in inner for other in entered
        )

    def _in_chain(self, path: list[str], target: str) -> bool:
        cycle = path[path.index(target) :]
        return any(short_name(self.graph[symbol].name) in self.most for symbol in cycle)

    def _note_cycle(self, path: list[str], target: str) -> None:
        cycle = [short_name(self.graph[symbol].name) for symbol in path[path.index(target) :]]
        if not any(set(cycle) == set(other) for other in self.cycles):
            self.cycles.append(cycle)

    # ---- calls of a function ---------------------------------------------------------

    def _callees(self, function: Function) -> list[str]:
        callees = dict.fromkeys(symbol for symbol in function.calls if symbol in self.graph)
        for place in function.indirect:
            callees |= dict.fromkeys(self.targets(function, place))
        return list(callees)

    def targets(
        self, function: Function, place: Place, way: Sequence[tuple[str, int]] = ()
    ) -> list[str]:
        """Returns the functions that an indirect call may execute. ``way`` begins with the place of
        this call. The next places are those of the inlined calls that contain this call."""
        pattern = self.declared.calls.get(short_name(function.name))
        if pattern is not None:
            return [symbol for symbol in self.graph if fnmatch.fnmatch(symbol, pattern)]
        targets: list[str] = []
        for body, call in self.written.get((place.file, place.line), []):
            if call.virtual:
                narrowed = self.body and body == RUN_OF_THREAD and call.target == DISPATCH
                targets += [self.body] if narrowed else self._methods(body, call, way)
        symbols = [symbol for target in targets for symbol in self.symbols.get(target, [])]
        if not symbols and not any(other == place for _, other in self.unresolved):
            self.unresolved.append((short_name(function.name), place))
        return symbols

    def _methods(self, body: str, call: CallFact, way: Sequence[tuple[str, int]]) -> list[str]:
        """Returns the methods that a virtual call in a body may execute, for all classes that the
        object of the body may have."""
        robot = self.facts.robot
        kind = self._kind_of(body, way)
        kinds = robot.constructed & {kind, *self.facts.subclasses.get(kind, [])}
        if not kinds:
            return robot.targets(call)
        methods = (method for one in sorted(kinds) for method in robot.own_targets(call, one))
        return list(dict.fromkeys(methods))

    def _kind_of(self, body: str, way: Sequence[tuple[str, int]]) -> str:
        """Returns the class of the object on which the method ``body`` runs. A method of a subclass
        can call ``body`` for its own object. If ``body`` is inlined in such a method, returns the
        subclass."""
        kind = _class_of(body)
        for place in way[1:]:
            callers = {
                caller
                for caller, call in self.written.get(place, [])
                if call.target == body and not call.virtual and not call.on
            }
            body = callers.pop() if len(callers) == 1 else ""
            if kind not in (_class_of(body), *self.facts.bases_of(_class_of(body))):
                break
            kind = _class_of(body)
        return kind
