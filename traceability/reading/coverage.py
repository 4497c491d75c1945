"""The source lines and branches of the design that each test executed, on the host and on the
virtual K64.

On the host, the counters of gcc show the executed lines and branches: see gcov_arcs.py. On the
virtual K64, each test writes one bit for each half-word of memory. These bits show the executed
lines, but no branches: see board_coverage.py."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.board_coverage import ELF, lines_executed, read_stretches
from traceability.reading.gcov_arcs import Covered, Graph, read_graphs
from traceability.reading.result_cache import cached_result, code_of
from traceability.reading.results import RESULTS, RUNS, run_hash
from traceability.reading.traces import SOURCES
from traceability.schema import HOST, VIRTUAL_K64
from traceability.sources import DESIGN

CODE = ("reading/coverage", "reading/gcov_arcs", "reading/board_coverage")
HOST_BUILD = SOURCES[HOST].executable.parents[1]
# Build folders of the programs that do not belong to the test program of the firmware. Code that is
# only in these programs is ignored.
OTHER_PROGRAMS = r".*/(usual_design_tests|change_\w+_tests|weeding_robot_host)\.dir"


@dataclass
class Coverage:
    """The executable code of a target, and for each recording the part of this code that was
    executed."""

    whole: Covered = field(default_factory=Covered)
    recordings: dict[str, Covered] = field(default_factory=dict)

    @property
    def branched(self) -> bool:
        """Returns whether the target records branches."""
        return any(self.whole.branches.values())

    def of(self, recordings: Iterable[str]) -> Covered:
        """Returns the code that was executed in at least one of these recordings."""
        union = Covered()
        for name in recordings:
            if name in self.recordings:
                union.merge(self.recordings[name])
        return union

    @functools.cached_property
    def all(self) -> Covered:
        """Returns the code that was executed in at least one recording of the target."""
        return self.of(self.recordings)


def read_coverage(root: Path, cache: Path) -> dict[str, Coverage]:
    """Returns the coverage of each target from the last run of its tests."""
    readers = {HOST: _read_host, VIRTUAL_K64: _read_board}
    coverages: dict[str, Coverage] = {}
    for binding, reader in readers.items():
        if not (root / RESULTS / f"{RUNS[binding]}.json").exists():
            coverages[binding] = Coverage()  # The tests never ran, or they are running.
            continue
        # A test run, or a change of the code of this reader, makes the cached coverage invalid.
        parts = [run_hash(root, binding), *code_of(*CODE)]
        cached = cache / f"coverage-{RUNS[binding]}.pickle"
        coverages[binding] = cached_result(cached, parts, functools.partial(reader, root))
    return coverages


def _read_host(root: Path) -> Coverage:
    coverage = Coverage()
    files = sorted((root / SOURCES[HOST].folder).glob("*.arcs"))
    if not files:
        return coverage
    units = {
        path.with_suffix(""): read_graphs(path)
        for path in (root / HOST_BUILD).rglob("*.gcno")
        if not re.match(f"{OTHER_PROGRAMS}/", str(path))
    }
    for graphs in units.values():
        for graph in graphs.values():
            coverage.whole.merge(_of_design(root, graph.whole()))
    # The counters of a function are evaluated only once. Other tests with the same counters use the
    # stored result.
    solved: dict[tuple[Path, str], Covered] = {}
    for path in files:
        covered = coverage.recordings[path.name.removesuffix(".arcs")] = Covered()
        unit = Path()
        for line in path.read_text(encoding="utf-8").splitlines():
            if not line[0].isdigit():
                unit = Path(line).with_suffix("")
                continue
            if (unit, line) not in solved:
                solved[unit, line] = _executed(root, units.get(unit, {}), line)
            covered.merge(solved[unit, line])
    return coverage


def _executed(root: Path, graphs: dict[int, Graph], line: str) -> Covered:
    number, *counters = map(int, line.split())
    graph = graphs.get(number)
    return Covered() if graph is None else _of_design(root, graph.executed(tuple(counters)))


def _of_design(root: Path, covered: Covered) -> Covered:
    """Returns the coverage of the files that belong to the design. Their paths become relative to
    the root."""
    own = Covered()
    for path, lines in covered.lines.items():
        if file := design_file(root, path):
            own.add(file, lines, covered.branches[path])
    return own


@functools.cache
def design_file(root: Path, file: str) -> str:
    """Returns the path of a design file relative to the root. Returns "" for a file outside the
    design."""
    path = Path(file)
    if not path.is_relative_to(root):
        return ""
    below = path.relative_to(root)
    return str(below) if below.parts[0] in DESIGN else ""


def _read_board(root: Path) -> Coverage:
    coverage = Coverage()
    files = sorted((root / SOURCES[VIRTUAL_K64].folder).glob("*.bits"))
    if not files or not (root / ELF).is_file():
        return coverage
    stretches = read_stretches(root)
    for file, line, _, _ in stretches:
        coverage.whole.add(file, {line}, set())
    for path in files:
        covered = coverage.recordings[path.name.removesuffix(".bits")] = Covered()
        for file, lines in lines_executed(stretches, path.read_bytes()).items():
            covered.add(file, {line for line, hit in lines.items() if hit}, set())
    return coverage
