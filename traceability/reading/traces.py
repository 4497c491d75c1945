"""Reads the recorded calls of each test, and searches for the declared invocation trees in these
recordings."""

from __future__ import annotations

import functools
import hashlib
import os
import re
from array import array
from collections.abc import Callable, Iterator, Set
from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.products import PAPER, recorded_image_of
from traceability.reading.programs import output_of
from traceability.reading.result_cache import cached_result, code_of
from traceability.reading.results import RESULTS, RUNS
from traceability.schema import HOST, VIRTUAL_K64, TraceRow, TreeNode
from traceability.sources import file_hash


@dataclass(frozen=True)
class Source:
    """The inputs for the recordings of a target: the folder with the recordings, and the executable
    with the symbols of the recorded functions."""

    executable: Path
    folder: Path
    names: str  # program that lists the symbols of the executable


SOURCES = {
    HOST: Source(Path("build/trace/tests/firmware_tests"), Path("build/trace/traces"), "nm"),
    VIRTUAL_K64: Source(
        recorded_image_of(PAPER, ".elf"), Path("build/host/traces-board"), "arm-none-eabi-nm"
    ),
}
EXIT = 1 << 63
# An event with this bit represents repeated calls. The other bits are the number of the earlier
# event at which the same calls begin.
REPEAT = 1 << 62
SHOWN = 60


@dataclass(slots=True)
class Row:
    """A call in a recording. The rows after this row and before the row ``end`` are calls inside
    this call, or calls of interrupts.

    Each execution of an interrupt has a different ``activation``. The code outside interrupts has
    the activation 0."""

    depth: int
    method: str
    parent: int
    end: int = 0
    activation: int = 0


@dataclass
class Traces:
    """All recordings of a target, with the symbols for reading them."""

    folder: Path
    state: str = ""  # hash that identifies the recordings and the executable
    # address -> name of the method or function
    symbols: dict[int, str] = field(default_factory=dict)
    vectors: set[str] = field(default_factory=set)  # names of the functions that the hardware calls
    tests: set[str] = field(default_factory=set)

    def file(self, test: str) -> Path:
        return self.folder / f"{test}.bin"

    def events(self, test: str) -> array[int]:
        events: array[int] = array("Q")
        data = self.file(test).read_bytes()
        events.frombytes(data[: len(data) - len(data) % 8])
        return events

    def calls(
        self, test: str, names: dict[int, str], turning: Set[int] = frozenset()
    ) -> Iterator[tuple[str, bool]]:
        """Yields each entry and exit of the named functions in the order of time. Yields (name,
        True) for an entry, and (name, False) for an exit.

        ``turning`` contains addresses of functions. If a repeated sequence of calls contains no
        call of these functions, it is yielded only once. It can be yielded again after the next
        call of one of these functions."""
        events = self.events(test)
        calls = {address: [(name, True)] for address, name in names.items()}
        calls |= {address | EXIT: [(name, False)] for address, name in names.items()}
        quiet = set()
        for event in set(events):
            if event & REPEAT:
                again = list(_outermost(events, event & ~REPEAT))
                calls[event] = [call for event in again if event in calls for call in calls[event]]
                if not calls[event]:
                    del calls[event]
                elif turning.isdisjoint(again):
                    quiet.add(event)
        since: set[int] = set()
        for event in [event for event in events if event in calls]:
            if event in quiet:
                if event in since:
                    continue
                since.add(event)
            elif event & REPEAT or event in turning:
                since.clear()
            yield from calls[event]

    def functions(self, test: str) -> set[str]:
        """Returns the names of all functions, including methods, that a test executed."""
        return {self.symbols[at] for at in set(self.events(test)) if at in self.symbols}

    def methods(self, test: str) -> set[str]:
        """Returns the names of the methods that a test executed."""
        return {name for name in self.functions(test) if "::" in name}

    def addresses(self, methods: Set[str]) -> set[int]:
        return {address for address, name in self.symbols.items() if name in methods}

    def rows(self, test: str, shown: Set[int]) -> list[Row]:
        """Returns the calls of the functions at the addresses in ``shown``, in the order of
        time."""
        rows: list[Row] = []
        addresses = shown | self.addresses(self.vectors)
        addresses |= {at | EXIT for at in addresses}
        # Each element: index of the row, and the activation before the call. The index is -1 for a
        # handler that is not shown.
        open_calls: list[tuple[int, int]] = []
        depth, parent, activation, entries = 0, -1, 0, 0
        for event in [event for event in self.events(test) if event in addresses]:
            if event & EXIT:
                row, activation = open_calls.pop() if open_calls else (-1, activation)
                if row >= 0:
                    rows[row].end = len(rows)
                    depth -= 1
                    parent = rows[row].parent
            elif event in shown:
                rows.append(Row(depth, self.symbols[event], parent, activation=activation))
                parent = len(rows) - 1
                open_calls.append((parent, activation))
                depth += 1
            else:
                open_calls.append((-1, activation))
                entries += 1
                activation = entries
        for row, _ in open_calls:
            if row >= 0:
                rows[row].end = len(rows)
        return rows


