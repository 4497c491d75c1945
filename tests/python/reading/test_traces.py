"""Recorded calls, and the search for invocation trees in these calls."""

from __future__ import annotations

import struct
from collections.abc import Set
from pathlib import Path

import pytest

from traceability.reading.traces import (
    EXIT,
    REPEAT,
    Row,
    Traces,
    embed,
    excerpt,
    free_function_of,
    method_of,
)
from traceability.schema import Place, TreeNode


@pytest.mark.parametrize(
    ("symbol", "method"),
    [
        ("wr::RC::read(wr::MainController&)", "RC::read"),
        ("wr::Pipe<wr::Quantity<wr::Tag, int> >::write(int const&, wr::Instant)", "Pipe::write"),
        ("wr::MainController::Cycle::execute()", "MainController::Cycle::execute"),
        ("wr::RC::newMessage() const", "RC::newMessage"),
        ("wr::MainController::MainController(wr::Mode&)", "MainController::MainController"),
        ("void wr::Pipe<int>::each<long>(long)", "Pipe::each"),
        ("wr::Instant::operator<=>(wr::Instant) const", ""),
        ("std::array<wr::Mode*, 2ul>::begin()", ""),
        ("wr::assertionFailed(wr::AssertId)", ""),
        ("wr::RC::read()::{lambda()#1}::operator()() const", ""),
    ],
)
def test_symbols(symbol: str, method: str) -> None:
    found = method_of(symbol)
    assert found == method or (not method and "operator" in found)


@pytest.mark.parametrize(
    ("symbol", "function"),
    [
        ("wr::(anonymous namespace)::lasts(bool, unsigned char&, unsigned char)", "lasts"),
        ("std::array<int, 4ul> wr::(anonymous namespace)::digits<4ul>(unsigned long)", "digits"),
        ("wr::assertionFailed(wr::AssertId)", "assertionFailed"),
        ("wr::RC::read(wr::MainController&)", ""),
        ("wr::(anonymous namespace)::lasts(bool)::{lambda()#1}::operator()() const", ""),
    ],
)
def test_symbols_of_functions_outside_classes(symbol: str, function: str) -> None:
    assert free_function_of(symbol) == function


def recorded(tmp_path: Path, calls: str, vectors: Set[str] = frozenset()) -> list[Row]:
    """Writes calls such as ``a(b c(d))`` as events, and reads the events back."""
    traces = Traces(tmp_path)
    addresses: dict[str, int] = {}
    events: list[int] = []
    stack: list[int] = []
    for word in calls.replace("(", " ( ").replace(")", " ) ").split():
        if word == "(":
            continue
        if word == ")":
            events.append(stack.pop() | EXIT)
            continue
        address = addresses.setdefault(word, 4096 + len(addresses))
        events.append(address)
        stack.append(address)
    traces.symbols = {
        address: name if name in vectors else f"M::{name}" for name, address in addresses.items()
    }
    traces.vectors = set(vectors)
    file = traces.file("S.T")
    file.write_bytes(struct.pack(f"<{len(events)}Q", *events))
    methods = {f"M::{name}" for name in addresses} - {"M::x"}
    return traces.rows("S.T", traces.addresses(methods))


def test_functions_outside_classes_ran_but_are_no_methods(tmp_path: Path) -> None:
    traces = Traces(tmp_path, symbols={8: "M::examine", 9: "lasts"})
    events = [8, 9, 9 | EXIT, 8 | EXIT, 10, 10 | EXIT]
    traces.file("S.T").write_bytes(struct.pack(f"<{len(events)}Q", *events))
    assert traces.functions("S.T") == {"M::examine", "lasts"}
    assert traces.methods("S.T") == {"M::examine"}


