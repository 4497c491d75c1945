"""The mutated build: a copy of the sources that contains all mutants. Each mutant has its
number."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TextIO

from clang import cindex

from tools.cmake_build import copy_sources, jobs
from tools.mutation.points import Mutant, Point, compiler_arguments, find_points
from tools.steps import FailureError, run
from traceability.reading.translation_units import is_board, translation_units
from traceability.sources import DESIGN

FOLDER = Path("build/mutation")
SOURCE, BINARY, LIST = FOLDER / "source", FOLDER / "binary", FOLDER / "mutants.json"
SWITCH = Path(__file__).with_name("mutant.hpp")
PROGRAM = BINARY / "tests" / "firmware_tests"
ATTEMPTS = 10


def write_switched(root: Path, log: TextIO) -> list[Mutant]:
    """Writes the copy with the mutants of the firmware and its extensions. The parts for the K64
    alone get no mutants. Returns the mutants, whose numbers begin at 1.

    If a mutant does not compile, it is omitted. For example, if C++ demands a constant expression,
    a mutant of a sum in this expression does not compile."""
    texts: dict[str, str] = {}
    mutants: list[Mutant] = []
    for unit, files in translation_units(root).items():
        if is_board(unit) or not unit.startswith(DESIGN):
            continue
        found = find_points(root, unit, files)
        if not found:
            continue
        first = len(mutants) + 1
        changed, held = compiling(root, unit, found, first, log)
        texts |= changed
        mutants += held
    copy_sources(root, root / SOURCE, texts)
    (root / LIST).write_text(json.dumps([asdict(mutant) for mutant in mutants]), encoding="utf-8")
    return mutants


def compiling(
    root: Path, unit: str, found: dict[str, list[Point]], first: int, log: TextIO
) -> tuple[dict[str, str], list[Mutant]]:
    """Returns the changed texts of a unit. The changes are only at the points that compile. Also
    returns the mutants of these points."""
    for _ in range(ATTEMPTS):
        held = [mutant for points in found.values() for point in points for mutant in point.mutants]
        numbers = iter(range(first, first + len(held)))
        texts = {file: switched(root / file, points, numbers) for file, points in found.items()}
        bad = errors(root, unit, texts)
        if not bad:
            return texts, held
        for file, line, words in bad:
            log.write(f"{file}:{line}: no mutants here: {words}\n")
        lines = {(file, line) for file, line, _ in bad}
        found = {
            file: [one for one in points if not lines & _lines(root / file, file, one)]
            for file, points in found.items()
        }
    raise FailureError(f"the mutants of {unit} do not compile")


def _lines(path: Path, file: str, point: Point) -> set[tuple[str, int]]:
    text = path.read_bytes()
    first, last = (text.count(b"\n", 0, at) + 1 for at in (point.start, point.end))
    return {(file, line) for line in range(first, last + 1)}


def switched(path: Path, points: list[Point], numbers: Iterator[int]) -> str:
    """Returns the text with a wrapper around each point."""
    text = path.read_bytes()
    edits: list[tuple[tuple[int, int, int], int, int, str]] = []
    for order, point in enumerate(points):
        number, *_ = [next(numbers) for _ in point.mutants]
        length = point.end - point.start
        # Two parts can meet at one position. At this position, the end of the wrapper of the first
        # part is inserted first. Then the beginning of the wrapper of the second part is inserted.
        before = (point.start, 1, order)
        after = (point.end, 0, -order)
        if length == 0:
            before = (point.start, 0, order)
        edits.append((before, point.start, point.start, point.before.replace("#", str(number))))
        edits.append((after, point.end, point.end, point.after))
        if point.inside:
            edits.append(((point.cut[0], 1, order), *point.cut, point.inside))
    result, at = b"", 0
    for _, start, end, words in sorted(edits):
        result += text[at:start] + words.encode()
        at = end
    return (result + text[at:]).decode()


def errors(root: Path, unit: str, texts: dict[str, str]) -> list[tuple[str, int, str]]:
    """Returns the file, the line and the message of each error in a unit with changed texts."""
    arguments = [*compiler_arguments(root), "-include", str(SWITCH)]
    unsaved = [(str(root / file), text) for file, text in texts.items()]
    tree = cindex.Index.create().parse(str(root / unit), args=arguments, unsaved_files=unsaved)
    found: list[tuple[str, int, str]] = []
    for problem in tree.diagnostics:
        if problem.severity < cindex.Diagnostic.Error or not problem.location.file:
            continue
        # If the error is in mutant.hpp, a note shows the place of the call. libclang also reports
        # errors without a file. These errors are from parsed headers, and are ignored.
        places = [problem.location, *(child.location for child in problem.children)]
        for place in places:
            if place.file and str(Path(place.file.name)) in {name for name, _ in unsaved}:
                file = str(Path(place.file.name).relative_to(root))
                found.append((file, place.line, problem.spelling))
                break
        else:
            raise FailureError(f"{unit}: {problem.spelling}")
    return found


def build_switched(root: Path, log: TextIO) -> None:
    """Builds the tests for this computer from the copy."""
    flags = f"-O1 -w -include {SWITCH}"
    words: list[str | Path] = ["cmake", "-S", root / SOURCE, "-B", root / BINARY, "-G", "Ninja"]
    words += ["-DCMAKE_CXX_COMPILER=g++", f"-DCMAKE_CXX_FLAGS={flags}", "-DWR_WERROR=OFF"]
    run(log, words)
    run(log, ["cmake", "--build", root / BINARY, "--parallel", jobs(), "--target", PROGRAM.name])
