"""The fixtures and hooks of all Python tests."""

import fcntl
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Generator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

# Programs that a test starts must end when they receive SIGINT (Ctrl-C), even if a shell started
# the tests with SIGINT ignored.
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


def record_program(event: str, arguments: tuple[object, ...]) -> None:
    if event == "subprocess.Popen":
        program, words = arguments[:2]
        names = {Path(os.fsdecode(word)).name for word in (program, *words) if word}
        python_programs.extend(name for name in names if name == "wr" or name.startswith("python"))


sys.addaudithook(record_program)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol() -> Generator[None, object, object]:
    python_programs.clear()
    return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> Generator[None, object, object]:
    """Fails each test that starts a Python program and has no mark ``runs_tools``.

    Without the mark, ./wr test repeats a test only after a change of a file that the test itself
    imports. The started program can import other files.
    """
    result = yield
    if python_programs and not pyfuncitem.get_closest_marker("runs_tools"):
        pytest.fail(f"mark this test with pytest.mark.runs_tools: it started {python_programs}")
    return result
