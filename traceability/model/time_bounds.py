"""Upper bounds of the execution times of the functions of the firmware image.

The bound of a function is the cost of the longest path through its instructions. The cost includes
the bounds of the functions that it calls."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, product
from types import MappingProxyType

from traceability.model.image_code import Program
from traceability.model.longest_path import Problem
from traceability.model.stack import Prover
from traceability.reading.call_graph import Function, short_name
from traceability.reading.loop_bounds import ENTRIES, Bound, Bounds, Inequality, Place
from traceability.reading.machine_code import VENEER, Block, Code, Instruction, Loop
from traceability.schema import Place as SourcePlace

# Functions that never return. A call of these functions ends the firmware. The bounds include no
# path with such a call.
ENDS = ("assertionFailed", "endWithFault", "endWithoutClock", "endOfProgram", "__aeabi_idiv0")
COPIES = ("memcpy", "memmove", "memset")
UNALIGNED = 2  # additional cycles of an unaligned access


@dataclass(frozen=True)
class Limit:
    """A limit for the number of calls of ``method`` during one call of ``within``. In the declared
    facts about ``within``, this number has the name ``counter`` and is limited."""

    method: str
    within: str
    counter: str


@dataclass(frozen=True)
class Spread:
    """A limit for the iterations of the loop in ``method``. It applies to one call of ``within``:
    all calls of ``method`` during this call together have at most this number of iterations.

    If ``counter`` is empty, the limit is the number ``rounds``. Otherwise, ``counter`` is the name
    of the sum, and the declared facts about ``within`` limit this sum."""

    method: str
    within: str
    rounds: int = 0
    counter: str = ""


@dataclass(frozen=True)
class DeclaredFacts:
    """The declared facts about the paths through the code."""

    # methods that a loop over several objects calls at most once for each object
    once: Sequence[str] = ()
    limited: Sequence[Limit] = ()
    spread: Sequence[Spread] = ()
    # method or handler -> facts about it
    flows: Mapping[str, Sequence[Inequality]] = field(default_factory=dict)


class Times:
    """The computation of the bound of each function [cycle]. A bound includes the functions that
    the function calls."""

    def __init__(
        self, program: Program, bounds: Bounds, prover: Prover, facts: DeclaredFacts
    ) -> None:
        self.codes, self.places, self.shared = program.codes, program.places, program.shared
        self.bounds, self.prover = bounds, prover
        self.once = frozenset(facts.once)
        self.limited = {one.method: one for one in facts.limited}
        self.spread = {(one.within, one.method): one for one in facts.spread}
        # the methods ``Spread.within`` that are on the present path of calls
        self.inside: frozenset[str] = frozenset()
        self.without: frozenset[str] = frozenset()  # methods that this activation does not call
        self.flows = facts.flows
        # assumed number of iterations of the loops of a method in ``spread``
        self.rounds: int | None = None
        self.known: dict[tuple[object, ...], int] = {}
        # The cached costs of the longest paths. The key contains the function, the costs of its
        # blocks, and the costs of its counted calls.
        self.paths: dict[tuple[object, ...], int] = {}
        self.copies: dict[tuple[str, int], int] = {}  # function and bytes -> cycles
        self.unbound: set[tuple[str, Place]] = set()  # loops without a bound: function and place
        self.unresolved: set[tuple[str, Place]] = set()  # calls without a known target

    def use_body(self, body: str, without: Iterable[str] = ()) -> None:
        """Sets the thread for the next computations: its command, and the methods that it does not
        call."""
        self.prover.body = body
        self.without = frozenset(without)
        self.known.clear()

    def of(self, symbol: str, entered: Mapping[str, int] = MappingProxyType({})) -> int:
        symbol = self._home(symbol)
        function = self.prover.graph.get(symbol)
        method = short_name(function.name) if function else symbol
        if method in self.prover.most:
            entered = {**entered, method: entered.get(method, 0) + 1}
        outside = self.inside
        self.inside |= {within for within, _ in self.spread if within == method}
        key = (symbol, tuple(sorted(entered.items())), self.inside)
        if key not in self.known:
            # The value 0 is used if the function calls itself. The proof of the stack reports such
            # a recursion.
            self.known[key] = 0
            code = self.codes[symbol]
            single: dict[str, int] = {}  # callee -> cycles, for callees that are called once
            cost = {}
            for start, block in code.blocks.items():
                calls = (
                    self._call(symbol, block, one, entered, single) for one in block.instructions
                )
                cost[start] = block.cycles + sum(calls)
            inside = [one for one in self.limited.values() if one.within == method]
            apart = {one.counter: self._each(one.method) for one in inside}
            spread = [one for one in self.spread.values() if one.within == method]
            apart |= {one.counter: self._round(one)[1] for one in spread if one.counter}
            self.known[key] = (
                self._longest(code, cost, method, apart)
                + sum(single.values())
                + sum(one.rounds * self._round(one)[1] for one in spread if not one.counter)
            )
        self.inside = outside
        return self.known[key]

    def _round(self, spread: Spread) -> tuple[int, int]:
        """Returns two numbers A and B. A call with N iterations needs at most A + N * B cycles.

        The maximum cost of a call is a concave function of its number of iterations, because this
        cost is the optimum of a linear program. The straight line through the costs of one and of
        two iterations is therefore an upper bound."""
        costs = []
        for rounds in (1, 2):
            self.rounds = rounds
            cost = 0
            for symbol in self.prover.symbols.get(spread.method, []):
                self.known.pop((symbol, (), self.inside), None)
                cost = max(cost, self.of(symbol))
                self.known.pop((symbol, (), self.inside), None)
            costs.append(cost)
        self.rounds = None
        return 2 * costs[0] - costs[1], costs[1] - costs[0]

    def _each(self, method: str) -> int:
        """Returns the bound of one call of a method whose number of calls is limited."""
        rest = {name: one for name, one in self.limited.items() if name != method}
        self.limited, kept = rest, self.limited
        found = max((self.of(one) for one in self.prover.symbols.get(method, [])), default=0)
        self.limited = kept
        return found

    def copy(self, symbol: str, count: int) -> int:
        """Returns the bound of ``memcpy``, ``memmove`` or ``memset`` for a number of bytes."""
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
        """Returns the symbol that contains the code of a function. A veneer only jumps to another
        symbol, and functions with equal code share a symbol."""
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
        targets = self._targets(function, one) if place else []
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

    def _targets(self, function: Function, call: Instruction) -> list[str]:
        way = self.places[call.address]
        return self.prover.targets(function, SourcePlace(*way[0]), way)

    def _never(self, code: Code, block: Block) -> bool:
        """Returns true if a block contains a virtual call that is never executed, because the
        compiler has inlined the called method at the same place.

        The compiled code compares the target of the call with the method that the compiler expects.
        If both are equal, the inlined code is executed. Otherwise, the call is executed. If no
        other method is possible, the call is never executed."""
        function = self.prover.graph.get(code.symbol)
        for one in block.instructions:
            place = self._place(one.address)
            if not one.indirect or not place or not function:
                continue
            virtual = [call for _, call in self.prover.written.get(place, []) if call.virtual]
            targets = self._targets(function, one)
            way = self.places.get(one.address, [])
            if (
                len(virtual) == 1
                and targets
                and all(self._is_inlined(code, target, way) for target in targets)
            ):
                return True
        return False

    def _is_inlined(self, code: Code, target: str, way: Sequence[Place]) -> bool:
        """Returns true if a function contains the inlined code of another function at a call.
        ``way`` begins with the place of this call. The next places are those of the inlined calls
        that contain this call."""
        other = self.codes.get(self._home(target))
        if other is None or other is code:
            return False
        own = {
            around[-1] for one in other.instructions() if (around := self.places.get(one.address))
        }
        return any(
            len(around) > len(way)
            and list(around[-len(way) :]) == list(way)
            and around[-len(way) - 1] in own
            for one in code.instructions()
            if (around := self.places.get(one.address))
        )

    def _target(self, symbol: str, entered: Mapping[str, int]) -> int:
        home = self._home(symbol)
        function = self.prover.graph.get(home)
        name = short_name(function.name) if function else ""
        # The bound of ``Limit.within`` includes the calls of the methods in ``limited``.
        if name in self.limited or name in self.without or home not in self.codes:
            return 0
        if self.prover.is_full(home, entered):
            return 0
        for within in self.inside:
            if (within, name) in self.spread:
                # The bound of ``Spread.within`` includes the iterations.
                return self._round(self.spread[within, name])[0]
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

    def _longest(
        self, code: Code, cost: Mapping[int, int], method: str, apart: Mapping[str, int]
    ) -> int:
        key = (code.symbol, tuple(cost.values()), tuple(apart.items()), self.rounds)
        if key not in self.paths:
            self.paths[key] = self._solve(code, cost, method, apart)
        return self.paths[key]

    def _solve(
        self, code: Code, cost: Mapping[int, int], method: str, apart: Mapping[str, int]
    ) -> int:
        rounds = [(loop, self._bound(code, loop, method)) for loop in code.loops]
        counted = []
        for start, block in code.blocks.items():
            ends = any(any(end in one.call for end in ENDS) for one in block.instructions)
            if ends or self._never(code, block):
                counted.append((start, 0))
                continue
            lines = {
                place[0] for one in block.instructions if (place := self.places.get(one.address))
            }
            counted += [
                (start, most) for one in lines if (most := self.bounds.passes(one)) is not None
            ]
        facts = self._facts(code, method, apart)
        longest = Problem(code, cost, rounds, counted, facts, apart).solve()
        if longest is None or code.hidden:
            self._note_unbound(code)
        return longest or 0

    def _note_unbound(self, code: Code) -> None:
        self.unbound.add((code.symbol, self._place(next(iter(code.blocks))) or ("?", 0)))

    def _facts(self, code: Code, method: str, apart: Iterable[str]) -> list[Inequality]:
        """Converts the declared facts about the marked source lines of a function to facts about
        the blocks of the function."""
        marked: dict[int | str, list[list[int | str]]] = {one: [[one]] for one in apart}
        for name, copies in self._marked(code).items():
            marked.setdefault(name, []).extend([*copy] for copy in copies)
        declared = self.flows.get(method, ())
        return [fact for one in declared for fact in self._facts_of(code, one, marked)]

    def _facts_of(
        self, code: Code, one: Inequality, marked: Mapping[int | str, Sequence[Sequence[int | str]]]
    ) -> Iterator[Inequality]:
        """Converts a declared fact to facts about blocks. A marked source line can have several
        copies in the compiled code, and each copy consists of blocks.

        A counter on the left side becomes the sum of one block of each copy, because no block is
        executed more often than its source line. The result contains a fact for each choice of
        these blocks. A counter on the right side becomes the sum of all blocks."""
        most = one.most - one.factors.get(ENTRIES, 0)
        right: dict[int | str, int] = {}
        left: list[list[tuple[int | str, int]]] = []
        for name, factor in one.factors.items():
            copies = marked.get(name, [])
            if factor > 0:
                left += [[(start, factor) for start in copy] for copy in copies]
            elif name != ENTRIES:
                if not copies:  # The marked source line is not in the compiled code.
                    self._note_unbound(code)
                for start in chain.from_iterable(copies):
                    right[start] = right.get(start, 0) + factor
        for choice in product(*left):
            factors = dict(right)
            for start, factor in choice:
                factors[start] = factors.get(start, 0) + factor
            yield Inequality(factors, most)

    def _marked(self, code: Code) -> dict[str, list[list[int | str]]]:
        """Returns a map from each counter to the copies of its source line in the compiled code.
        Each copy is a list of blocks. Each inlined call of a function has its own copies of the
        function's source lines.

        If a source line consists only of inlined calls, its copy contains the blocks of these
        calls."""
        found: dict[str, dict[tuple[Place, ...], dict[int, list[int]]]] = {}
        for start, block in code.blocks.items():
            for one in block.instructions:
                way = self.places.get(one.address, [])
                for depth, line in enumerate(way):
                    if name := self.bounds.counter(line):
                        copy = found.setdefault(name, {}).setdefault(tuple(way[depth:]), {})
                        copy.setdefault(depth, []).append(start)
        return {
            name: [list(dict.fromkeys(copy[min(copy)])) for copy in copies.values()]
            for name, copies in found.items()
        }

    def _bound(self, code: Code, loop: Loop, method: str) -> Bound:
        """Returns the bound of a loop. If the loop is in an inlined function, the comment at the
        inlined call can declare a bound that ends with ``in all``. This bound has priority over the
        bound in the comment at the loop."""
        if self.rounds is not None and any(method == name for _, name in self.spread):
            return Bound(self.rounds, False)
        instructions = [one for start in loop.blocks for one in code.blocks[start].instructions]
        if any(one.name.startswith("strex") for one in instructions):
            # The loop repeats only after an interrupt. The time of the interrupt includes the
            # repetition.
            return Bound(1, False)
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
    """Returns the number of bytes that an iteration of a loop stores."""
    return sum(
        1 if one.name.startswith("strb") else 4
        for start in loop.blocks
        for one in code.blocks[start].instructions
        if one.name.startswith("str")
    )