def _outermost(events: array[int], begin: int) -> Iterator[int]:
    """Yields the events from the start of a call to its end, including all calls inside it."""
    depth = 0
    for event in events[begin:]:
        yield event
        depth += -1 if event & EXIT else 1
        if depth == 0:
            return


def read_traces(root: Path, cache: Path) -> dict[str, Traces]:
    by_target: dict[str, Traces] = {}
    for binding, source in SOURCES.items():
        traces = Traces(root / source.folder)
        tests = {path.name.removesuffix(".bin") for path in traces.folder.glob("*.bin")}
        # If there are no results, the tests are still running.
        done = (root / RESULTS / f"{RUNS[binding]}.json").exists()
        if tests and done and (root / source.executable).exists():
            cached = cache / f"symbols-{source.names}.pickle"
            traces.state = _state(traces.folder, root / source.executable)
            traces.symbols = read_symbols(root / source.executable, source.names, cached)
            traces.tests = tests
        by_target[binding] = traces
    return by_target


def _state(folder: Path, executable: Path) -> str:
    """Computes a hash of the executable and of the names, sizes and times of the recordings."""
    total = hashlib.sha256(file_hash(executable).encode())
    for entry in sorted(os.scandir(folder), key=lambda item: item.name):
        state = entry.stat()
        total.update(f"{entry.name}\0{state.st_size} {state.st_mtime_ns}\n".encode())
    return total.hexdigest()


def read_symbols(executable: Path, names: str, cache: Path) -> dict[int, str]:
    """Returns the name of the function at each address. For the K64, bit 0 is cleared, because this
    bit only marks the Thumb instruction set."""
    state = executable.stat()
    parts = [state.st_mtime_ns, state.st_size, *code_of("reading/traces")]
    return cached_result(cache, parts, functools.partial(_symbols, executable, names))


def _symbols(executable: Path, names: str) -> dict[int, str]:
    symbols: dict[int, str] = {}
    even = 0 if names == "nm" else 1
    for line in output_of(names, "-C", executable).splitlines():
        match = re.match(r"([0-9a-f]+) [tTwWuV] (.*)", line)
        name = match and (
            method_of(match[2]) or function_of(match[2]) or free_function_of(match[2])
        )
        if match and name:
            symbols[int(match[1], 16) & ~even] = name
    return symbols


@functools.cache
def method_of(symbol: str) -> str:
    """Returns ``Pipe::write`` for ``wr::Pipe<int>::write(int const&)``. The result is empty for
    other symbols."""
    if "{lambda" in symbol or not re.match(r"(?:[\w:<>,&* ]+ )?wr::", symbol):
        return ""
    text, depth = "", 0
    for letter in symbol.replace("(anonymous namespace)::", "").replace("operator()", "operator"):
        if letter == "<":
            depth += 1
        elif letter == ">":
            depth -= 1
        elif letter == "(" and depth == 0:
            break
        elif depth == 0:
            text += letter
    name = text.split(" ")[-1]
    return name.removeprefix("wr::") if name.startswith("wr::") and "::" in name[4:] else ""


