"""Reads the instructions of a firmware image with their processor cycles, groups the instructions
into blocks, and finds the jumps, calls and loops.

The cycles are counted as on the virtual board (``sim/emulator/Timing.hpp``), from tables 3-1 and
7-1 of the Cortex-M4 manual. If the manual states a range, the greatest number is used. The flash
memory is assumed to be slow and to have no cache."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

from traceability.reading.graphs import reached_from
from traceability.reading.programs import disassembly, source_lines

FLASH_END = 0x100000
REFILL, ACCESS, DIVIDE, SPECIAL, FP_DIVIDE, FP_ACCUMULATE, PHRASE = 3, 1, 11, 1, 13, 2, 5
FUNCTION = re.compile(r"^([0-9a-f]+) <(.+)>:$")
LINE = re.compile(r"^\s*([0-9a-f]+):\t(\S+)(?:\t(.*))?$")
TARGET = re.compile(r"([0-9a-f]+) <([^>+]+)(\+0x[0-9a-f]+)?>")
CONDITION = r"(?:eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le|hs|lo)"
JUMP = re.compile(rf"^(?:b(?P<condition>{CONDITION})?(?:\.[nw])?|(?P<compare>cbn?z))$")
TABLE = re.compile(r"tb[bh] |(?:ldr\S*|add\S*|mov\S*) pc, (?!.*\[pc, #)")
MANY = re.compile(r"^(?:push|pop|ldm|stm|vpush|vpop|vldm|vstm)")
MEMORY = re.compile(r"^(?:v?ldr|v?str)")
PLACE = re.compile(r"((?:src|extensions|tests)/[^:]+):(\d+)")  # place in a file of the project
VENEER = re.compile(r"^_+(?P<name>\w+)_veneer$")


@dataclass
class Instruction:
    """A machine instruction. ``cycles`` does not include the additional cycles of a taken jump to
    another block, or the cycles of a called function."""

    address: int
    name: str
    operands: str
    cycles: int
    call: str = ""  # symbol of the called function; "" if the instruction is no call
    indirect: bool = False
    jumps: int | None = None  # target address of a jump
    # True if the instruction always jumps or returns. The next instruction in memory is then not
    # executed after it.
    ends: bool = False


@dataclass
class Block:
    """A basic block: instructions of which either all or none are executed."""

    start: int
    instructions: list[Instruction]
    next: int | None = None  # address of the block that follows if the program does not jump
    jump: int | None = None

    @property
    def cycles(self) -> int:
        return sum(instruction.cycles for instruction in self.instructions)

    def exits(self) -> list[int]:
        return [address for address in (self.next, self.jump) if address is not None]


@dataclass
class Loop:
    """A loop: its first block (the head), and all blocks on a path from the head back to the head.
    Each iteration passes through the head."""

    head: int
    blocks: set[int]
    back: set[int]  # blocks from which the program goes back to the head


@dataclass
class Code:
    """The machine code of a function. ``blocks`` contains its blocks by their start addresses."""

    symbol: str
    blocks: dict[int, Block] = field(default_factory=dict)
    hidden: bool = False  # true if the function has jumps whose targets are in a table
    loops: list[Loop] = field(default_factory=list)

    def instructions(self) -> Iterator[Instruction]:
        return (instruction for block in self.blocks.values() for instruction in block.instructions)


def read_code(elf: Path) -> dict[str, Code]:
    """Returns the machine code of each function by its symbol."""
    functions: dict[str, list[Instruction]] = {}
    current: list[Instruction] = []
    for line in disassembly(elf).splitlines():
        if start := FUNCTION.match(line):
            current = functions.setdefault(start[2], [])
        elif (match := LINE.match(line)) and not match[2].startswith("."):
            current.append(_instruction(int(match[1], 16), match[2], match[3] or ""))
    codes = {}
    for symbol, instructions in functions.items():
        if instructions:
            hidden = any(TABLE.match(f"{one.name} {one.operands}") for one in instructions)
            code = codes[symbol] = Code(symbol, _blocks(instructions), hidden)
            code.loops = _loops(code)
    return codes


def places(elf: Path, addresses: Iterable[int]) -> dict[int, list[tuple[str, int]]]:
    """Returns the source lines of each instruction. The first line is the line from which the
    instruction was compiled. If this line is in an inlined function, the next lines are the source
    lines of the inlined calls, from the innermost to the outermost call."""
    return {
        address: [(place[1], int(place[2])) for place in map(PLACE.search, lines) if place]
        for address, lines in source_lines(elf, addresses).items()
    }


def _instruction(address: int, name: str, operands: str) -> Instruction:
    made = Instruction(address, name, operands, _cycles(address, name, operands))
    plain = name.removesuffix(".n").removesuffix(".w")
    target = TARGET.search(operands)
    into_pc = bool(re.search(r"\bpc\b", operands.partition(";")[0].partition("[")[0]))
    if plain == "bl" and target:
        made.call, made.cycles = target[2], made.cycles + REFILL
    elif plain == "blx":
        made.indirect, made.cycles = True, made.cycles + REFILL
    elif jump := JUMP.match(name):
        made.ends = jump["condition"] is None and jump["compare"] is None
        if target:
            made.jumps, made.call = int(target[1], 16), target[2]
    elif plain.startswith("bx"):
        made.ends, made.cycles = True, made.cycles + REFILL
        made.indirect = "lr" not in operands
    elif plain.startswith(("pop", "ldm", "ldr", "mov")) and into_pc:
        made.ends, made.cycles = True, made.cycles + REFILL
    return made


def _cycles(address: int, name: str, operands: str) -> int:
    cycles = 1
    if MANY.match(name):
        cycles += register_words(operands.partition("{")[2].partition("}")[0])
    elif MEMORY.match(name):
        cycles += ACCESS * (2 if name.startswith(("ldrd", "strd", "v")) else 1)
    elif name.startswith(("sdiv", "udiv")):
        cycles += DIVIDE
    elif name.startswith(("mrs", "msr", "cps")):
        cycles += SPECIAL
    elif name.startswith("isb"):
        cycles += REFILL
    elif name.startswith(("vdiv", "vsqrt")):
        cycles += FP_DIVIDE
    elif name.startswith(("vmla", "vmls", "vfma", "vfms", "vnm", "vfnm")):
        cycles += FP_ACCUMULATE
    # In the worst case, the processor waits for two phrases (8 bytes each) of the flash: for the
    # phrase with the instruction, and for the phrase with a constant that the instruction reads.
    if address < FLASH_END:
        cycles += 2 * PHRASE
    return cycles


def register_words(names: str) -> int:
    """Returns the number of words of 4 bytes in a list of registers, such as ``r4-r7, lr``."""
    count = 0
    for part in names.split(","):
        first, _, last = part.strip().partition("-")
        number = int(last[1:]) - int(first[1:]) + 1 if last else 1
        count += number * (2 if first.startswith("d") else 1)
    return count


def _blocks(instructions: list[Instruction]) -> dict[int, Block]:
    addresses = {instruction.address for instruction in instructions}
    starts = {instructions[0].address}
    for present, after in zip(instructions, [*instructions[1:], None], strict=True):
        if present.jumps in addresses:
            starts.add(present.jumps)
        if after and (present.ends or present.jumps is not None):
            starts.add(after.address)
    blocks: dict[int, Block] = {}
    block = None
    for present in instructions:
        if present.address in starts:
            if block is not None and block.instructions and not block.instructions[-1].ends:
                block.next = present.address
            block = blocks[present.address] = Block(present.address, [])
        assert block is not None
        block.instructions.append(present)
        if present.jumps in addresses:
            block.jump, present.call = present.jumps, ""
        elif present.jumps is not None:
            # A jump to another function (a tail call). That function returns to the caller of this
            # function.
            present.cycles += REFILL
    return blocks


def _loops(code: Code) -> list[Loop]:
    """Returns all loops of a function. A natural loop has a jump back to its head, and each path to
    this jump passes through the head."""
    entry = next(iter(code.blocks))
    ways = {block.start: block.exits() for block in code.blocks.values()}
    before: dict[int, list[int]] = {start: [] for start in ways}
    for start, exits in ways.items():
        for after in exits:
            before[after].append(start)
    reached = {entry, *_after(ways, entry)}
    loops: dict[int, Loop] = {}
    for start, exits in ways.items():
        for head in exits:
            around = {entry, *_after(ways, entry, head)} if head != entry else set()
            if start == head or start in reached - around:
                loop = loops.setdefault(head, Loop(head, {head}, set()))
                loop.back.add(start)
                loop.blocks |= {start, *_after(before, start, head)} if start != head else set()
    return [*loops.values(), *_entered_twice(code, list(loops.values()))]


def _entered_twice(code: Code, loops: list[Loop]) -> list[Loop]:
    """Returns the loops that the program can enter at several blocks. Such a loop is not a natural
    loop. A block that is part of each iteration is chosen as the head of the loop."""
    entered_loops: list[Loop] = []
    while True:
        ways = {
            start: [
                after
                for after in block.exits()
                if not any(
                    after == loop.head and start in loop.back for loop in [*loops, *entered_loops]
                )
            ]
            for start, block in code.blocks.items()
        }
        cycle = _cycle(ways)
        if not cycle:
            return entered_loops
        blocks = {block for block in _after(ways, cycle[0]) if cycle[0] in _after(ways, block)}
        heads = (block for block in sorted(blocks) if not _cycle(_within(ways, blocks - {block})))
        head = next(heads, None)
        if head is None:
            # The loop has no block that is part of each iteration. The function then has no bound.
            return entered_loops
        entered_loops.append(Loop(head, blocks, {block for block in blocks if head in ways[block]}))


def _cycle(ways: Mapping[int, Iterable[int]]) -> list[int]:
    try:
        TopologicalSorter(ways).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def _within(ways: Mapping[int, Iterable[int]], blocks: set[int]) -> dict[int, list[int]]:
    return {start: [way for way in ways[start] if way in blocks] for start in blocks}


def _after(
    ways: Mapping[int, Iterable[int]], start: int, without: int | None = None
) -> Collection[int]:
    """Returns the blocks that can follow a block, on paths that do not pass ``without``."""

    def next_of(block: int) -> list[int]:
        return [after for after in ways[block] if after != without]

    return reached_from(next_of(start), next_of)
