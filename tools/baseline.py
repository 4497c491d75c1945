"""Measures the baseline design and the pattern design with the same tests, scenario, compiler and
flags."""

from __future__ import annotations

import bisect
import json
import os
import re
import subprocess
from collections import Counter, defaultdict
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from typing import Any, TextIO

import lizard

from tools.cmake_build import board_words, copy_sources, jobs
from tools.includes import included
from tools.sizes import Size, image_sizes, output, total
from tools.steps import FailureError, run
from traceability.model.image_code import read_program
from traceability.reading.baseline_record import (
    DESIGNS,
    FOLDER,
    PATTERNS,
    RESULT,
    SCENARIO,
    PartOfLine,
    changes_of,
    count_patch,
    patch_of,
    read_parts,
)
from traceability.reading.call_graph import table_bytes
from traceability.sources import SRC, files_below
from traceability.whole_file import write_json

TESTS = "usual_design_tests"
WORK = Path("build/usual_design")
MAIN = "main"  # the part of main.cpp; each design has a different main.cpp
STACK = "stack"
OTHER = ""  # the instructions that belong to no part, for example those of the compiler's library
SHORT, LONG = 2, 4  # bytes of an instruction
SYMBOL = re.compile(r"^([0-9a-f]+) [tTwW] (.+)$", re.MULTILINE)


def compare(root: Path, log: TextIO) -> None:
    """Compares the two designs, and writes build/results/usual_design.json."""
    run(log, [root / "build/host/tests/usual_design" / TESTS])
    runs = {design: measure_run(root, log, design) for design in DESIGNS}
    sizes = {design: image_sizes(image_of(root, design, ".elf")) for design in DESIGNS}
    figures = {
        design: {
            **run_figures(runs[design]),
            **size_figures(sizes[design], own_parts(sizes, design)),
            **source_figures(own_sources(root, sizes, design)),
        }
        for design in DESIGNS
    }
    functions = {
        design: instructions_by_function(
            runs[design], output("arm-none-eabi-nm", "--demangle", image_of(root, design, ".elf"))
        )
        for design in DESIGNS
    }
    result = {
        "cycles": len(runs[PATTERNS]["instructions"]),
        "figures": figures,
        "functions": functions,
        "parts": {design: costs_by_part(root, runs[design], design) for design in DESIGNS},
        "changes": {change: try_change(root, log, change) for change in changes_of(root)},
    }
    write_json(root / RESULT, result)


def image_name(design: str) -> str:
    return f"one_wheel_{design}"


def image_of(root: Path, design: str, suffix: str) -> Path:
    return root / "build/k64" / f"{image_name(design)}{suffix}"


# ---- instructions ------------------------------------------------------------


def measure_run(root: Path, log: TextIO, design: str) -> dict[str, Any]:
    """Plays the scenario on the virtual K64 with the firmware image of a design."""
    record = root / WORK / f"{design}.json"
    record.parent.mkdir(parents=True, exist_ok=True)
    record.unlink(missing_ok=True)
    words = board_words(root, image_of(root, design, ".bin"))
    run(log, [*words, "--scenario", root / SCENARIO, "--bench", record, "--profile"])
    measured: dict[str, Any] = json.loads(record.read_text(encoding="utf-8"))
    return measured


def run_figures(measured: dict[str, Any]) -> dict[str, float]:
    reports, cycles = measured["report_instructions"], measured["instructions"]
    return {
        "report_avg": sum(reports) / len(reports),
        "report_max": max(reports),
        "cycle_avg": sum(cycles) / len(cycles),
        "cycle_max": max(cycles),
        "stack": measured["stack_bytes"],
    }


def instructions_by_function(measured: dict[str, Any], symbols: str) -> dict[str, float]:
    """Returns the average number of instructions of each function in a cycle. The largest number is
    first."""
    starts = sorted({int(at, 16) & ~1: name for at, name in SYMBOL.findall(symbols)}.items())
    addresses = [at for at, _ in starts]
    counts: Counter[str] = Counter()
    for address, times in measured["profile"].items():
        place = bisect.bisect_right(addresses, int(address)) - 1
        counts[starts[place][1] if place >= 0 else "?"] += sum(times)
    cycles = len(measured["instructions"])
    return {name: count / cycles for name, count in counts.most_common()}


def costs_by_part(root: Path, measured: dict[str, Any], design: str) -> dict[str, list[float]]:
    """Returns two numbers for each part of the robot: the size of its instructions and virtual
    method tables [bytes], and the average number of instructions that the part executes in a
    cycle."""
    part_of = PartOfLine(root, read_parts(root))
    executed = {int(at): sum(times) for at, times in measured["profile"].items()}
    cycles = len(measured["instructions"])
    costs: dict[str, list[float]] = defaultdict(lambda: [0, 0.0])
    lines = sorted(read_program(image_of(root, design, ".elf")).places.items())
    for (address, places), (following, _) in pairwise([*lines, (lines[-1][0], [])]):
        part = next(filter(None, (part_of(file, line) for file, line in places)), OTHER)
        # An instruction has 2 or 4 bytes. Constants can follow the last instruction of a function.
        costs[part][0] += LONG if following - address >= LONG else SHORT
        costs[part][1] += executed.get(address, 0) / cycles
    headers = {path.stem: str(path) for path in files_below(root, (SRC,), (".hpp",))}
    for name, size in table_bytes(image_of(root, design, ".elf")).items():
        costs[part_of(headers.get(name.split("::")[0], ""), 1) or OTHER][0] += size
    return dict(costs)


