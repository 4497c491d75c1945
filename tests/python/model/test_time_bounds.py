"""The longest path through a small program with loops and calls."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from math import inf
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest

from traceability.model.image_code import Program
from traceability.model.interrupt_locks import longest_locks
from traceability.model.longest_path import Problem
from traceability.model.response_times import (
    CLOCK,
    NANOSECONDS,
    RETRY,
    cycle_response,
    in_order,
    too_many,
    with_responses,
)
from traceability.model.stack import Prover
from traceability.model.time_bounds import DeclaredFacts, Spread, Times
from traceability.reading.call_graph import Function
from traceability.reading.call_record import Activation, Recording, Span
from traceability.reading.loop_bounds import Bound, Bounds, Inequality, read_inequality
from traceability.reading.machine_code import REFILL, Code, read_code
from traceability.schema import TimeBound

START = """
    .syntax unified
    .cpu cortex-m4
    .thumb
    .text
    .thumb_func
    .global run
run:
"""
# Ten iterations. Each iteration has an addition, a subtraction, and the jump back.
LOOP = """
    movs r0, #10
1:  adds r1, r1, #1
    subs r0, r0, #1
    bne 1b
    bx lr
"""
# One path has a division, and the other path has an addition.
FORK = """
    cmp r0, #0
    beq 1f
    sdiv r1, r1, r2
    b 2f
1:  adds r1, r1, #1
2:  bx lr
"""
# A path can enter the loop at its first or at its second addition.
ENTERED_TWICE = """
    movs r0, #10
    cbz r2, 2f
1:  adds r1, r1, #1
2:  adds r1, r1, #2
    subs r0, r0, #1
    bne 1b
    bx lr
"""
# The condition of the loop is between two parts of an iteration. The first part can skip an
# addition.
MIDDLE = """
    movs r0, #10
1:  cbnz r2, 2f
    adds r1, r1, #1
2:  cmp r0, #0
    beq 3f
    subs r0, r0, #1
    b 1b
3:  bx lr
"""
# An iteration begins with an assertion, and ends with the condition.
ASSERTED = """
    movs r0, #10
1:  cmp r2, #0
    bne 2f
    subs r0, r0, #1
    bne 1b
    bx lr
2:  udf #0
    bx lr
"""
# Loads four registers, loads and stores one register, and uses the stack.
MEMORY = """
    ldm r0, {r1, r2, r3, r4}
    ldr r5, [r0]
    str r5, [r0]
    push {r4, lr}
    pop {r4, pc}
"""
# A thread that halts a wheel. It calls a function with a loop.
ROUNDS = 10
HALT = """
    push {r4, lr}
    bl halt
    pop {r4, pc}
    .thumb_func
    .global halt
halt:
1:  subs r0, r0, #1
    bne 1b
    bx lr
