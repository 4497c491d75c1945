"""Executed lines and branches follow from the counters of gcc."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from traceability.reading.gcov_arcs import Graph, read_graphs

# Inlined always, so that its lines are in the graphs of others.
HEADER = """\
[[gnu::always_inline]] inline bool positive(int value) {
  return value > 0;
}
"""
# The lines of `choose`, from 1.
SOURCE = """\
int choose(int value) {
  int found = 0;
  if (value > 0) {
    found = 1;
  } else {
    found = 2;
  }
  for (int i = 0; i < value; ++i) {
    ++found;
  }
  return found;
}
#include "positive.hpp"
int both(int value) {
  return positive(value)
      && value < 9;
}
extern "C" void __gcov_dump();
int main(int count, char**) {
  const int found = choose(count - 2) + both(count - 2);
  __gcov_dump();
  return found;
}
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("flow")
    (folder / "choose.cpp").write_text(SOURCE)
    (folder / "positive.hpp").write_text(HEADER)
    words = ["g++", "-O0", "--coverage", "-c", "choose.cpp", "-o", "choose.o"]
    subprocess.run(words, cwd=folder, check=True)
    subprocess.run(["g++", "--coverage", "choose.o", "-o", "choose"], cwd=folder, check=True)
    return folder


def run(folder: Path, *words: str) -> dict[int, tuple[int, ...]]:
    """Number of each function that ran -> its counters, out of what gcc writes at the end."""
    (folder / "choose.gcda").unlink(missing_ok=True)
    subprocess.run([folder / "choose", *words], cwd=folder, check=False)
    data = (folder / "choose.gcda").read_bytes()
    found: dict[int, tuple[int, ...]] = {}
    number, at = 0, 16
    while at + 8 <= len(data):
        tag = int.from_bytes(data[at : at + 4], "little")
        length = int.from_bytes(data[at + 4 : at + 8], "little", signed=True)
        begin, at = at + 8, at + 8 + max(length, 0)
        if tag == 0x01000000 and length:
            number = int.from_bytes(data[begin : begin + 4], "little")
        elif tag == 0x01A10000 and length > 0:
            values = range(begin, at, 8)
            found[number] = tuple(int.from_bytes(data[i : i + 8], "little") for i in values)
    return found


def graph_of(folder: Path, line: int) -> tuple[int, Graph]:
    """The function that has a line of the source."""
    graphs = read_graphs(folder / "choose.gcno")
    return next((n, g) for n, g in graphs.items() if line in g.whole().lines.get("choose.cpp", ()))


@pytest.mark.parametrize(
    ("words", "missed", "taken"),
    [
        (["a", "b", "c"], {6}, {(3, 0), (8, 0), (8, 1)}),
        ([], {4, 9}, {(3, 1), (8, 1)}),
    ],
)
def test_lines_and_branches_that_ran(
    program: Path, words: list[str], missed: set[int], taken: set[tuple[int, int]]
) -> None:
    number, graph = graph_of(program, 4)
    whole, found = graph.whole(), graph.executed(run(program, *words)[number])
    assert whole.lines["choose.cpp"] - found.lines["choose.cpp"] == missed
    assert len(whole.branches["choose.cpp"]) == 4
    branches = found.branches["choose.cpp"]
    assert len(branches) == len(taken)
    assert {line for line, _ in branches} == {line for line, _ in taken}


def test_lines_of_an_inlined_function_are_those_of_its_file(program: Path) -> None:
    number, graph = graph_of(program, 15)
    assert graph.whole().lines == {"choose.cpp": {14, 15, 16}, "positive.hpp": {2}}
    assert graph.executed(run(program, "a", "b", "c")[number]).lines["positive.hpp"] == {2}