# ---- flash and RAM -----------------------------------------------------------


def own_parts(sizes: dict[str, dict[str, Size]], design: str) -> set[str]:
    """Returns the part MAIN, and the parts that only this design has."""
    others = set().union(*(sizes[other] for other in sizes if other != design))
    return {part for part in sizes[design] if part not in others or part == MAIN}


def size_figures(sizes: dict[str, Size], own: Iterable[str]) -> dict[str, int]:
    whole = total({part: size for part, size in sizes.items() if part != STACK})
    alone = total({part: sizes[part] for part in own})
    return {
        "flash": whole.flash,
        "ram": whole.ram,
        "own_flash": alone.flash,
    }


# ---- complexity and lines ----------------------------------------------------


def own_sources(root: Path, sizes: dict[str, dict[str, Size]], design: str) -> list[Path]:
    """Returns the sources of the parts that only this design has. Also returns the headers that are
    included only in these sources."""
    closures = {name: included(root, sources_in(root, sizes, name)) for name in sizes}
    others = set().union(*(closures[name] for name in sizes if name != design))
    return sorted(closures[design] - others)


def sources_in(root: Path, sizes: dict[str, dict[str, Size]], design: str) -> list[Path]:
    """Returns the sources of the parts that only this design has."""
    own = own_parts(sizes, design)
    paths = files_below(root, (SRC, str(FOLDER / design)), (".cpp",))
    return [path for path in paths if path.stem in own - {MAIN}]


def source_figures(paths: list[Path]) -> dict[str, float]:
    """Returns the complexity and the number of source lines. Lizard computes both."""
    files = [lizard.analyze_file(str(path)) for path in paths]
    complexity = [
        function.cyclomatic_complexity for file in files for function in file.function_list
    ]
    return {
        "files": len(files),
        "lines": sum(file.nloc for file in files),
        "functions": len(complexity),
        "complexity_max": max(complexity),
        "complexity_mean": sum(complexity) / len(complexity),
        "complexity_sum": sum(complexity),
    }


# ---- likely changes ----------------------------------------------------------


def try_change(root: Path, log: TextIO, change: str) -> dict[str, Any]:
    """Applies the patches of a change to a copy of the project. In the copy, runs the tests of the
    change with both designs."""
    tree = root / WORK / "tree"
    copy_sources(root, tree)
    counts = {}
    for design in DESIGNS:
        patch = root / patch_of(change, design)
        apply(log, tree, patch)
        counts[design] = vars(count_patch(patch.read_text(encoding="utf-8")))
    program = f"change_{change}_tests"
    folder = tree.parent / "tree-build"
    configure: list[str | Path] = ["cmake", "-G", "Ninja", "-S", tree, "-B", folder]
    options = ("-DCMAKE_CXX_FLAGS=-O0", "-DCMAKE_CXX_COMPILER=g++", "-DWR_JOIN_MODULES=ON")
    run(log, [*configure, *options])
    run(log, ["cmake", "--build", folder, "--parallel", jobs(), "--target", program])
    results = tree.parent / f"{change}.json"
    results.unlink(missing_ok=True)
    run(log, [folder / "tests/usual_design" / program, f"--gtest_output=json:{results}"])
    passed = tests_by_design(json.loads(results.read_text(encoding="utf-8")))
    for design in DESIGNS:
        if not passed[design]:
            raise FailureError(f"no test of the change {change} ran with the {DESIGNS[design]}")
        counts[design]["tests"] = passed[design]
    return counts


def tests_by_design(results: dict[str, Any]) -> dict[str, int]:
    """Returns the number of tests of each design. The test suites are named Suite/Usual and
    Suite/Patterns."""
    counts: dict[str, int] = defaultdict(int)
    for suite in results["testsuites"]:
        counts[suite["name"].rpartition("/")[2].lower()] += suite["tests"]
    return {design: counts[design] for design in DESIGNS}


def apply(log: TextIO, tree: Path, patch: Path) -> None:
    # The copy is not a git repository, and git must not search for a repository above the copy.
    environment = {**os.environ, "GIT_CEILING_DIRECTORIES": str(tree.parent)}
    words = ["git", "-C", str(tree), "apply", "--whitespace=nowarn", str(patch)]
    log.write(f"$ {' '.join(words)}\n")
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise FailureError(
            f"{patch.parent.name}/{patch.name} does not apply: {done.stderr.strip()}"
        )
