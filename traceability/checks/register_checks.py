"""secret-registers: only the modules that own a block of registers use the registers of this
block."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.ast_facts import BodyFact
from traceability.reading.declared import Block
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below
from traceability.reading.translation_units import is_board
from traceability.schema import Finding, Place
from traceability.sources import DESIGN

REGISTERS = "src/k64/registers.hpp"  # the file with the table of all blocks
REGISTER = "src/k64/Register.hpp"  # the only file that may convert a number to an address
CLASS = "Register"
PERIPHERALS = 0x4000_0000  # the first address of the peripherals' registers
CORE = 0xE000_0000  # the first address of the core's registers
OWNERS = "design/register_owners.toml"
CALL_OWNER = "call an operation of the owner"
START_UP = "/start_up/"  # folders whose assembler instructions may access memory
# an instruction that reads or writes memory
MEMORY = re.compile(r'"\s*(ld|st)[a-z]+[\s.]|\\[nt](ld|st)[a-z]+[\s.]')


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    yield from _used(model, facts)
    for find in (_undeclared, _past_the_table, _twice, _borrowed, _given, _linked, _outside):
        yield from find(facts)
    for block in facts.declared.blocks:
        yield from _idle(block, facts)


def _finding(place: Place, text: str, fix: str) -> Finding:
    return Finding(place, "secret-registers", text, fix)


def _owners(facts: Facts) -> dict[str, Block]:
    return {block.name: block for block in facts.declared.blocks}


def _files(module: str, facts: Facts) -> set[str]:
    """Returns the header and the source file of a module. Returns nothing if no module has this
    name."""
    fact = facts.classes.get(module)
    if fact is None:
        return set()
    header = fact.place.file
    return {header, header.removesuffix(".hpp") + ".cpp"}


def _undeclared(facts: Facts) -> Iterator[Finding]:
    owners = _owners(facts)
    for fact in facts.syntax.blocks:
        if fact.declares and fact.place.file == REGISTERS and fact.block not in owners:
            text = f"the block {fact.block} has no owner in {OWNERS}"
            yield _finding(fact.place, text, "declare the module that owns it")


def _used(model: Model, facts: Facts) -> Iterator[Finding]:
    owners = _owners(facts)
    findings: dict[tuple[str, int, str], Finding] = {}
    for fact in facts.syntax.blocks:
        block = owners.get(fact.block)
        if block is None or fact.file != REGISTERS or fact.place.file == REGISTERS:
            continue
        if not any(fact.place.file in _files(owner, facts) for owner in block.owners):
            file = fact.place.file
            modules = (m.name for m in model.modules.values() if file in (m.header, m.source))
            owners_own = f"{' and '.join(block.owners)} own{'s' * (len(block.owners) == 1)}"
            text = f"{next(modules, file)} names registers of {block.name}, which {owners_own}"
            findings[file, fact.place.line, block.name] = _finding(fact.place, text, CALL_OWNER)
    yield from findings.values()


def _past_the_table(facts: Facts) -> Iterator[Finding]:
    """Finds registers that are defined outside the table of registers. Also finds other code that
    accesses a register by its address."""
    fix = f"add the register to {REGISTERS}, and access the register by the name from this table"
    for name in facts.syntax.names:
        outside = name.place.file not in (REGISTERS, REGISTER)
        if name.target == CLASS and name.how == "type" and outside:
            yield _finding(name.place, "a register is defined outside the table of registers", fix)
    for place in facts.syntax.instructions:
        if not is_board(place.file):
            text = "an assembler instruction is outside the drivers"
            yield _finding(place, text, "move the instruction to a driver")
        elif _reaches(place, facts):
            text = "an assembler instruction accesses memory"
            instead = f"access memory in C++, and a register by its name in {REGISTERS}"
            yield _finding(place, text, instead)
    for place in facts.syntax.volatile:
        if place.file != REGISTER:
            yield _finding(place, "volatile memory is accessed outside the table of registers", fix)
    for place in facts.syntax.casts:
        if place.file != REGISTER:
            yield _finding(place, "a number is converted to an address", fix)


def _reaches(place: Place, facts: Facts) -> bool:
    """Returns whether an assembler instruction reads or writes memory. The start-up code may do
    this."""
    words = "\n".join(facts.lines_of(place.file)[place.line - 1 :]).partition(";")[0]
    return START_UP not in place.file and MEMORY.search(words) is not None


def _twice(facts: Facts) -> Iterator[Finding]:
    """Finds register addresses that occur in two blocks. With such an address, the owner of one
    block could access a register of the other block."""
    first: dict[int, str] = {}
    for place, block, address in _table(facts):
        if address is None:
            text = "the address of the register is not a number"
            yield _finding(place, text, "write the address from the manual")
            continue
        owner = first.setdefault(address, block)
        if owner != block:
            text = f"the address {address:#x} in the block {block} is already in the block {owner}"
            yield _finding(place, text, "keep it only in the block that the manual names")


def lines_of_blocks(root: Path) -> Iterator[tuple[Place, str, str]]:
    """Yields the place, the block and the text of each line in the table of registers."""
    block = ""
    for place, line in lines_below(root, (REGISTERS,), ()):
        opened = re.match(r"namespace (\w+)", line)
        block = opened[1] if opened else block
        yield place, block, line


def _table(facts: Facts) -> Iterator[tuple[Place, str, int | None]]:
    """Yields the place, the block and the address of each register in the table. The address is
    None if the table does not state it as a number."""
    for place, block, line in lines_of_blocks(facts.root):
        address = re.search(r"\bRegister<[^>]*?\b(0x[\da-fA-F']+)\s*[,>]", line)
        if address is not None:
            yield place, block, int(address[1].replace("'", ""), 16)
        elif re.search(r"\bRegister\s*<", line.split("//")[0]):
            yield place, block, None


def _outside(facts: Facts) -> Iterator[Finding]:
    """Finds accesses with an offset that is so large that the accessed register belongs to another
    block."""
    blocks: dict[str, list[int]] = {}
    for _, block, address in _table(facts):
        if address is not None:
            blocks.setdefault(block, []).append(address)
    for fact in facts.syntax.offsets:
        if fact.offset >= PERIPHERALS:
            text = f"the offset {fact.offset:#x} is itself an address in the range of the registers"
            yield _finding(fact.place, text, CALL_OWNER)
            continue
        own = {block for block, registers in blocks.items() if fact.base in registers}
        reached = fact.base + fact.offset
        others = {
            block for block, registers in blocks.items() if _lies_in(reached, registers)
        } - own
        if others and not any(_lies_in(reached, blocks[block]) for block in own):
            text = f"an offset from {', '.join(sorted(own))} leads to {', '.join(sorted(others))}"
            yield _finding(fact.place, text, CALL_OWNER)


def _lies_in(address: int, registers: list[int]) -> bool:
    """Returns whether an address belongs to the block that has the given registers. This is the
    case if the address is between the first and the last register, or in the same memory page as
    the last register."""
    first, last = min(registers), max(registers)
    return first <= address <= last or _page(address) == _page(last)


def _page(address: int) -> int:
    """Returns the number of the memory page (4 KiB) that contains an address. For an address of the
    core, returns the address itself, because several blocks of the core share a page."""
    return address >> 12 if address < CORE else address


def _borrowed(facts: Facts) -> Iterator[Finding]:
    """Finds a block in the table of registers if it names a register of another block."""
    own = {place.line: block for place, block, _ in lines_of_blocks(facts.root)}
    for fact in facts.syntax.blocks:
        in_table = fact.place.file == fact.file == REGISTERS
        if in_table and fact.block != own[fact.place.line]:
            text = f"the block {own[fact.place.line]} names a register of {fact.block}"
            yield _finding(fact.place, text, "let the owner of that block access it")


def _given(facts: Facts) -> Iterator[Finding]:
    """Finds functions and public members through which other modules can access a register of a
    module."""
    flows = facts.syntax.flows
    table = {flow.into for flow in flows if f"object {flow.into} {CLASS}" in flow.sources}
    table.add(f"result {CLASS}::at")
    findings: dict[tuple[str, int], Finding] = {}
    for flow in flows:
        word, _, rest = flow.into.partition(" ")
        function = rest.rpartition(" ")[0] if word == "param" else rest
        if word not in ("result", "param") or table.isdisjoint(flow.sources):
            continue
        for body in facts.bodies.get(function, []):
            own = _module_of(body.place.file) == _module_of(flow.file)
            if body.place.file == REGISTER or (own and not _is_open(body, word, facts)):
                continue
            verb = "returns" if word == "result" else "receives"
            text = f"{function} {verb} a register, so two modules can access this register"
            fix = "let the owner read or write the register, and return the meaning of its value"
            findings[body.place.file, body.place.line] = _finding(body.place, text, fix)
    for fact in facts.syntax.classes:
        for field in fact.fields:
            if field.access == "public" and CLASS in field.classes:
                text = f"{fact.name}::{field.name} is a register that other modules can use"
                key = (field.place.file, field.place.line)
                findings[key] = _finding(field.place, text, "make it private")
    yield from findings.values()


def _module_of(file: str) -> str:
    return file.rpartition(".")[0]


def _is_open(body: BodyFact, word: str, facts: Facts) -> bool:
    """Returns whether other modules can call a function that returns a register. Returns false if
    `word` is "param": such a function does not return the register, but receives it as a
    parameter."""
    if word == "param" or body.local:
        return False
    methods = facts.classes[body.owner].methods if body.owner in facts.classes else []
    return not any(m.id == body.id and m.access == "private" for m in methods)


def _linked(facts: Facts) -> Iterator[Finding]:
    """Finds addresses in linker scripts that are in the range of the registers."""
    text = "the linker script contains an address in the range of the registers"
    for place, line in lines_below(facts.root, DESIGN, (".ld",)):
        if any(int(word, 16) >= PERIPHERALS for word in re.findall(r"\b0[xX][\da-fA-F]+", line)):
            yield _finding(place, text, f"use {REGISTERS}")


def _idle(block: Block, facts: Facts) -> Iterator[Finding]:
    declared = {
        fact.block for fact in facts.syntax.blocks if fact.declares and fact.file == REGISTERS
    }
    if block.name not in declared:
        text = f"{REGISTERS} has no block {block.name}"
        yield _finding(block.place, text, "remove the entry, or correct the name")
        return
    users = {fact.place.file for fact in facts.syntax.blocks if fact.block == block.name}
    for owner in block.owners:
        if not users & _files(owner, facts):
            text = f"{owner} does not use the block {block.name}"
            yield _finding(block.place, text, "correct the owners")
