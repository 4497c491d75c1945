"""The fixtures of all tests of the tools."""

import fcntl
import os
import signal
import subprocess
from collections.abc import Callable
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
