"""Reads the source lines and branches that each test executed on the host.

gcc writes the flow graph of each function next to the object files. An arc of this graph is a step
from one block of instructions to another. The program counts only some arcs. The counts of the
other arcs are computed from a rule: the program leaves each block as often as it enters the block.
"""

from __future__ import annotations

import functools
import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

FUNCTION, BLOCKS, ARCS, LINES = 0x01000000, 0x01410000, 0x01430000, 0x01450000
# number of bytes at the beginning of the file: kind of file, version and two check sums
HEADER = 16
ON_TREE, FAKE = 1, 2

Line = tuple[str, int]  # file and line number
Branch = tuple[int, int]  # line number, and number of the branch in this line
Part = TypeVar("Part")


@dataclass
class Covered:
    """Sets of source lines and branches, by file."""

    lines: dict[str, set[int]] = field(default_factory=dict)
    branches: dict[str, set[Branch]] = field(default_factory=dict)

    def add(self, file: str, lines: set[int], branches: set[Branch]) -> None:
        self.lines.setdefault(file, set()).update(lines)
        self.branches.setdefault(file, set()).update(branches)

    def merge(self, other: Covered) -> None:
        _merge(self.lines, other.lines)
        _merge(self.branches, other.branches)


def _merge(total: dict[str, set[Part]], others: dict[str, set[Part]]) -> None:
    for file, parts in others.items():
        if file in total:
            total[file] |= parts
        else:
            total[file] = set(parts)


@dataclass
class Arc:
    source: int
    target: int
    counted: bool
    fake: bool


@dataclass
class Graph:
    """The flow graph of a function: its arcs, and the source lines of each block. If a block
    contains an inlined function, it can have source lines of another file."""

    arcs: list[Arc] = field(default_factory=list)
    lines: dict[int, list[Line]] = field(default_factory=dict)  # block -> source lines

    def solve(self, counters: tuple[int, ...]) -> list[int]:
        """Returns the number of times that the program took each arc."""
        given = iter(counters)
        taken: list[int | None] = [next(given, 0) if arc.counted else None for arc in self.arcs]
        leaving, entering = self._sides()
        totals: dict[int, int] = {}
        pending = True
        while pending:
            pending = False
            for side in (leaving, entering):
                for block, arcs in side.items():
                    open_arcs = [number for number in arcs if taken[number] is None]
                    if not open_arcs and block not in totals:
                        totals[block] = sum(taken[number] or 0 for number in arcs)
                        pending = True
                    elif len(open_arcs) == 1 and block in totals:
                        flow = sum(taken[number] or 0 for number in arcs)
                        taken[open_arcs[0]] = totals[block] - flow
                        pending = True
        return [count or 0 for count in taken]

    def _sides(self) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
        leaving: dict[int, list[int]] = {}
        entering: dict[int, list[int]] = {}
        for number, arc in enumerate(self.arcs):
            leaving.setdefault(arc.source, []).append(number)
            entering.setdefault(arc.target, []).append(number)
        return leaving, entering

    @functools.cached_property
    def branches(self) -> dict[int, tuple[str, Branch]]:
        """Returns the file and the branch of each arc that belongs to a branch. If several arcs
        leave a block, the block ends with a branch, and these arcs belong to the last source line
        of the block."""
        leaving, _ = self._sides()
        branches: dict[int, tuple[str, Branch]] = {}
        seen: dict[Line, int] = {}
        for block, lines in sorted(self.lines.items()):
            last = max(line for line in lines if line[0] == lines[-1][0])
            real = [number for number in leaving.get(block, []) if not self.arcs[number].fake]
            for number in real if len(real) > 1 else []:
                branches[number] = (last[0], (last[1], seen.get(last, 0)))
                seen[last] = seen.get(last, 0) + 1
        return branches

    def whole(self) -> Covered:
        """Returns all source lines and branches of the function."""
        return self._covered(self.lines, self.branches)

    def executed(self, counters: tuple[int, ...]) -> Covered:
        taken = self.solve(counters)
        blocks = {
            block
            for arc, count in zip(self.arcs, taken, strict=True)
            for block in (arc.source, arc.target)
            if count
        }
        return self._covered(blocks, [number for number in self.branches if taken[number]])

    def _covered(self, blocks: Iterable[int], arcs: Iterable[int]) -> Covered:
        covered = Covered()
        for block in blocks:
            for file, line in self.lines.get(block, []):
                covered.add(file, {line}, set())
        for number in arcs:
            file, branch = self.branches[number]
            covered.add(file, set(), {branch})
        return covered


def read_graphs(path: Path) -> dict[int, Graph]:
    """Reads the flow graphs of an object file. Returns them by the numbers of their functions."""
    graphs: dict[int, Graph] = {}
    graph, file = Graph(), ""
    for tag, words in records(path.read_bytes()):
        if tag == FUNCTION:
            number, _, _ = words.numbers(3)
            words.text()  # name
            artificial = words.number()
            graph, file = Graph(), words.text()
            if not artificial:
                graphs[number] = graph
        elif tag == ARCS:
            source = words.number()
            while words.left():
                target, flags = words.numbers(2)
                graph.arcs.append(Arc(source, target, not flags & ON_TREE, bool(flags & FAKE)))
        elif tag == LINES:
            block = words.number()
            if lines := list(lines_of(words, file)):
                graph.lines[block] = lines
    return graphs


class Words:
    """A reader for the content of a record. A number has four bytes. The length of a text is stored
    before the text."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0

    def left(self) -> bool:
        return self.at < len(self.data)

    def number(self) -> int:
        return self.numbers(1)[0]

    def numbers(self, count: int) -> tuple[int, ...]:
        values = struct.unpack_from(f"<{count}I", self.data, self.at)
        self.at += 4 * count
        return values

    def text(self) -> str:
        length = self.number()
        text = self.data[self.at : self.at + length]
        self.at += length
        return text.rstrip(b"\0").decode()


def records(data: bytes) -> Iterator[tuple[int, Words]]:
    start = Words(data[HEADER:])
    start.text()  # the folder in which the compiler ran
    at = HEADER + start.at + 4
    while at + 8 <= len(data):
        tag, length = struct.unpack_from("<II", data, at)
        yield tag, Words(data[at + 8 : at + 8 + length])
        at += 8 + length


def lines_of(words: Words, file: str) -> Iterator[Line]:
    """Yields the source lines of a block from a record."""
    while words.left():
        if line := words.number():
            yield file, line
        elif words.left():
            file = words.text() or file
