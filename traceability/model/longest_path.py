"""The maximum cost of a path through a function, computed as a linear program (HiGHS).

A block is a sequence of instructions of which either all or none are executed. The linear program
has a variable for each transition from a block to another block. The variable is the number of
times that a path uses the transition. This method is the implicit path enumeration of Li and Malik.
The solver also permits fractions for these numbers. Therefore, the computed maximum can be too
high, but never too low."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from traceability.reading.loop_bounds import Bound, Inequality
from traceability.reading.machine_code import REFILL, Code, Loop

if TYPE_CHECKING:
    import highspy


@dataclass
class Problem:
    """The linear program for the longest path through a function."""

    code: Code
    cost: Mapping[int, int]  # address of a block -> cost of one execution
    rounds: Iterable[tuple[Loop, Bound]]  # loops with their maximum numbers of iterations
    counted: Sequence[tuple[int, int]]  # (address of a block, maximum number of its executions)
    facts: Iterable[Inequality] = field(default_factory=list)
    # name of a counter that counts executions in other functions -> cost of one execution
    apart: Mapping[str, int] = field(default_factory=dict)

    def solve(self) -> int | None:
        """Returns the maximum cost of a path through the function. Returns None if the cost has no
        upper bound, or if no path reaches an end of the function."""
        import highspy  # The import takes longer than many commands of ./wr.

        solver = highspy.Highs()  # type: ignore[no-untyped-call]  # highspy has no types
        solver.silent()
        entry = next(iter(self.code.blocks))
        ways = {(-1, entry): solver.addVariable(lb=1, ub=1)}
        ends = {}
        for block in self.code.blocks.values():
            for after in block.exits():
                ways.setdefault((block.start, after), solver.addVariable(lb=0))
            if not block.exits() or (block.instructions[-1].ends and block.jump is None):
                ends[block.start] = solver.addVariable(lb=0, ub=1)
        into: dict[int, list[highspy.highs.highs_var]] = {start: [] for start in self.code.blocks}
        out: dict[int, list[highspy.highs.highs_var]] = {start: [] for start in self.code.blocks}
        for (begin, end), variable in ways.items():
            into[end].append(variable)
            if begin != -1:
                out[begin].append(variable)
        for start, variable in ends.items():
            out[start].append(variable)
        times: dict[int | str, highspy.highs.highs_linear_expression] = {
            start: solver.qsum(variables) for start, variables in into.items()
        }
        for start in self.code.blocks:
            solver.addConstr(times[start] == solver.qsum(out[start]))
        for loop, bound in self.rounds:
            inside = [ways[begin, loop.head] for begin in loop.back]
            outside = [v for (b, e), v in ways.items() if e == loop.head and b not in loop.back]
            entries = [v for (b, e), v in ways.items() if e in loop.blocks and b not in loop.blocks]
            # A loop with its condition at the end makes one iteration before its first jump back.
            first = solver.qsum(outside) if self._ends_with_condition(loop) else 0
            entered = 1 if bound.in_all else solver.qsum(entries)
            solver.addConstr(solver.qsum(inside) + first <= bound.rounds * entered)
        for start, most in self.counted:
            solver.addConstr(times[start] <= most)
        calls = {name: solver.addVariable(lb=0) for name in self.apart}
        counts = dict(times)
        counts.update(calls)
        for fact in self.facts:
            parts = [factor * counts[name] for name, factor in fact.factors.items()]
            solver.addConstr(solver.qsum(parts) <= fact.most)
        taken = [
            REFILL * ways[block.start, block.jump]
            for block in self.code.blocks.values()
            if block.jump is not None
        ]
        spent = [self.cost[start] * times[start] for start in self.code.blocks]
        spent += [self.apart[name] * variable for name, variable in calls.items()]
        solver.maximize(solver.qsum([*spent, *taken]))
        if solver.getModelStatus() != highspy.HighsModelStatus.kOptimal:
            return None
        return round(solver.getObjectiveValue() + 0.4999)

    def _ends_with_condition(self, loop: Loop) -> bool:
        """Returns true if the condition of the loop is at the end of each iteration, as in a
        do-while loop. The loop may have further exits in the middle of an iteration.

        A jump out of the loop is no exit if its target is a block that is never executed. An
        example of such a block is the failure branch of an assertion."""
        never = {start for start, most in self.counted if most == 0}

        def leaves(block: int) -> bool:
            return any(
                end not in loop.blocks and end not in never
                for end in self.code.blocks[block].exits()
            )

        return all(leaves(end) for end in loop.back) and (
            loop.head in loop.back or not leaves(loop.head)
        )
