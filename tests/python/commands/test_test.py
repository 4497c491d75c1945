"""Runs of the tests of Python: when they are repeated."""

import contextlib
import sys
from pathlib import Path

import pytest

from traceability.commands.builds import Counts
from traceability.commands.steps import FailureError, Steps
from traceability.commands.test import run_pytest

PASSING = """\
from pathlib import Path

def test_counts_its_runs():
    with Path(__file__).parents[1].joinpath("runs").open("a") as file:
        file.write("run ")
"""


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A project with one test, which notes each run."""
    (tmp_path / ".venv/bin").mkdir(parents=True)
    python = tmp_path / ".venv/bin/python"
    python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    python.chmod(0o755)
    (tmp_path / "pyproject.toml").write_text("")
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests/test_one.py").write_text(PASSING)
    (tmp_path / "src").mkdir()
    (tmp_path / "src/RC.cpp").write_text("int a;\n")
    return tmp_path


def run(root: Path) -> Counts:
    return run_pytest(root, Steps(root, 9), "tools", [root / "tests"])


def runs(root: Path) -> int:
    return len((root / "runs").read_text().split())


def test_tests_run_once_on_the_same_files(root: Path) -> None:
    assert run(root) == Counts(1, 0, 0)
    assert run(root) == Counts(1, 0, 0)
    assert runs(root) == 1


def test_tests_run_again_when_a_file_changed(root: Path) -> None:
    run(root)
    (root / "src/RC.cpp").write_text("int b;\n")
    run(root)
    assert runs(root) == 2


def test_tests_that_failed_run_again(root: Path) -> None:
    (root / "tests/test_two.py").write_text("def test_fails():\n    assert False\n")
    for _ in range(2):
        with contextlib.suppress(FailureError):
            run(root)
    assert runs(root) == 2
