"""./wr portal: from the sources to the portal."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TextIO

from traceability.commands.bench import add_bench
from traceability.commands.builds import BOARD, Counts, is_current, require_counts, run_tests
from traceability.commands.check import STEPS as DOCUMENT_STEPS
from traceability.commands.check import make_documents, report
from traceability.commands.closed_loop import play_all
from traceability.commands.coverage import count_coverage
from traceability.commands.firmware import build_firmware
from traceability.commands.serve import add_port, serve
from traceability.commands.steps import Steps
from traceability.model.results import RUNS
from traceability.model.schema import HOST

BUILD_STEPS = 8
TRACE = RUNS[HOST]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "portal",
        help="build the firmware, test it, check it, build its portal and serve it",
        description="Builds the firmware for this machine and for the K64, runs its tests with "
        "traces and coverage, and with the image on the virtual K64, measures the image, checks "
        "the documents against the code, builds the portal and serves it on this machine. Findings "
        "and failed tests do "
        "not stop the portal from being built.",
    )
    add_port(parser)
    parser.add_argument("--no-serve", action="store_true", help="end when the portal is built")
    parser.add_argument(
        "--docs-only",
        action="store_true",
        help="rebuild the documents; build and run no test",
    )
    parser.set_defaults(run=portal)


def portal(root: Path, options: argparse.Namespace) -> int:
    start = time.monotonic()
    cold = not (root / "build").exists() and not options.docs_only
    steps = Steps(root, DOCUMENT_STEPS + (0 if options.docs_only else BUILD_STEPS))
    if not options.docs_only:
        build_firmware(root, steps)
        traced_tests(root, steps)
        board_tests(root, steps)
        closed_loop(root, steps)
        add_bench(root, steps)
    figures = (lambda: {"build.cold_s": round(time.monotonic() - start, 1)}) if cold else dict
    code = report(make_documents(root, steps, figures), steps)
    print(f"The portal is in {root / 'build' / 'site'}")
    return code if options.no_serve else serve(root, options.port)


def traced_tests(root: Path, steps: Steps) -> Counts:
    """The tests on this machine, and what they executed altogether."""
    counts = counted_tests(root, steps, "trace", TRACE)
    if is_current(root, TRACE):
        steps.run("coverage", lambda log: count_coverage(root, log))
    else:
        steps.skip("coverage", "there are no results")
    return counts


def board_tests(root: Path, steps: Steps) -> Counts:
    """The tests that run on the virtual K64, with the image that was built."""
    if "firmware (K64)" in steps.failed:
        steps.skip("tests (virtual K64)", "there is no image")
        return Counts()
    return counted_tests(root, steps, "virtual K64", BOARD)


def closed_loop(root: Path, steps: Steps) -> None:
    """The scenarios with the simulated robot, on this machine and on the virtual K64."""
    if "firmware (K64)" in steps.failed:
        steps.skip("closed loop", "there is no image")
    else:
        steps.run("closed loop", lambda log: play_all(root, log))


def counted_tests(root: Path, steps: Steps, title: str, run_name: str) -> Counts:
    counts = Counts()

    def action(log: TextIO) -> str:
        nonlocal counts
        counts, fresh = run_tests(root, run_name, log)
        return require_counts(counts, fresh)

    steps.run(f"tests ({title})", action)
    return counts