def test_calls_that_are_written_as_a_repetition_are_told_again(tmp_path: Path) -> None:
    traces = Traces(tmp_path)
    events = [8, 9, 9 | EXIT, 8 | EXIT, 10, 10 | EXIT, REPEAT | 0, REPEAT | 4]
    traces.file("S.T").write_bytes(struct.pack(f"<{len(events)}Q", *events))
    calls = list(traces.calls("S.T", {9: "M::inner", 10: "M::other"}))
    inner, other = (
        [("M::inner", True), ("M::inner", False)],
        [("M::other", True), ("M::other", False)],
    )
    assert calls == [*inner, *other, *inner, *other]


def test_the_same_calls_are_told_again_only_after_one_that_may_change_something(
    tmp_path: Path,
) -> None:
    traces = Traces(tmp_path)
    tick, change = REPEAT | 0, REPEAT | 2
    events = [8, 8 | EXIT, 9, 9 | EXIT, tick, tick, change, tick, tick]
    traces.file("S.T").write_bytes(struct.pack(f"<{len(events)}Q", *events))
    calls = traces.calls("S.T", {8: "tick", 9: "change"}, turning={9})
    entered = [name for name, enters in calls if enters]
    assert entered == ["tick", "change", "tick", "change", "tick"]


def test_what_an_interrupt_calls_is_no_call_of_what_it_interrupted(tmp_path: Path) -> None:
    calls = "a(vector(b(c())) d())"
    plain = recorded(tmp_path, calls)
    assert fits(node("a(b)"), plain) is None
    apart = recorded(tmp_path, calls, vectors={"vector"})
    assert fits(node("a(b)"), apart) == "M::b"
    assert fits(node("a(>b)"), apart) is None
    assert fits(node("b(c)"), apart) is None
    assert fits(node("a(d)"), apart) is None


def node(text: str) -> TreeNode:
    """Returns calls such as ``a(b c(d))`` as a tree. In a node such as ``>b``, the method ``b`` is
    not called: a thread executes ``b`` after a post."""
    place = Place("t.tree", 1)
    stack: list[TreeNode] = []
    root: TreeNode | None = None
    last: TreeNode | None = None
    for word in text.replace("(", " ( ").replace(")", " ) ").split():
        if word == "(":
            assert last is not None
            stack.append(last)
        elif word == ")":
            stack.pop()
        else:
            kind = "post" if word.startswith(">") else "call"
            method = f"M::{word.removeprefix('>')}"
            last = TreeNode(method, "M", word, method, kind, place)
            if stack:
                stack[-1].children.append(last)
            root = root or last
    assert root is not None
    return root


def fits(tree: TreeNode, rows: list[Row]) -> str | None:
    found = embed(tree, rows, lambda one: {one.resolved or ""})
    return found.failed.label if found.failed else None


@pytest.mark.parametrize(
    ("tree", "calls", "failed"),
    [
        ("a(b c)", "a(b() c())", None),
        ("a(b c)", "a(c() b())", "M::c"),
        ("a(b(c))", "a(b() c())", "M::c"),
        ("a(b(c))", "a(d(b(d(c()))))", None),
        ("a(b)", "a() b()", "M::b"),
        ("a(>b)", "a() b()", None),
        ("a(>b)", "b() a()", "M::b"),
        ("a(b c)", "a(b(c()))", "M::c"),
        ("a(b)", "a() a(b())", None),
        ("a(b)", "c()", "M::a"),
    ],
)
def test_embedding(tmp_path: Path, tree: str, calls: str, failed: str | None) -> None:
    assert fits(node(tree), recorded(tmp_path, calls)) == failed


def test_excerpt_is_short_and_keeps_the_placed_rows(tmp_path: Path) -> None:
    many = " ".join("d(e())" for _ in range(100))
    rows = recorded(tmp_path, f"a({many} b({many} c()))")
    tree = node("a(b(c))")
    found = embed(tree, rows, lambda one: {one.resolved or ""})
    placed = sorted(found.rows.values())
    shown, first, numbers = excerpt(rows, placed)
    assert first == 0
    assert len(shown) <= 60
    assert [shown[numbers[index]].method for index in placed] == ["M::a", "M::b", "M::c"]
