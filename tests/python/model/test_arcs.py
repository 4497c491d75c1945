"""Executed lines and branches follow from the counters of gcc."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from traceability.model.arcs import Graph, read_graphs

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
extern "C" void __gcov_dump();
int main(int count, char**) {
  const int found = choose(count - 2);
  __gcov_dump();
  return found;
}
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("flow")
    (folder / "choose.cpp").write_text(SOURCE)
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


def graph_of_choose(folder: Path) -> tuple[int, Graph]:
    graphs = read_graphs(folder / "choose.gcno")
    return next((n, g) for n, g in graphs.items() if 4 in {x for b in g.lines.values() for x in b})


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
    number, graph = graph_of_choose(program)
    lines, branches = graph.executed(run(program, *words)[number])
    everything = {line for block in graph.lines.values() for line in block}
    assert everything - lines == missed
    assert len(set(graph.branches.values())) == 4
    assert len(branches) == len(taken)
    assert {line for line, _ in branches} == {line for line, _ in taken}


def test_the_graph_names_its_file(program: Path) -> None:
    assert graph_of_choose(program)[1].file.endswith("choose.cpp")
