"""The task graph. A task runs again if one of its inputs has changed, or if the task must always
run."""

from __future__ import annotations

import io
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TextIO

import pytest

from tools import task_graph
from tools.steps import FailureError
from tools.task_graph import Graph, Outcome, Reporter, Task
from traceability.reading.task_record import is_fresh

RESULT = "build/results/tests.json"


class Project:
    """A small project: a program, its tests, a measurement of the tests, tools and pages."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.ran: list[str] = []
        self.out = io.StringIO()
        self.sources = ["src/constants.hpp", "src/main.cpp", "tests/MainTest.cpp"]
        for name in (*self.sources, "requirements/a.dox", "site/page.html", "tools/a.py"):
            self.write(name, "first")

    def write(self, name: str, text: str) -> None:
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).write_text(text)
        before = time.time() - 10  # a time before the tasks run
        os.utime(self.root / name, (before, before))

    def action(
        self, name: str, end: Outcome | None = None, result: str = ""
    ) -> Callable[[TextIO], Outcome | None]:
        def run(_log: TextIO) -> Outcome | None:
            self.ran.append(name)
            if result:
                (self.root / result).parent.mkdir(parents=True, exist_ok=True)
                (self.root / result).write_text(name)
            return end

        return run

    def run(self, *names: str, **replaced: Task) -> list[str]:
        """Returns the tasks that ran, without the task ``build``. This task always runs, because
        only Ninja finds the files to build again."""
        found = Outcome("", values={"file_dep": self.sources})
        tasks = {
            "build": Task("build", self.action("build", found), always=True),
            "tests": Task(
                "tests", self.action("tests", None, RESULT), (), (RESULT,), inputs_from=("build",)
            ),
            "coverage": Task("coverage", self.action("coverage"), (RESULT,)),
            "tools": Task("tools", self.action("tools"), ("tools",)),
            "pages": Task("pages", self.action("pages"), ("src", "requirements", "site")),
        } | replaced
        self.ran.clear()
        self.reporter: Reporter = Graph(self.root, list(tasks.values()), self.out).run(
            names or tasks
        )
        return sorted(set(self.ran) - {"build"})


@pytest.fixture
def project(tmp_path: Path) -> Project:
    made = Project(tmp_path)
    assert made.run() == ["coverage", "pages", "tests", "tools"]
    return made


def test_nothing_runs_twice(project: Project) -> None:
    assert project.run() == []
    assert "tests ... unchanged" in project.out.getvalue()


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ("src/constants.hpp", ["coverage", "pages", "tests"]),
        ("tests/MainTest.cpp", ["coverage", "tests"]),
        ("requirements/a.dox", ["pages"]),
        ("site/page.html", ["pages"]),
        ("tools/a.py", ["tools"]),
        ("docs/other.rst", []),
    ],
)
def test_only_what_depends_on_a_change_runs_again(
    project: Project, changed: str, expected: list[str]
) -> None:
    if "coverage" in expected:
        # The tests write different results. The task ``coverage`` therefore runs too.
        results = Task(
            "tests",
            lambda _log: project.action("tests")(_log) or write(project.root / RESULT, changed),
            (),
            (RESULT,),
            inputs_from=("build",),
        )
        project.write(changed, "second")
        assert project.run(tests=results) == expected
    else:
        project.write(changed, "second")
        assert project.run() == expected
    assert project.run() == []


def write(path: Path, text: str) -> None:
    path.write_text(text)


class Updated:
    """A task that updates its result, and records which inputs have changed."""

    def __init__(self, project: Project, result: str = RESULT) -> None:
        self.updates: list[set[str]] = []
        self.task = Task(
            "tools",
            project.action("tools", None, result),
            ("tools",),
            (result,),
            update=lambda _log, changed: self.update(changed),
        )

    def update(self, changed: frozenset[str]) -> Outcome:
        self.updates.append(set(changed))
        return Outcome("")


def test_an_update_gets_the_changed_the_added_and_the_removed_inputs(project: Project) -> None:
    updated = Updated(project, "build/tools.json")
    assert project.run("tools", tools=updated.task) == ["tools"]
    assert updated.updates == []
    project.write("tools/a.py", "second")
    project.write("tools/b.py", "new")
    project.run("tools", tools=updated.task)
    (project.root / "tools/b.py").unlink()
    project.run("tools", tools=updated.task)
    assert updated.updates == [{"tools/a.py", "tools/b.py"}, {"tools/b.py"}]
    assert (project.root / "build/tools.json").exists()


def test_without_its_result_a_task_runs_whole(project: Project) -> None:
    updated = Updated(project, "build/tools.json")
    project.run("tools", tools=updated.task)
    (project.root / "build/tools.json").unlink()
    project.write("tools/a.py", "second")
    assert project.run("tools", tools=updated.task) == ["tools"]
    assert updated.updates == []


def test_after_an_interruption_a_task_runs_whole(project: Project) -> None:
    def interrupted(_log: TextIO, _changed: frozenset[str]) -> Outcome:
        raise FailureError("interrupted")

    updated = Updated(project, "build/tools.json")
    project.run("tools", tools=updated.task)
    project.write("tools/a.py", "second")
    project.run("tools", tools=replace(updated.task, update=interrupted))
    assert project.run("tools", tools=updated.task) == ["tools"]
    assert updated.updates == []


def test_the_same_results_do_not_run_what_counts_them(project: Project) -> None:
    project.write("src/main.cpp", "second")
    assert project.run("coverage") == ["tests"]


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda root: (root / "src/main.cpp").touch(), []),
        (lambda root: (root / "site/new.html").write_text("new"), ["pages"]),
        (lambda root: (root / "site/page.html").unlink(), ["pages"]),
        (lambda root: (root / RESULT).unlink(), ["tests"]),
    ],
    ids=["same content", "new file", "removed file", "removed result"],
)
def test_content_and_files_decide(
    project: Project, change: Callable[[Path], object], expected: list[str]
) -> None:
    change(project.root)
    assert project.run() == expected


def test_a_file_that_changes_during_the_run_counts_as_changed(project: Project) -> None:
    def edit(_log: TextIO) -> None:
        project.ran.append("tools")
        (project.root / "tools/a.py").write_text("edited")

    project.write("tools/a.py", "second")
    assert project.run(tools=Task("tools", edit, ("tools",))) == ["tools"]
    assert project.run() == ["tools"]
    assert project.run() == []


def test_bad_results_are_kept_and_reported_each_time(project: Project) -> None:
    bad = Task("tools", project.action("tools", Outcome("1 failed", failed=True)), ("tools",))
    project.write("tools/a.py", "second")
    assert project.run(tools=bad) == ["tools"]
    assert project.run(tools=bad) == []
    assert project.reporter.failed == ["tools"]


def test_a_failed_task_runs_again_and_leaves_out_what_needs_it(project: Project) -> None:
    def fail(_log: TextIO) -> None:
        project.ran.append("build")
        raise FailureError("no compiler")

    broken = Task("build", fail, always=True)
    assert project.run(build=broken) == []
    assert project.reporter.failed == ["build", "tests", "coverage"]
    printed = project.out.getvalue()
    assert "build ... FAILED: no compiler" in printed
    assert "tests ... not run: build failed" in printed
    assert project.run("tests") == ["tests"]


def test_a_record_of_results_is_fresh_until_a_source_changes(project: Project) -> None:
    assert is_fresh(project.root, "tests")
    project.write("requirements/a.dox", "second")
    assert is_fresh(project.root, "tests")
    project.write("src/constants.hpp", "second")
    assert not is_fresh(project.root, "tests")
    assert not is_fresh(project.root, "another task")


def test_the_start_of_a_task_that_takes_long_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No earlier run has recorded how long the tasks take."""
    monkeypatch.setattr(task_graph, "LONG", 0.05)
    out = io.StringIO()

    def wait(_log: TextIO) -> None:
        end = time.monotonic() + 10
        while "slow: started" not in out.getvalue() and time.monotonic() < end:
            time.sleep(0.01)

    quick = Task("quick", lambda _log: None)
    Graph(tmp_path, [quick, Task("slow", wait, after=("quick",))], out).run(["slow"])
    lines = [line.partition(" ...")[0].strip() for line in out.getvalue().splitlines()]
    assert lines == ["[1/2] quick", "slow: started 0.05 s ago", "[2/2] slow"]


LONG = """
import sys, time
from pathlib import Path
from tools.task_graph import Graph, Task
from tools.steps import run
root = Path(sys.argv[1])
first = Task("first", lambda log: run(log, ["touch", root / "first"]) and None, ("src",))
second = Task("second", lambda log: run(log, ["sleep", sys.argv[2]]) and None, after=("first",))
Graph(root, [first, second]).run(["second"])
"""


@pytest.mark.runs_tools
def test_an_interrupted_run_continues_with_what_was_not_done(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src/a.cpp").write_text("a")
    words = [sys.executable, "-c", LONG, str(tmp_path)]
    with subprocess.Popen([*words, "100"], stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout is not None
        assert "first" in program.stdout.readline()
        program.send_signal(signal.SIGINT)
        assert program.wait(20) != 0
    ended = subprocess.run([*words, "0"], capture_output=True, text=True, check=True)
    first, second = ended.stdout.splitlines()
    assert first == "[1/2] first ... unchanged"
    assert re.fullmatch(r"\[2/2\] second \.\.\. [\d.]+ s", second)
