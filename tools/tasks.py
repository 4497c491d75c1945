"""The tasks of the project, with their actions, inputs and outputs.

Ninja finds the sources of a program. All other inputs are declared only in this file."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TextIO

from tools.baseline import TESTS as BASELINE_TESTS
from tools.baseline import compare, image_name
from tools.bench_runs import measure_all
from tools.browser import find_browser
from tools.call_runs import record_all
from tools.change_runs import IMAGES as CHANGE_IMAGES
from tools.change_runs import TESTS as CHANGE_TESTS
from tools.change_runs import missing_emulators, test_changes, test_ports
from tools.closed_loop_runs import HOST_PROGRAM, play_all
from tools.cmake_build import (
    BOARD,
    BOARD_PRESET,
    BOARD_PROGRAM,
    BOARD_TESTS,
    TESTS,
    build,
    outcome_of,
    run_tests,
    sources_of,
)
from tools.coverage_run import count_coverage
from tools.documents import CURRENT, FINDINGS, add_metrics, make_documents
from tools.live_runs import SCRIPT as LIVE_SCRIPT
from tools.live_runs import build_module, measure_live
from tools.proof_runs import missing_program, prove_all
from tools.python_imports import PROJECT, READ_BY_ALL, inputs_of
from tools.python_tests import (
    NOT_LONG,
    reported_numbers,
    run_long,
    run_pytest,
    update_pytest,
)
from tools.sizes import write_products, write_sizes
from tools.task_graph import Graph, Outcome, Task
from traceability.model.build import commit
from traceability.reading import task_record
from traceability.reading.baseline_record import DESIGNS, FOLDER, RESULT
from traceability.reading.bench_record import BENCH, PAPER_BENCH
from traceability.reading.bench_record import FOLDER as BENCH_SCENARIOS
from traceability.reading.call_record import DECLARED as DECLARED_RECORDINGS
from traceability.reading.call_record import RECORD as CALL_RECORD
from traceability.reading.call_record import SCENARIOS as ALL_SCENARIOS
from traceability.reading.change_kits import FOLDER as KITS
from traceability.reading.change_kits import RESULT as KITS_RESULT
from traceability.reading.closed_loop_record import DECLARED, EXAMPLES, OUTCOMES
from traceability.reading.ports import RESULT as PORTS_RESULT
from traceability.reading.ports import read_ports
from traceability.reading.products import DEFAULT, PRODUCTS
from traceability.reading.products import LIST as PRODUCT_LIST
from traceability.reading.proof_record import PROOFS
from traceability.reading.results import COVERAGE, COVERAGE_LINES, RESULTS
from traceability.reading.results import LIVE as LIVE_RECORD
from traceability.reading.seeded_faults import RECORD as FAULTS
from traceability.reading.seeded_faults import SOURCES
from traceability.reading.task_record import is_fresh
from traceability.reading.toml_reader import Entries
from traceability.reading.tool_tests import python_task, results_of
from traceability.sources import files_below, hash_of

# ---- names -------------------------------------------------------------------

HOST_FIRMWARE, K64_FIRMWARE = "firmware (this machine)", "firmware (K64)"
RECORDED_IMAGES = "build (K64, to record calls)"
VIRTUAL_BOARD, BASELINE_BUILD = "virtual K64", "build (baseline design)"
CHANGES_BUILD = "build (likely changes)"
PORTS_BUILD = "build (ports)"
TESTS_SANITIZE = "tests (sanitize)"
LIVE_MODULE = "live module"
DOCUMENTS, PAGES, LONG_TESTS = "documents", "tests (pages)", "long tests"
PAGES_RECORD = Path("build/pages.json")
FIRMWARE = (HOST_FIRMWARE, K64_FIRMWARE, RECORDED_IMAGES, task_record.IMAGES)
# Tasks whose results the pages show. The most important task is first.
RESULT_TASKS = (
    *FIRMWARE,
    task_record.TESTS_TRACE,
    task_record.COVERAGE,
    task_record.TESTS_BOARD,
    task_record.CLOSED_LOOP,
    task_record.BENCH,
    task_record.BASELINE,
    task_record.CHANGES,
    task_record.PORTS,
    LIVE_MODULE,
    task_record.LIVE,
    task_record.CALLS,
    task_record.PROOFS,
)

# ---- declared inputs ---------------------------------------------------------

DESIGN = ("src", "extensions")
BUILD_FILES = ("CMakeLists.txt", "CMakePresets.json", "setup/k64-toolchain.cmake")
PROOF_INPUTS = (
    "design/fsm",
    "design/proofs",
    "traceability/model/promela.py",
    "tools/proof_runs.py",
    "tests/records/proofs.json",
)
CODE = (*DESIGN, "changes", "ports", "sim", "tests", "requirements")
SCENARIOS = (str(EXAMPLES), "tests/system", "tests/usual_design")  # inputs of tests and runs
PYTHON_SETTINGS = (
    *("pyproject.toml", "setup/python.lock"),
    *("tools/python_imports.py", "tools/python_tests.py"),
    *READ_BY_ALL,
)
TOOLS = ("traceability", "site/portal", "tools", "client", *PYTHON_SETTINGS)
# Inputs of the test of the checks. They are the sources, the checks and the seeded faults.
SEEDED = (*SOURCES, *TOOLS)
# The pages show all hand-written texts. The checks also read the settings of the editor and of the
# automatic runs.
SHOWN = (*SEEDED, "CHANGELOG.md", "site", "wr", ".ci", ".github", ".vscode")
SHOWN_RESULTS = (
    *("trace.json", "board.json", "coverage.json", "coverage_lines.json", "closed_loop.json"),
    *("bench.json", "bench_paper.json", "usual_design.json", "products.json", "size_k64.json"),
    *("calls.json", "proofs.json", "changes.json", "ports.json"),
    *("image_k64.json", "driver_faults.json", "mutation.json", "drift.json"),
    *("trace.cost.json", "plain.cost.json", "live.json", "diff.json", "lint.json"),
)
# Folders of tests/python. Their tests start built programs or commands of ./wr. The inputs of these
# tests are the files in this table and all sources of the tools. The built programs are also
# inputs, except for the tests in the folder NO_BUILD. The tests of the client mostly wait.
# Therefore, the tests of the client are started first.
PROGRAM_TESTS: dict[str, tuple[str, ...]] = {
    "client": ("design", "docs", "sim/scenario", "site"),
    "firmware": (*DESIGN, "sim", "tests/k64"),
    "programs": (
        *(*DESIGN, "sim/scenario", "design", "site", "tests/fuzz", "tests/support"),
        str(COVERAGE_LINES),
    ),
    "commands": SHOWN,
}
NO_BUILD = "commands"
# Folders whose tests start no program. Each test file depends on the files that it imports, and on
# the files in its mark "reads".
QUICK_TESTS = ("reading", "model", "checks", "exports", "portal", "tools")
PYTHON_TESTS = (*PROGRAM_TESTS, *QUICK_TESTS)


# ---- the tasks ---------------------------------------------------------------


def graph(root: Path) -> Graph:
    """Returns the tasks that build, test and measure."""
    return Graph(root, [*builds(root), *measurements(root), *checks_of_tools(root)])


def pages_graph(root: Path, out: TextIO | None = None, *, keep: bool = False) -> Graph:
    """Returns the tasks that build and test the pages. They run while other tasks still measure.
    With ``keep``, the pages stay as they are if their links and warnings cannot have changed."""
    tasks = documents(root, out or sys.stdout, keep=keep)
    return Graph(root, tasks, out or sys.stdout, record=PAGES_RECORD)


def builds(root: Path) -> list[Task]:
    """Returns the tasks that build. Each task returns the sources that Ninja lists for it."""

    def made(name: str, *programs: tuple[str, tuple[str, ...]]) -> Task:
        def action(log: TextIO) -> Outcome:
            found: set[str] = set()
            for preset, targets in programs:
                build(root, preset, log, *targets)
                found |= set(sources_of(root, preset, *targets))
            return Outcome(f"{len(found)} sources", values={"file_dep": sorted(found)})

        return Task(name, action, always=True)

    images = tuple(f"{product}.elf" for product in PRODUCTS)
    ports = read_ports(root, Entries(root)).values()
    baselines = tuple(f"{image_name(design)}.elf" for design in DESIGNS)
    return [
        made(HOST_FIRMWARE, ("host", (HOST_PROGRAM,))),
        made(K64_FIRMWARE, ("k64", images)),
        made(RECORDED_IMAGES, ("k64_calls", images)),
        made(VIRTUAL_BOARD, (BOARD_PRESET, (BOARD_PROGRAM,))),
        *(made(f"build ({name})", (name, (TESTS,))) for name in ("trace", "sanitize", "plain")),
        made("build (virtual K64)", (BOARD_PRESET, (BOARD_TESTS,))),
        Task(LIVE_MODULE, partial(build_module, root), always=True),
        made(BASELINE_BUILD, ("k64", baselines), (BOARD_PRESET, (BASELINE_TESTS,))),
        made(CHANGES_BUILD, ("k64_calls", (CHANGE_IMAGES,)), (BOARD_PRESET, (CHANGE_TESTS,))),
        made(
            PORTS_BUILD,
            ("k64_calls", tuple(port.image for port in ports)),
            (BOARD_PRESET, tuple(port.program for port in ports)),
        ),
    ]


def measurements(root: Path) -> list[Task]:
    """Returns the tasks that test and measure the built programs. The inputs of the tasks are the
    sources of these programs."""

    def tests(run: str) -> Callable[[TextIO], Outcome]:
        return lambda log: outcome_of(run_tests(root, run, log))

    def sizes(_log: TextIO) -> str:
        write_sizes(root)
        whole = write_products(root)[DEFAULT]
        return f"{len(PRODUCTS)} products; {DEFAULT}: {whole.flash} bytes flash, {whole.ram} RAM"

    def compared(log: TextIO) -> str:
        compare(root, log)
        return f"{len(DESIGNS)} designs"

    on_board = (VIRTUAL_BOARD, K64_FIRMWARE)
    return [
        Task(
            task_record.IMAGES,
            sizes,
            (*DESIGN, *BUILD_FILES, str(PRODUCT_LIST)),
            tuple(f"{RESULTS}/{name}.json" for name in ("size_k64", "image_k64", "products")),
            inputs_from=(K64_FIRMWARE, RECORDED_IMAGES),
        ),
        Task(
            task_record.TESTS_TRACE,
            tests("trace"),
            SCENARIOS,
            (f"{RESULTS}/trace.json",),
            inputs_from=("build (trace)",),
        ),
        Task(
            task_record.TESTS_BOARD,
            tests(BOARD),
            (*DESIGN, *SCENARIOS),
            (f"{RESULTS}/board.json",),
            inputs_from=("build (virtual K64)", K64_FIRMWARE, RECORDED_IMAGES),
        ),
        Task(
            task_record.COVERAGE,
            partial(count_coverage, root),
            (f"{RESULTS}/trace.json",),
            (str(COVERAGE), str(COVERAGE_LINES)),
        ),
        Task(
            task_record.CLOSED_LOOP,
            partial(play_all, root),
            (*DESIGN, str(EXAMPLES), str(DECLARED)),
            (str(OUTCOMES),),
            inputs_from=(HOST_FIRMWARE, *on_board),
        ),
        Task(
            task_record.BENCH,
            partial(measure_all, root),
            (*DESIGN, str(BENCH_SCENARIOS)),
            (str(BENCH), str(PAPER_BENCH)),
            inputs_from=on_board,
        ),
        Task(
            task_record.CALLS,
            partial(record_all, root),
            (*DESIGN, str(DECLARED_RECORDINGS), str(ALL_SCENARIOS), "design/frames.toml"),
            (str(CALL_RECORD),),
            inputs_from=(VIRTUAL_BOARD, RECORDED_IMAGES),
        ),
        Task(
            task_record.PROOFS,
            partial(prove_all, root),
            PROOF_INPUTS,
            (str(PROOFS),),
            state=missing_program,
        ),
        Task(
            task_record.BASELINE,
            compared,
            (*DESIGN, str(FOLDER)),
            (str(RESULT),),
            inputs_from=(BASELINE_BUILD, VIRTUAL_BOARD),
        ),
        Task(
            task_record.CHANGES,
            partial(test_changes, root),
            (*DESIGN, str(KITS)),
            (str(KITS_RESULT),),
            inputs_from=(CHANGES_BUILD, RECORDED_IMAGES),
        ),
        Task(
            task_record.PORTS,
            partial(test_ports, root),
            (),
            (str(PORTS_RESULT),),
            inputs_from=(PORTS_BUILD,),
            state=partial(missing_emulators, root),
        ),
        Task(
            task_record.LIVE,
            partial(measure_live, root),
            (*DESIGN, str(EXAMPLES), str(LIVE_SCRIPT)),
            (str(LIVE_RECORD),),
            inputs_from=(LIVE_MODULE, *on_board),
        ),
        Task(
            TESTS_SANITIZE,
            tests("sanitize"),
            SCENARIOS,
            (f"{RESULTS}/sanitize.json",),
            inputs_from=("build (sanitize)",),
        ),
        Task(
            task_record.TESTS_PLAIN,
            tests("plain"),
            SCENARIOS,
            (f"{RESULTS}/plain.json",),
            inputs_from=("build (plain)",),
        ),
    ]


def checks_of_tools(root: Path) -> list[Task]:
    """Returns the tasks that run the tests of the tools, and the task that inserts faults to test
    the checks."""
    built = (HOST_FIRMWARE, VIRTUAL_BOARD, K64_FIRMWARE, RECORDED_IMAGES, LIVE_MODULE)

    def tests(folder: str) -> Task:
        others = (*TOOLS, *PROGRAM_TESTS[folder]) if folder in PROGRAM_TESTS else PYTHON_SETTINGS
        read = inputs_of(root, folder)
        whole = SHOWN if PROJECT in read else ()
        inputs = {*others, *whole, *(read - {PROJECT}), f"tests/python/{folder}"}
        return Task(
            python_task(folder),
            lambda log: run_pytest(root, folder, log),
            tuple(sorted(inputs)),
            (str(results_of(folder)),),
            inputs_from=built if folder in PROGRAM_TESTS and folder != NO_BUILD else (),
            update=partial(update_pytest, root, folder),
        )

    return [
        *map(tests, PYTHON_TESTS),
        Task(
            task_record.SEEDED_FAULTS,
            partial(seed_faults, root),
            SEEDED,
            (str(FAULTS),),
            state=partial(fresh_results, root),
        ),
    ]


def fresh_results(root: Path) -> str:
    """Returns a text in JSON that states whether the results of the tests are fresh. Some seeded
    faults can be tried only with fresh results."""
    names = (task_record.TESTS_TRACE, task_record.TESTS_BOARD)
    return json.dumps({name: is_fresh(root, name) for name in names})


def seed_faults(root: Path, log: TextIO) -> Outcome:
    """Inserts each fault, and reports the faults that no check found."""
    from tools.seed_faults import seed_all

    outcomes = seed_all(root)
    missed = [one for one in outcomes if not one.caught]
    for one in missed:
        log.write(f"{one.name}: {one.says} [{one.check}] at {one.file}:{one.line}\n")
        log.writelines(f"    found: {said}\n" for said in one.said)
    found = f"{len(outcomes) - len(missed)} of {len(outcomes)} faults found"
    return Outcome(found, bool(missed))


def documents(root: Path, out: TextIO, *, keep: bool) -> list[Task]:
    """Returns three tasks. The first task runs the checks and builds the pages. The second task
    tests the pages. The third task runs the long tests. Some of these tests read the pages."""

    def state() -> str:
        names = (*RESULT_TASKS, task_record.SEEDED_FAULTS, *map(python_task, PYTHON_TESTS))
        return json.dumps([commit(root), {name: is_fresh(root, name) for name in names}])

    def pages(log: TextIO) -> Outcome:
        if find_browser() is None:
            log.write("There is no browser. The tests that need a browser are skipped.\n")
            return run_pytest(root, "site", log, f"{NOT_LONG} and not browser")
        outcome = run_pytest(root, "site", log)
        add_metrics(root, reported_numbers(root / results_of("site")))
        return outcome

    shown = [*(RESULTS / name for name in SHOWN_RESULTS), *map(results_of, PYTHON_TESTS)]
    results = tuple(str(path) for path in shown if (root / path).exists())
    # All inputs of the pages except the sources, whose names are in the model.
    others = [name for name in (*SHOWN, *results) if name not in CODE]
    made = ("build/metrics.json", "build/site/index.html")

    def make(log: TextIO) -> str:
        texts = hash_of(root, files_below(root, others))
        return make_documents(root, out, texts, log, keep=keep)

    return [
        Task(
            DOCUMENTS,
            make,
            (*SHOWN, *results),
            (str(FINDINGS),),
            must_exist=made if keep else (*made, str(CURRENT)),
            state=state,
            quiet=True,
        ),
        Task(
            PAGES,
            pages,
            (*SHOWN, *results),
            (str(results_of("site")),),
            after=(DOCUMENTS,),
        ),
        Task(
            LONG_TESTS,
            partial(run_long, root),
            (*SHOWN, *results),
            (str(results_of("long")),),
            after=(DOCUMENTS,),
        ),
    ]
