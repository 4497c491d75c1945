"""The longest time for which the code of a firmware image blocks the interrupts."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

from traceability.model.time_bounds import ENDS
from traceability.reading.machine_code import REFILL, Block, Code, Instruction


def longest_locks(codes: Mapping[str, Code]) -> dict[int, tuple[str, float]]:
    """Returns two values for each instruction that blocks the interrupts: the symbol of its
    function, and the longest time [cycle] until no lock blocks the interrupts.

    The time is infinite if a loop or a call is executed in this time, because the computation has
    no bound for them. Functions that end the firmware are left out."""
    return {
        one.address: (symbol, _longest(code, block, index, 0, ()))
        for symbol, code in codes.items()
        if not any(end in symbol for end in ENDS)
        for block in code.blocks.values()
        for index, one in enumerate(block.instructions)
        if _step(one) > 0
    }


def _longest(code: Code, block: Block, index: int, locks: int, before: tuple[Block, ...]) -> float:
    """Returns the longest time that begins at an instruction of a block and ends when all locks of
    the interrupts are released. ``locks`` is the number of locks before this instruction.
    ``before`` contains the blocks on the way to this block."""
    cycles = 0
    for one in block.instructions[index:]:
        cycles += one.cycles
        locks += _step(one)
        if locks == 0:
            return cycles
        if any(end in one.call for end in ENDS):
            return 0
        if one.call or one.indirect:
            return inf
    if block in before or not block.exits():
        return inf
    return cycles + max(
        (REFILL if after == block.jump else 0)
        + _longest(code, code.blocks[after], 0, locks, (*before, block))
        for after in block.exits()
    )


def _step(one: Instruction) -> int:
    """Returns 1 for an instruction that begins a lock, -1 for an instruction that ends a lock, and
    0 for any other instruction."""
    register = one.operands.upper().partition(",")[0] if one.name == "msr" else ""
    return {"cpsid": 1, "BASEPRI_MAX": 1, "cpsie": -1, "BASEPRI": -1}.get(register or one.name, 0)