def function_of(symbol: str) -> str:
    """Returns ``cycleTimerInterrupt`` for ``cycleTimerInterrupt()``. The result is empty for other
    symbols."""
    match = re.fullmatch(r"(?:wr::)?(\w+)(?:\(\))?", symbol)
    return match[1] if match else ""


def free_function_of(symbol: str) -> str:
    """Returns ``part`` for ``int wr::(anonymous namespace)::part<4>(int)``. The result is empty for
    other symbols."""
    pattern = r"(?:[^()]* )?wr::(?:\(anonymous namespace\)::)?(\w+)(?:<.*>)?\("
    match = None if "{lambda" in symbol else re.match(pattern, symbol)
    return match[1] if match else ""


@dataclass
class Embedding:
    """The result of the search for an invocation tree in a recording. ``rows`` contains a row for
    each node. If the search failed, ``failed`` is the first node without a row."""

    rows: dict[int, int] = field(default_factory=dict)  # id() of the node -> number of the row
    failed: TreeNode | None = None


def embed(tree: TreeNode, rows: list[Row], accepts: Callable[[TreeNode], set[str]]) -> Embedding:
    """Searches for an invocation tree in the rows of a recording. The call of a child must be
    inside the call of its parent. The calls of the children must have the order of the tree.

    If an interrupt occurs during the call of the parent, the calls by this interrupt are not
    regarded as calls of the parent. After a post, the posted method may run later, and in another
    activation."""
    order = {id(node): number for number, node in enumerate(nodes_of(tree))}
    names = {id(node): accepts(node) for node in nodes_of(tree)}
    reached = tree

    def fit(node: TreeNode, start: int, stop: int, activation: int | None) -> dict[int, int] | None:
        nonlocal reached
        if order[id(node)] > order[id(reached)]:
            reached = node
        for index in range(start, stop):
            if rows[index].method not in names[id(node)]:
                continue
            if activation is not None and rows[index].activation != activation:
                continue
            placed = {id(node): index}
            position = index + 1
            for child in node.children:
                if not child.children and not names[id(child)]:
                    # No recording can contain this node, because its method does not exist on this
                    # target.
                    continue
                if child.kind == "post":
                    matched = fit(child, position, len(rows), None)
                else:
                    matched = fit(child, position, rows[index].end, rows[index].activation)
                if matched is None:
                    break
                placed |= matched
                position = rows[matched[id(child)]].end
            else:
                return placed
        return None

    matched = fit(tree, 0, len(rows), None)
    return Embedding(matched, None) if matched is not None else Embedding({}, reached)


def nodes_of(tree: TreeNode | None) -> list[TreeNode]:
    """Returns the nodes of an invocation tree, beginning at the root."""
    if tree is None:
        return []
    return [tree, *(node for child in tree.children for node in nodes_of(child))]


def excerpt(rows: list[Row], placed: list[int]) -> tuple[list[TraceRow], int, dict[int, int]]:
    """Returns a part of a recording for the page: the rows of the tree and some rows around them,
    about ``SHOWN`` rows in all. Also returns the index of the first row, and the new number of each
    remaining row."""
    first = placed[0]
    last = max(rows[index].end for index in placed)
    while rows[first].parent >= 0 and rows[rows[first].parent].end - rows[first].parent <= SHOWN:
        first = rows[first].parent
        last = max(last, rows[first].end)
    needed: set[int] = set()
    for place in placed:
        above = place
        while above >= first and above not in needed:
            needed.add(above)
            above = rows[above].parent
    window = list(range(first, last))
    depth = max(rows[index].depth for index in window)
    while len(window) > SHOWN and depth > rows[first].depth:
        window = [index for index in window if index in needed or rows[index].depth < depth]
        depth -= 1
    base = rows[first].depth
    if len(window) > SHOWN:
        end = max(placed) + 1
        window = [index for index in window if index in needed or index < end]
        free = [index for index in window if index not in needed]
        surplus = set(free[max(0, SHOWN - len(needed)) :])
        window = [index for index in window if index not in surplus]
    shown = [
        TraceRow(rows[index].depth - base, rows[index].method, rows[index].method.split("::")[0])
        for index in window
    ]
    return shown, first, {index: number for number, index in enumerate(window)}
