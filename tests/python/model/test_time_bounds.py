"""The longest path through a small program: its loops, its calls, and a loop that is added."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from traceability.model.longest_path import Problem
from traceability.reading.loop_bounds import Bound, Bounds
from traceability.reading.machine_code import REFILL, Code, read_code

START = """
    .syntax unified
    .cpu cortex-m4
    .thumb
    .text
    .thumb_func
    .global run
run:
"""
# Ten rounds: one cycle for each of the two additions, and the jump back.
LOOP = """
    movs r0, #10
1:  adds r1, r1, #1
    subs r0, r0, #1
    bne 1b
    bx lr
"""
# One path costs one division more than the other.
FORK = """
    cmp r0, #0
    beq 1f
    sdiv r1, r1, r2
    b 2f
1:  adds r1, r1, #1
2:  bx lr
"""
# A copy of four registers, a load and a store of one.
MEMORY = """
    ldm r0, {r1, r2, r3, r4}
    ldr r5, [r0]
    str r5, [r0]
    push {r4, lr}
    pop {r4, pc}
"""


def code_of(folder: Path, text: str) -> Code:
    (folder / "program.s").write_text(START + text, encoding="utf-8")
    words = ["arm-none-eabi-as", "-mcpu=cortex-m4", "-o", "program.o", "program.s"]
    subprocess.run(words, cwd=folder, check=True, timeout=60)
    words = ["arm-none-eabi-ld", "-Ttext=0x20000000", "-e", "run", "-o", "p.elf", "program.o"]
    subprocess.run(words, cwd=folder, check=True, timeout=60)
    return read_code(folder / "p.elf")["run"]


def longest(code: Code, rounds: int = 0) -> int:
    cost = {start: block.cycles for start, block in code.blocks.items()}
    bounds = [(loop, Bound(rounds, in_all=False)) for loop in code.loops]
    return Problem(code, cost, bounds, []).solve()


def test_a_loop_costs_its_rounds(tmp_path: Path) -> None:
    code = code_of(tmp_path, LOOP)
    assert len(code.loops) == 1
    assert longest(code, 10) == 1 + 10 * 3 + 9 * REFILL + 1 + REFILL


def test_the_longer_way_counts(tmp_path: Path) -> None:
    assert longest(code_of(tmp_path, FORK)) == 1 + 1 + 12 + 1 + REFILL + 1 + REFILL


def test_memory_costs_what_the_manual_says(tmp_path: Path) -> None:
    assert longest(code_of(tmp_path, MEMORY)) == (1 + 4) + 2 + 2 + (1 + 2) + (1 + 2 + REFILL)


def test_a_busy_loop_moves_the_bound(tmp_path: Path) -> None:
    before = longest(code_of(tmp_path, FORK))
    busy = FORK.replace(
        "2:  bx lr", "2:  movs r3, #200\n3:  subs r3, r3, #1\n    bne 3b\n    bx lr"
    )
    assert longest(code_of(tmp_path, busy), 200) == before + 1 + 200 * 2 + 199 * REFILL


def test_a_block_that_is_never_passed_costs_nothing(tmp_path: Path) -> None:
    code = code_of(tmp_path, FORK)
    cost = {start: block.cycles for start, block in code.blocks.items()}
    division = next(s for s, b in code.blocks.items() if b.instructions[0].name == "sdiv")
    assert Problem(code, cost, [], [(division, 0)]).solve() == 1 + 1 + REFILL + 1 + 1 + REFILL


@pytest.mark.parametrize(
    ("text", "bound"),
    [
        ("// bound: 5", Bound(5, in_all=False)),
        ("  // bound: kMost / (2 + 1) in all; and why", Bound(4, in_all=True)),
        ("for (std::size_t i = 0; i < kMost; ++i) {", None),
        ("// no number", None),
    ],
)
def test_the_line_above_a_loop_declares_its_bound(
    tmp_path: Path, text: str, bound: Bound | None
) -> None:
    (tmp_path / "a.cpp").write_text(f"{text}\nfor (int one : all) {{\n", encoding="utf-8")
    assert Bounds(tmp_path, {"kMost": 12}).at(("a.cpp", 2)) == bound


def test_the_constant_in_the_head_of_a_loop_is_its_bound(tmp_path: Path) -> None:
    head = "for (std::size_t i = 0; i < kMost; ++i) {\n"
    (tmp_path / "a.cpp").write_text(head, encoding="utf-8")
    assert Bounds(tmp_path, {"kMost": 12}).at(("a.cpp", 1)) == Bound(12, in_all=False)


def test_a_table_of_jumps_is_seen(tmp_path: Path) -> None:
    """The paths of this function cannot be followed, so it has no bound."""
    table = "    tbb [pc, r0]\n    .byte 1, 2\n    .align 1\n    bx lr\n"
    assert code_of(tmp_path, table).hidden
    assert not code_of(tmp_path, MEMORY).hidden


def test_a_loop_that_nothing_bounds_has_no_longest_path(tmp_path: Path) -> None:
    code = code_of(tmp_path, LOOP)
    cost = {start: block.cycles for start, block in code.blocks.items()}
    assert Problem(code, cost, [], []).solve() is None
