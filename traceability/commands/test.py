"""./wr test: every test and every check."""

from __future__ import annotations

import argparse
import shutil
import subprocess
from pathlib import Path
from typing import TextIO

from traceability.commands.bench import add_bench
from traceability.commands.builds import (
    Counts,
    jobs,
    junit_counts,
    require_counts,
    run_tests,
)
from traceability.commands.check import STEPS as DOCUMENT_STEPS
from traceability.commands.check import make_documents, report, seed_faults
from traceability.commands.firmware import build_firmware
from traceability.commands.portal import board_tests, closed_loop, traced_tests
from traceability.commands.steps import FailureError, Steps, run
from traceability.sources import DESIGN, files_below, hash_of

OTHER_STEPS = 11
# What tests of Python read: some run on a copy of the whole project.
READ_BY_TESTS = (
    *(*DESIGN, "sim", "tests", "client", "docs", "design", "requirements"),
    *("traceability", "site", "setup", "wr", "README.md"),
    *("CMakeLists.txt", "CMakePresets.json", "pyproject.toml"),
)
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "test",
        help="run every test and every check",
        description="Runs the tests of the firmware (with traces and coverage, with "
        "sanitizers, and with the image on the virtual K64), those of the tools, every check, and "
        "those of the portal's pages in a browser. The last line counts the tests of the firmware "
        "(once for this machine, once for the virtual K64), of the tools and of the pages.",
    )
    parser.add_argument(
        "--long",
        action="store_true",
        help="also seed each fault of tests/drift in a copy, and see whether the checks find it",
    )
    parser.set_defaults(run=lambda root, options: test(root, long=options.long))


def test(root: Path, *, long: bool) -> int:
    steps = Steps(root, DOCUMENT_STEPS + OTHER_STEPS + long)
    build_firmware(root, steps)
    counts = traced_tests(root, steps)
    steps.run("tests (sanitize)", lambda log: require_counts(*run_tests(root, "sanitize", log)))
    counts += board_tests(root, steps)
    closed_loop(root, steps)
    add_bench(root, steps)
    pages = root / "tests" / "python" / "site"
    python = root / "tests" / "python"
    counts += run_pytest(root, steps, "tools", [python, f"--ignore={pages}"])
    if long:
        seed_faults(root, steps)
    findings = make_documents(root, steps)
    if works(find_browser()):
        counts += run_pytest(root, steps, "pages", [pages])
    else:
        counts += run_pytest(root, steps, "pages without a browser", [pages, "-m", "not browser"])
    code = report(findings, steps)
    print(counts)
    return code if counts.passed else 1


def run_pytest(root: Path, steps: Steps, name: str, paths: list[Path | str]) -> Counts:
    """Runs tests of Python, unless they passed on these very files."""
    results = root / "build" / "results" / f"pytest_{name.replace(' ', '_')}.xml"
    stamp = results.with_suffix(".hash")
    counts = Counts()

    def action(log: TextIO) -> str:
        nonlocal counts
        now = hash_of(root, files_below(root, READ_BY_TESTS))
        if stamp.exists() and stamp.read_text(encoding="utf-8") == now:
            counts = junit_counts(results)
            return require_counts(counts, fresh=False)
        results.parent.mkdir(parents=True, exist_ok=True)
        results.unlink(missing_ok=True)
        stamp.unlink(missing_ok=True)
        words: list[str | Path] = [root / ".venv/bin/python", "-m", "pytest", "-q", "-ra"]
        words += ["-n", jobs(), "--dist", "loadfile"]
        words += [f"--rootdir={root}", "-c", root / "pyproject.toml", f"--junitxml={results}"]
        try:
            run(log, [*words, *paths])
        except FailureError as error:
            if not results.exists():
                raise
            counts = junit_counts(results)
            raise FailureError(f"{counts}; {error}") from error
        counts = junit_counts(results)
        note = require_counts(counts, fresh=True)
        stamp.write_text(now, encoding="utf-8")
        return note

    steps.run(f"tests ({name})", action)
    return counts


def find_browser() -> str | None:
    return next((path for name in BROWSERS if (path := shutil.which(name))), None)


def works(browser: str | None) -> bool:
    """Whether the browser starts: where it is an empty package, its command only says so."""
    if browser is None:
        return False
    try:
        return (
            subprocess.run(
                [browser, "--version"], capture_output=True, timeout=60, check=False
            ).returncode
            == 0
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
