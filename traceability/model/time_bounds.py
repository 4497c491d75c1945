"""Upper bounds of the execution times of the image: of each interrupt and thread, and of the
control cycle.

The bound of a function is the longest path through its instructions, with the bounds of the
functions that it calls. The time of the cycle adds each interrupt as often as it can come during
the cycle.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from traceability.model.design_model import Model
from traceability.model.image_code import PRODUCT, ImageCode, Program
from traceability.model.longest_path import Problem
from traceability.model.stack import Prover, read_declared
from traceability.reading.call_graph import short_name
from traceability.reading.loop_bounds import Bound, Bounds, Place
from traceability.reading.machine_code import VENEER, Block, Code, Instruction, Loop
from traceability.reading.results import numbers_reported
from traceability.reading.source_facts import Facts
from traceability.schema import VIRTUAL_K64, ExecutionContext, TimeBound, TimeProof
from traceability.schema import Place as SourcePlace

DECLARED_IN = Path("design/times.toml")
# Cycles of the hardware for an interrupt, including the change to a following one.
ENTRY_AND_EXIT = 12 + 10 + 6
RETRY = 12  # cycles of a loop with LDREX and STREX that an interrupt causes to repeat
CYCLE_TIMER = "cycle-timer"
MOST_ROUNDS = 100
CLOCK = 120_000  # cycles in a tick of 1 ms
# Functions that never return: a path that calls one ends the firmware and is not part of a bound.
ENDS = ("assertionFailed", "endWithFault", "endWithoutClock", "endOfProgram", "__aeabi_idiv0")
COPIES = ("memcpy", "memmove", "memset")
UNALIGNED = 2  # additional cycles of an unaligned access


@dataclass(frozen=True)
class Limit:
    """A method with a greatest number of calls below another one."""

    method: str
    within: str
    most: int


class Times:
    """The bound of each function, with all that it calls [cycle]."""

    def __init__(
        self,
        program: Program,
        bounds: Bounds,
        prover: Prover,
        once: Iterable[str] = (),  # methods that a function calls once for each object
        limited: Iterable[Limit] = (),
    ) -> None:
        self.codes, self.places, self.shared = program.codes, program.places, program.shared
        self.bounds, self.prover = bounds, prover
        self.once = frozenset(once)
        self.limited = {one.method: one for one in limited}
        self.known: dict[tuple[str, tuple[tuple[str, int], ...]], int] = {}
        # The longest path of a function, for each cost of its blocks.
        self.paths: dict[tuple[str, tuple[int, ...]], int] = {}
        self.copies: dict[tuple[str, int], int] = {}  # function and bytes -> cycles
        self.unbound: set[tuple[str, Place]] = set()  # loops without a bound: function and place
        self.unresolved: set[tuple[str, Place]] = set()  # calls without a known target

    def use_body(self, body: str) -> None:
        """The command that the next thread executes."""
        self.prover.body = body
        self.known.clear()

    def of(self, symbol: str, entered: Mapping[str, int] = MappingProxyType({})) -> int:
        symbol = self._home(symbol)
        function = self.prover.graph.get(symbol)
        method = short_name(function.name) if function else symbol
        if method in self.prover.most:
            entered = {**entered, method: entered.get(method, 0) + 1}
        key = (symbol, tuple(sorted(entered.items())))
        if key not in self.known:
            self.known[key] = 0  # a cycle of calls is a finding of the stack proof
            code = self.codes[symbol]
            single: dict[str, int] = {}  # callee -> cycles, for callees that are called once
            cost = {}
            for start, block in code.blocks.items():
                calls = (
                    self._call(symbol, block, one, entered, single) for one in block.instructions
                )
                cost[start] = block.cycles + sum(calls)
            inside = [one for one in self.limited.values() if one.within == method]
            self.known[key] = (
                self._longest(code, cost)
                + sum(single.values())
                + sum(one.most * self._each(one.method) for one in inside)
            )
        return self.known[key]

    def _each(self, method: str) -> int:
        """The cycles of a call of a method with a limited number of calls."""
        rest = {name: one for name, one in self.limited.items() if name != method}
        self.limited, kept = rest, self.limited
        found = max((self.of(one) for one in self.prover.symbols.get(method, [])), default=0)
        self.limited = kept
        return found

    def copy(self, symbol: str, count: int) -> int:
        """The bound of a function that copies or fills a number of bytes."""
        if (symbol, count) not in self.copies:
            self.copies[symbol, count] = self._copy(symbol, count)
        return self.copies[symbol, count]

    def _copy(self, symbol: str, count: int) -> int:
        code = self.codes[symbol]
        steps = {loop.head: _stored(code, loop) for loop in code.loops}
        larger = sorted({step for step in steps.values() if step > 1}, reverse=True)
        rounds = []
        for loop in code.loops:
            step = steps[loop.head]
            if step == 1:
                most = count if symbol == "memmove" else 2 * 4
            else:
                above = larger[: larger.index(step)]
                most = above[-1] // step if above else count // step
            rounds.append((loop, Bound(most, False)))
        cost = {start: block.cycles for start, block in code.blocks.items()}
        longest = Problem(code, cost, rounds, []).solve() or 0
        return longest + UNALIGNED * (count // 4 + 2)

    def _home(self, symbol: str) -> str:
        """The symbol with the code: a veneer jumps to another symbol, and equal functions share one
        symbol."""
        veneer = VENEER.match(symbol)
        name = veneer["name"] if veneer else symbol
        return self.shared.get(name, name)

    def _call(
        self,
        symbol: str,
        block: Block,
        one: Instruction,
        entered: Mapping[str, int],
        single: dict[str, int],
    ) -> int:
        if any(end in one.call for end in ENDS):
            return 0
        if one.call:
            if one.call in COPIES:
                return self.copy(one.call, self._count(symbol, block, one))
            return self._target(one.call, entered)
        if not one.indirect:
            return 0
        place = self._place(one.address)
        function = self.prover.graph[symbol]
        targets = self.prover.targets(function, SourcePlace(*place)) if place else []
        if not targets:
            self.unresolved.add((symbol, place or ("?", 0)))
        most = 0
        for target in targets:
            cycles = self._target(target, entered)
            if short_name(self.prover.graph[target].name) in self.once:
                single[target] = cycles
            else:
                most = max(most, cycles)
        return most

    def _target(self, symbol: str, entered: Mapping[str, int]) -> int:
        home = self._home(symbol)
        if home in self.prover.graph and short_name(self.prover.graph[home].name) in self.limited:
            return 0  # counted at its limit
        if home not in self.codes or self.prover.is_full(home, entered):
            return 0
        return self.of(home, entered)

    def _count(self, symbol: str, block: Block, call: Instruction) -> int:
        for one in reversed(block.instructions[: block.instructions.index(call)]):
            if one.operands.startswith("r2,"):
                number = re.match(r"r2, #(\d+)", one.operands)
                if number and one.name.startswith("mov"):
                    return int(number[1])
                break
        found = [
            bound for place in self.places.get(call.address, []) if (bound := self.bounds.at(place))
        ]
        if not found:
            self.unbound.add((symbol, self._place(call.address) or ("?", 0)))
            return 0
        return found[0].rounds

    def _longest(self, code: Code, cost: Mapping[int, int]) -> int:
        key = (code.symbol, tuple(cost.values()))
        if key not in self.paths:
            self.paths[key] = self._solve(code, cost)
        return self.paths[key]

    def _solve(self, code: Code, cost: Mapping[int, int]) -> int:
        rounds = [(loop, self._bound(code, loop)) for loop in code.loops]
        counted = []
        for start, block in code.blocks.items():
            if any(any(end in one.call for end in ENDS) for one in block.instructions):
                counted.append((start, 0))
                continue
            lines = {
                place[0] for one in block.instructions if (place := self.places.get(one.address))
            }
            counted += [
                (start, most) for one in lines if (most := self.bounds.passes(one)) is not None
            ]
        longest = Problem(code, cost, rounds, counted).solve()
        if longest is None or code.hidden:
            self.unbound.add((code.symbol, self._place(next(iter(code.blocks))) or ("?", 0)))
        return longest or 0

    def _bound(self, code: Code, loop: Loop) -> Bound:
        """The bound of a loop: the bound of the innermost line with a bound, or a bound for all
        rounds."""
        instructions = [one for start in loop.blocks for one in code.blocks[start].instructions]
        if any(one.name.startswith("strex") for one in instructions):
            return Bound(1, False)  # repeated only after an interrupt, whose bound includes it
        ways = [
            self.places.get(code.blocks[start].instructions[-1].address, []) for start in loop.back
        ]
        ways.append(self.places.get(loop.head, []))
        found = [bound for way in ways for place in way[:1] if (bound := self.bounds.at(place))]
        outer = [
            bound
            for way in ways
            for place in way[1:]
            if (bound := self.bounds.at(place)) and bound.in_all
        ]
        if found or outer:
            return min(outer, key=lambda one: one.rounds) if outer else found[0]
        inner = set().union(*(one.blocks for one in code.loops if one.blocks < loop.blocks))
        ways = [
            self.places.get(one.address, [])
            for start in loop.blocks - inner
            for one in code.blocks[start].instructions
        ]
        found = [bound for way in ways for place in way[:1] if (bound := self.bounds.at(place))]
        if not found:
            self.unbound.add((code.symbol, next((way[0] for way in ways if way), ("?", 0))))
            return Bound(0, False)
        return found[0]

    def _place(self, address: int) -> Place | None:
        found = self.places.get(address)
        return found[0] if found else None


def _stored(code: Code, loop: Loop) -> int:
    """The bytes that a round of a loop stores."""
    return sum(
        1 if one.name.startswith("strb") else 4
        for start in loop.blocks
        for one in code.blocks[start].instructions
        if one.name.startswith("str")
    )


# ---- the control cycle --------------------------------------------------------


def prove_times(
    root: Path, model: Model, facts: Facts, image: ImageCode | None
) -> TimeProof | None:
    """The bounds of the image of the robot; nothing when it was not built from these sources."""
    if image is None or not (root / DECLARED_IN).exists():
        return None
    declared = tomllib.loads((root / DECLARED_IN).read_text(encoding="utf-8"))
    prover = Prover(image.graph, facts, model, read_declared(root))
    values = {name: one.number for name, one in model.constants.items()} | declared["values"]
    once = [name for entry in declared["once"] for name in entry["methods"]]
    bounds = Bounds(root, values)
    limits = [
        Limit(one["method"], one["within"], bounds.value(one["most"]))
        for one in declared["limited"]
    ]
    times = Times(image.program, bounds, prover, once, limits)
    arrivals = {entry["context"]: entry for entry in declared["arrival"]}
    contexts = [
        one
        for context in model.contexts.values()
        if context.kind != "start" and (one := _of_context(context, times, arrivals))
    ]
    return TimeProof(
        contexts=contexts,
        cycle_ms=_response(contexts) / CLOCK,
        seen_ms=_seen(root, model),
        unbound=sorted((name, SourcePlace(*place)) for name, place in times.unbound),
        unresolved=sorted((name, SourcePlace(*place)) for name, place in times.unresolved),
    )


def _of_context(
    context: ExecutionContext, times: Times, arrivals: Mapping[str, Mapping[str, Any]]
) -> TimeBound | None:
    """The sum over the handlers of a thread, which all run in a cycle; else the longest handler."""
    arrival = arrivals.get(context.id)
    if arrival and not arrival["entries"]:
        return None  # the handler ends the firmware
    times.use_body(context.body)
    held = [handler for handler in context.handlers if handler in times.codes]
    found = [times.of(handler) + ENTRY_AND_EXIT for handler in held]
    if not found:
        return None
    if context.kind == "interrupt" and context.id not in (*arrivals, CYCLE_TIMER):
        times.unbound.add((context.name, (str(DECLARED_IN), 1)))
    return TimeBound(
        context=context.id,
        name=context.name,
        cycles=sum(found) if context.kind == "thread" else max(found),
        entries=arrival["entries"] if arrival else None,
        ticks=arrival.get("ticks", 1) if arrival else 1,
        why=arrival["why"] if arrival else "once in a control cycle",
    )


def _response(contexts: Iterable[TimeBound]) -> float:
    """Cycles from the clock pulse to the end of the main thread, with all interrupts in this
    time."""
    known = list(contexts)
    own = sum(one.cycles for one in known if one.entries is None)
    found = own
    for _ in range(MOST_ROUNDS):
        now = own
        for one in known:
            if one.entries is not None:  # a tick may have begun just before
                ticks = -(-found // (CLOCK * one.ticks)) + 1
                now += ticks * one.entries * (one.cycles + RETRY)
        if now == found:
            return found
        found = now
    return float("inf")


def _seen(root: Path, model: Model) -> float | None:
    """The longest time to the report, in the runs of the bench and in tests of the image [ms]."""
    runs = [run for scenario in (model.bench or {}).values() for run in scenario.runs.values()]
    found = [run.report_ms.maximum for run in runs]
    if not model.stale_on(VIRTUAL_K64):
        reported = numbers_reported(root, VIRTUAL_K64, "longest_cycle", PRODUCT)
        found += [cycles / CLOCK for cycles in reported]
    return round(max(found), 3) if found else None
