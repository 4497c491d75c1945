"""The fixtures and hooks of all Python tests."""

import fcntl
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Generator
from pathlib import Path

import pytest

from tools.python_imports import READ_BY_ALL, covers, imported_by, read_by, runs_all_tools

ROOT = Path(__file__).parents[2]

# If a test starts a program, the program must end when it receives SIGINT (Ctrl-C). A shell can
# start the tests in such a way that they ignore SIGINT. Then the program would also ignore it.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def build() -> Callable[..., None]:
    """Builds targets of a preset. If tests run in several processes, these processes build one
    after the other."""

    def built(preset: str, *targets: str) -> None:
        folder = ROOT / "build" / preset
        folder.mkdir(parents=True, exist_ok=True)
        jobs = str(os.cpu_count() or 1)
        with (folder / "tests.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for words in (
                ["cmake", "-S", ROOT, "--preset", preset],
                ["cmake", "--build", folder, "--parallel", jobs, "--target", *targets],
            ):
                subprocess.run(words, check=True, cwd=ROOT, timeout=600, stdout=subprocess.DEVNULL)

    return built


python_programs: list[str] = []  # the Python programs that the running test has started
opened: set[str] = set()  # the files of the project that the running test has opened
# A test needs no mark for its own outputs, nor for files that pytest and its plugins open.
OWN_FILES = ("build", ".venv", ".hypothesis", ".git")
SHOWN = 10  # greatest number of file names in a message
# The tests in these folders start programs, and the programs read files of the project. For these
# tests, tools/tasks.py contains a task with the names of the files.
START_PROGRAMS = ("client", "commands", "firmware", "programs", "site", "worked_examples")


def record_event(event: str, arguments: tuple[object, ...]) -> None:
    if event == "subprocess.Popen":
        program, words = arguments[:2]
        names = {Path(os.fsdecode(word)).name for word in (program, *words) if word}
        python_programs.extend(name for name in names if name == "wr" or name.startswith("python"))
    elif event == "open" and isinstance(arguments[0], str | Path):
        path = Path(arguments[0]).absolute()
        if path.is_relative_to(ROOT) and path.suffix != ".pyc":
            opened.add(str(path.relative_to(ROOT)))


sys.addaudithook(record_event)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol() -> Generator[None, object, object]:
    python_programs.clear()
    opened.clear()
    return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> Generator[None, object, object]:
    """Reports a failure if a test lacks a mark. A test that starts a Python program needs the mark
    ``runs_tools``. A test that reads a file of the project needs the mark ``reads`` with this file
    or its folder. ``undeclared`` returns only files that need this mark.

    Without the marks, ./wr test repeats a test only after a change of a file that the test itself
    imports.
    """
    result = yield
    if python_programs and not pyfuncitem.get_closest_marker("runs_tools"):
        pytest.fail(f"mark this test with pytest.mark.runs_tools: it started {python_programs}")
    if unknown := undeclared(pyfuncitem.path):
        names = ", ".join(unknown[:SHOWN])
        more = f" and {len(unknown) - SHOWN} more" if len(unknown) > SHOWN else ""
        pytest.fail(f"name these files in a mark pytest.mark.reads of this test: {names}{more}")
    return result


def undeclared(test: Path) -> list[str]:
    """Returns the files that the running test has opened. Leaves out the files that are declared in
    a mark of the test, and the files that need no mark."""
    folder = test.parent.relative_to(ROOT)
    if folder.name in START_PROGRAMS:
        return []
    known = (*OWN_FILES, *READ_BY_ALL, str(folder), *read_by(test))
    left = {name for name in opened if not covers(known, name) and (ROOT / name).is_file()}
    imported = imported_by(ROOT, test) if left else set()
    if runs_all_tools(test, imported):
        left = {name for name in left if not name.endswith(".py")}
    return sorted(left - imported)
