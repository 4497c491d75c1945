"""./wr test: runs the tests and every check."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from tools.check import report
from tools.documents import write_time
from tools.lint import lint_tasks, record_steps
from tools.lock import only_one
from tools.steps import UsageError
from tools.task_graph import Graph, Reporter
from tools.tasks import (
    DOCUMENTS,
    LONG_TESTS,
    PAGES,
    PYTHON_TESTS,
    QUICK_TESTS,
    RESULT_TASKS,
    TESTS_SANITIZE,
    graph,
    pages_graph,
)
from traceability.reading.lint_record import files_hash
from traceability.reading.task_record import (
    CHANGES,
    COVERAGE,
    IMAGES,
    PORTS,
    RECORD,
    SEEDED_FAULTS,
    TESTS_BOARD,
    TESTS_TRACE,
    is_fresh,
)
from traceability.reading.tool_tests import python_task
from traceability.schema import Counts

# Word of the command line -> its task.
PARTS = {
    "host": TESTS_TRACE,
    "board": TESTS_BOARD,
    "sanitize": TESTS_SANITIZE,
    "changes": CHANGES,
    "ports": PORTS,
    **{folder: python_task(folder) for folder in PYTHON_TESTS},
}

# The tasks of ./wr test.
QUICK = (IMAGES, TESTS_TRACE, COVERAGE, TESTS_BOARD, *map(python_task, QUICK_TESTS))
# The tasks of ./wr test --all, except the pages.
WHOLE = (*RESULT_TASKS, *map(python_task, PYTHON_TESTS), TESTS_SANITIZE)


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "test",
        description="Runs every check. Runs the tests of the firmware on this computer, with "
        "traces and coverage. Also runs tests on the virtual K64, with the firmware image. Also "
        "runs the tests of the tools, but not the tests that start programs. With --all, also runs "
        "the measurements, and all other tests except the long tests. They concern the firmware "
        "with sanitizers, the client, the commands, the example changes, the ports, the bench, and "
        "the portal's pages in a browser. A task runs again only if its inputs changed. "
        "A Python test imports and reads files. It runs again only if one of these files changed. "
        "The last lines name the results that are older than the files, and count the tests.",
    )
    parser.add_argument(
        "parts",
        nargs="*",
        metavar="PART",
        help=f"run only these tests, and check nothing else: {', '.join(PARTS)}",
    )
    parser.add_argument(
        "--all",
        action="store_true",
        help="run every measurement, and every test except the long tests",
    )
    parser.add_argument(
        "--long",
        action="store_true",
        help="run all tests and measurements of --all, and also the long tests of the tools. Also "
        "test the checks: insert each seeded fault of tests/drift into a copy of the project",
    )
    parser.add_argument(
        "--ci",
        action="store_true",
        help="run the tests of .ci/run: all tests and measurements of --all except the tests with "
        "sanitizers. Run the quick steps of ./wr lint at the same time.",
    )
    parser.set_defaults(run=run)


def run(root: Path, options: argparse.Namespace) -> int:
    unknown = [part for part in options.parts if part not in PARTS]
    if unknown:
        raise UsageError(f"there is no part {unknown[0]}; the parts are {', '.join(PARTS)}")
    if options.parts:
        return test_parts(root, options.parts)
    if options.all or options.long or options.ci:
        return test_all(root, long=options.long, ci=options.ci)
    return test(root)


def test_parts(root: Path, parts: list[str]) -> int:
    with only_one(root, "test"):
        results = graph(root).run([PARTS[part] for part in parts])
    counts = counts_of(results, *map(PARTS.get, parts))
    print(counts)
    return 0 if counts.passed and not results.failed else 1


def test(root: Path) -> int:
    """Runs the checks, and the tests that a developer needs after each change."""
    with only_one(root, "test"):
        results = graph(root).run(QUICK)
        pages = pages_graph(root, keep=True).run([DOCUMENTS])
        code = report(root, [*results.failed, *pages.failed])
        old = [name for name in WHOLE if name not in QUICK and not is_fresh(root, name)]
    counts = counts_of(results)
    if old:
        print(f"results older than the files, or missing: {', '.join(old)}; run ./wr test --all")
    print(counts)
    return code if counts.passed else 1


def test_all(root: Path, *, long: bool, ci: bool) -> int:
    start = time.monotonic()
    with only_one(root, "test"):
        cold = ci and not (root / RECORD).exists()
        names = [name for name in WHOLE if not (ci and name == TESTS_SANITIZE)]
        names += [SEEDED_FAULTS] if long else []
        style = lint_tasks(root, quick=True) if ci else []
        tasks = Graph(root, [*style, *graph(root).tasks])
        files = files_hash(root)
        results = tasks.run([*(task.name for task in style), *names])
        if ci:
            record_steps(root, results, files)
        pages = pages_graph(root).run([DOCUMENTS, PAGES, *([LONG_TESTS] if long else [])])
        counts = counts_of(results) + counts_of(pages)
        code = report(root, [*results.failed, *pages.failed])
        if cold:
            write_time(root, "build.ci_s", time.monotonic() - start)
    print(counts)
    return code if counts.passed else 1


def counts_of(run: Reporter, *counted: str | None) -> Counts:
    """Returns the counts of the tests of all tasks. The tests with sanitizers are the same tests as
    the tests with traces. Therefore the tests with sanitizers are counted only if ``counted``
    contains their task."""
    counts = Counts()
    for name, values in run.values.items():
        if "passed" in values and (name in counted or name != TESTS_SANITIZE):
            counts += Counts(values["passed"], values["failed_tests"], values["skipped"])
    return counts
