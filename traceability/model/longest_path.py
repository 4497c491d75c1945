"""The greatest cost of a path through a function, as a linear program (HiGHS).

The variable of each edge between two blocks is the number of times that a path uses it: the
implicit path enumeration of Li and Malik. Its value need not be an integer: this can only make the
bound greater.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import highspy

from traceability.reading.loop_bounds import Bound
from traceability.reading.machine_code import REFILL, Code, Loop


@dataclass
class Problem:
    """The paths of a function as a linear program: a variable for each edge between blocks."""

    code: Code
    cost: Mapping[int, int]  # of each block
    rounds: Iterable[tuple[Loop, Bound]]
    counted: Iterable[tuple[int, int]]  # block, and the greatest number of its executions

    def solve(self) -> int | None:
        """The greatest cost of a path; nothing when it has no bound, or no path has an end."""
        solver = highspy.Highs()  # type: ignore[no-untyped-call]
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
        times = {start: solver.qsum(variables) for start, variables in into.items()}
        for start in self.code.blocks:
            solver.addConstr(times[start] == solver.qsum(out[start]))
        for loop, bound in self.rounds:
            inside = [ways[begin, loop.head] for begin in loop.back]
            # A loop with its condition at the end jumps back once less than the number of rounds.
            exits = self.code.blocks[loop.head].exits()
            leaves = loop.head not in loop.back and any(one not in loop.blocks for one in exits)
            jumps = bound.rounds if leaves or bound.in_all else max(bound.rounds - 1, 0)
            outside = [v for (b, e), v in ways.items() if e == loop.head and b not in loop.back]
            most = jumps * (1 if bound.in_all else solver.qsum(outside))
            solver.addConstr(solver.qsum(inside) <= most)
        for start, most in self.counted:
            solver.addConstr(times[start] <= most)
        taken = [
            REFILL * ways[block.start, block.jump]
            for block in self.code.blocks.values()
            if block.jump is not None
        ]
        spent = [self.cost[start] * times[start] for start in self.code.blocks]
        solver.maximize(solver.qsum([*spent, *taken]))
        if solver.getModelStatus() != highspy.HighsModelStatus.kOptimal:
            return None
        return round(solver.getObjectiveValue() + 0.4999)