"""
# The begin and the end of a lock, and a jump that skips a division.
LOCK = "msr basepri_max, r3\n"
UNLOCK = "msr basepri, r2\n"
SKIP = "cmp r0, #0\n beq 1f\n sdiv r1, r1, r2\n 1:"
NAMES = {"run": "wr::Thread::run()", "halt": "wr::Halt::execute()"}


def times_of(folder: Path, facts: DeclaredFacts) -> Times:
    """Returns the bounds of the thread that halts a wheel."""
    code_of(folder, HALT)
    graph = {symbol: Mock(spec=Function) for symbol in NAMES}
    for symbol, function in graph.items():
        function.name = NAMES[symbol]
    prover = Mock(spec=Prover, graph=graph, most={}, symbols={"Halt::execute": ["halt"]})
    prover.is_full.return_value = False
    codes = read_code(folder / "p.elf")
    places = {loop.head: [("halt.cpp", 2)] for loop in codes["halt"].loops}
    (folder / "halt.cpp").write_text(f"// bound: {ROUNDS}\nwhile (on) {{\n", encoding="utf-8")
    return Times(Program(codes, places, {}), Bounds(folder, {}), prover, facts)


def code_of(folder: Path, text: str) -> Code:
    (folder / "program.s").write_text(START + text, encoding="utf-8")
    words = ["arm-none-eabi-as", "-mcpu=cortex-m4", "-o", "program.o", "program.s"]
    subprocess.run(words, cwd=folder, check=True, timeout=60)
    words = ["arm-none-eabi-ld", "-Ttext=0x20000000", "-e", "run", "-o", "p.elf", "program.o"]
    subprocess.run(words, cwd=folder, check=True, timeout=60)
    return read_code(folder / "p.elf")["run"]


def longest(code: Code, rounds: int = 0, *more: Any, never: Sequence[int] = ()) -> int | None:
    """Returns the cycles of the longest path. The blocks ``never`` are not part of any path.
    ``more`` are the further arguments of a Problem."""
    cost = {start: block.cycles for start, block in code.blocks.items()}
    bounds = [(loop, Bound(rounds, in_all=False)) for loop in code.loops]
    return Problem(code, cost, bounds, [(start, 0) for start in never], *more).solve()


def test_a_loop_costs_its_rounds(tmp_path: Path) -> None:
    code = code_of(tmp_path, LOOP)
    assert len(code.loops) == 1
    assert longest(code, 10) == 1 + 10 * 3 + 9 * REFILL + 1 + REFILL


def test_a_loop_that_is_entered_at_two_places_costs_its_rounds(tmp_path: Path) -> None:
    code = code_of(tmp_path, ENTERED_TWICE)
    (loop,) = code.loops
    assert len(loop.blocks) == 2
    # A path can enter the loop in the middle, and then executes only a part of an iteration. The
    # bound includes this part, in addition to the complete iterations.
    first = REFILL + 3 + REFILL
    assert longest(code, 10) == 1 + 1 + first + 10 * 4 + 9 * REFILL + 1 + REFILL


def test_a_loop_with_its_condition_in_the_middle_begins_once_more_than_it_has_rounds(
    tmp_path: Path,
) -> None:
    """With ten iterations, the part before the condition is executed eleven times."""
    before, first, second, after = 1, 1 + REFILL + 2, 2 + REFILL, REFILL + 1 + REFILL
    assert longest(code_of(tmp_path, MIDDLE), 10) == before + 11 * first + 10 * second + after


def test_the_end_of_an_assertion_is_not_the_condition_of_a_loop(tmp_path: Path) -> None:
    code = code_of(tmp_path, ASSERTED)
    end = next(s for s, b in code.blocks.items() if b.instructions[0].name.startswith("udf"))
    assert longest(code, 10, never=[end]) == 1 + 10 * 4 + 9 * REFILL + 1 + REFILL


def test_the_longer_way_counts(tmp_path: Path) -> None:
    assert longest(code_of(tmp_path, FORK)) == 1 + 1 + 12 + 1 + REFILL + 1 + REFILL


def test_memory_costs_what_the_manual_says(tmp_path: Path) -> None:
    assert longest(code_of(tmp_path, MEMORY)) == (1 + 4) + 2 + 2 + (1 + 2) + (1 + 2 + REFILL)


def test_a_busy_loop_moves_the_bound(tmp_path: Path) -> None:
    before = longest(code_of(tmp_path, FORK)) or 0
    busy = FORK.replace(
        "2:  bx lr", "2:  movs r3, #200\n3:  subs r3, r3, #1\n    bne 3b\n    bx lr"
    )
    assert longest(code_of(tmp_path, busy), 200) == before + 1 + 200 * 2 + 199 * REFILL


def test_a_block_that_is_never_passed_costs_nothing(tmp_path: Path) -> None:
    code = code_of(tmp_path, FORK)
    division = next(s for s, b in code.blocks.items() if b.instructions[0].name == "sdiv")
    assert longest(code, never=[division]) == 1 + 1 + REFILL + 1 + 1 + REFILL


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
    """The paths of this function cannot be followed. Therefore the function has no bound."""
    table = "    tbb [pc, r0]\n    .byte 1, 2\n    .align 1\n    bx lr\n"
    assert code_of(tmp_path, table).hidden
    assert not code_of(tmp_path, MEMORY).hidden


def test_a_loop_that_nothing_bounds_has_no_longest_path(tmp_path: Path) -> None:
    code = code_of(tmp_path, LOOP)
    cost = {start: block.cycles for start, block in code.blocks.items()}
    assert Problem(code, cost, [], []).solve() is None


def test_a_fact_limits_a_sum_of_executions(tmp_path: Path) -> None:
    """The fact limits a sum to 7. Each iteration of the loop adds 1 to the sum, and the exit from
    the loop adds 2. The longest path therefore has five iterations."""
    code = code_of(tmp_path, LOOP)
    (loop,) = code.loops
    after = max(code.blocks)
    fact = Inequality({loop.head: 1, after: 2}, 7)
    assert longest(code, 10, [fact]) == 1 + 5 * 3 + 4 * REFILL + 1 + REFILL


def test_a_callee_that_is_counted_apart_costs_its_number_of_calls(tmp_path: Path) -> None:
    code = code_of(tmp_path, MEMORY)
    facts = [Inequality({"orders": 3}, 9)]
    assert longest(code, 0, facts, {"orders": 100}) == (longest(code) or 0) + 300


def test_a_fact_is_an_inequality_of_sums() -> None:
    text = "2 * ends + bodies <= entries + Limit::kMost"
    counters = ("ends", "bodies")
    found = read_inequality(text, counters, lambda one: {"Limit__kMost": 9}.get(one) or int(one))
    assert found == Inequality({"ends": 2, "bodies": 1, "entries": -1}, 9)


def test_a_text_without_a_sign_is_no_fact() -> None:
    with pytest.raises(ValueError, match="no inequality"):
        read_inequality("ends", ("ends",), int)


def context(name: str, cycles: int, priority: int, entries: int | None = None) -> TimeBound:
    noise = None if entries is None else 2 * entries
    return TimeBound(name, name, cycles, entries, 1, noise, priority, "why")


def test_an_interrupt_comes_once_before_the_cycle_and_once_in_each_tick_of_it() -> None:
    contexts = [context("thread", CLOCK, 12), context("edge", 1_000, 1, entries=2)]
    # The interrupt `edge` has two requests in each tick. Some of these requests can already wait
    # when the cycle begins. Therefore the longest waiting time is added to the length of the cycle.
    # The sum is longer than one tick and shorter than two ticks. Therefore the requests of two
    # ticks delay the cycle.
    assert cycle_response(contexts, noise=False) == CLOCK + 2 * 2 * (1_000 + RETRY)
    # With noise, the interrupt has four requests in each tick. Two times are added to the length of
    # the cycle: one tick before the cycle, and the longest delay of the handler of the tick, which
    # is also one tick here. Therefore the requests of four ticks delay the cycle.
    assert cycle_response(contexts, noise=True) == CLOCK + 4 * 4 * (1_000 + RETRY)


def test_a_busy_loop_in_a_thread_moves_the_cycle_and_no_interrupt() -> None:
    short = [context("thread", 1_000, 12), context("edge", 100, 1, entries=1)]
    longer = [context("thread", 31_000, 12), context("edge", 100, 1, entries=1)]
    moved = cycle_response(longer, noise=False) - cycle_response(short, noise=False)
    assert moved == 30_000
    assert with_responses(short)[1].response_ms == with_responses(longer)[1].response_ms


def test_only_higher_and_equal_priorities_delay_an_interrupt() -> None:
    contexts = [context("high", 50, 1, entries=1), context("low", 9_000, 3, entries=1)]
    high, low = with_responses(contexts)
    assert (high.response_ms or 0) * CLOCK == 50 + 50 + RETRY
    assert (low.response_ms or 0) * CLOCK == 9_000 + 9_000 + RETRY + 50 + RETRY


def test_a_lock_of_other_code_delays_each_interrupt_and_the_cycle_once() -> None:
    contexts = [context("thread", 1_000, 12), context("edge", 50, 1, entries=1)]
    before, after = with_responses(contexts), with_responses(contexts, 94)
    assert ((after[1].response_ms or 0) - (before[1].response_ms or 0)) * CLOCK == 94
    without = cycle_response(contexts, noise=False)
    assert cycle_response(contexts, 94, noise=False) - without == 94


@pytest.mark.parametrize(
    ("text", "cycles"),
    [
        ("cpsid i\n nop\n wfi\n cpsie i\n bx lr", 2 + 1 + 1 + 2),
        (f"{LOCK} {SKIP} {UNLOCK} bx lr", 2 + 1 + 1 + 12 + 2),
        (f"{LOCK} {LOCK} {UNLOCK} nop\n {UNLOCK} bx lr", 2 + 2 + 2 + 1 + 2),
        (f"{LOCK} 1: subs r0, r0, #1\n bne 1b\n {UNLOCK} bx lr", inf),
        (f"{LOCK} bl run\n {UNLOCK} bx lr", inf),
        (f"{LOCK} bx lr", inf),
    ],
)
def test_a_lock_lasts_until_the_last_lock_ends(tmp_path: Path, text: str, cycles: float) -> None:
    code = code_of(tmp_path, text)
    assert next(iter(longest_locks({"run": code}).values())) == ("run", cycles)


@pytest.mark.parametrize(
    ("requests", "found"),
    [((0, 1.0, 2.0), None), ((0, 0.99, 3.0), None), ((0, 2.0, 2.5), (2, 0.5))],
)
def test_more_requests_than_declared_are_found(
    requests: Sequence[float], found: tuple[int, float] | None
) -> None:
    """The declared number of requests is one in each tick. The first of two requests can be late.
    Therefore the time between the two requests can be a little shorter than a tick."""
    (bound,) = with_responses([context("edge", 1_000, 1, entries=1)])
    times = [round(ms * NANOSECONDS) for ms in requests]
    recording = Recording(
        [Activation(17, 1, at, at, at, -1) for at in times],
        [Span("edge", at, at, 0, number, -1) for number, at in enumerate(times)],
    )
    assert too_many(bound, ["edge"], recording) == found


def test_a_request_that_waits_counts_when_it_falls_into_one_more_window() -> None:
    """The interrupt ``edge`` has one request in each tick, and the cycle is shorter than a tick. If
    the sum of the cycle and of the waiting time of a request is longer than a tick, two requests
    delay the cycle. Otherwise, one request delays it."""
    waits = context("edge", 20_000, 1, entries=1)
    alone = [context("thread", 70_000, 12), waits]
    assert cycle_response(alone, noise=False) == 70_000 + 2 * (20_000 + RETRY)
    assert cycle_response([context("thread", 50_000, 12), waits], noise=False) == (
        50_000 + 20_000 + RETRY
    )


def test_an_activation_does_not_cost_the_methods_that_it_does_not_call(tmp_path: Path) -> None:
    times = times_of(tmp_path, DeclaredFacts())
    times.use_body("")
    whole = times.of("run")
    times.use_body("", without=["Halt::execute"])
    assert whole - times.of("run") == longest(times.codes["halt"], ROUNDS)


def test_a_fact_limits_the_rounds_of_a_callee(tmp_path: Path) -> None:
    """An iteration costs a subtraction and a jump. All other costs are the same for 0 and for 5
    iterations."""
    costs = []
    for rounds in (0, 5):
        spread = Spread("Halt::execute", "Thread::run", counter="rounds")
        flows = {"Thread::run": [Inequality({"rounds": 1}, rounds)]}
        times = times_of(tmp_path, DeclaredFacts(spread=[spread], flows=flows))
        costs.append(times.of("run"))
        assert not times.unbound
    assert costs[1] - costs[0] == 5 * (2 + REFILL)


def test_two_loops_of_a_function_without_a_bound_are_in_order() -> None:
    places = {("run", ("b.cpp", 2)), ("halt", ("b.cpp", 9)), ("run", ("a.cpp", 7))}
    assert [(name, str(place.file)) for name, place in in_order(places)] == [
        ("halt", "b.cpp"),
        ("run", "a.cpp"),
        ("run", "b.cpp"),
    ]


def test_an_interrupt_that_takes_all_the_time_has_no_bound() -> None:
    contexts = [context("thread", 1_000, 12), context("edge", CLOCK, 1, entries=1)]
    assert cycle_response(contexts, noise=False) == float("inf")
