"""./wr portal builds the pages first, and adds the results later. The open page shows the running
step."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Callable, Iterator
from http.client import HTTPException
from pathlib import Path
from typing import Any

import pytest

from tools.documents import METRICS
from tools.lock import HOLDER

pytestmark = pytest.mark.runs_tools

# A project with two test tasks. The first task waits until the file "go on" exists. The second task
# waits until the file "end" exists. The page shows whether the results of the first task exist.
PORTAL = """
import sys, time
from pathlib import Path
from tools import cli, make_portal
from tools.documents import FINDINGS
from tools.task_graph import Graph, Task
from tools.tasks import DOCUMENTS
from traceability.reading.task_record import TESTS_BOARD, TESTS_TRACE

root = Path(sys.argv[1])
result = "build/results/trace.json"

def write(name, text):
    (root / name).parent.mkdir(parents=True, exist_ok=True)
    (root / name).write_text(text)

def wait(name):
    while not (root / name).exists():
        time.sleep(0.02)

def documents(log):
    write("build/site/index.html", "results" if (root / result).exists() else "no results")
    write(FINDINGS, "[]")

def trace(log):
    wait("go on")
    write(result, "passed")

tests = [
    Task(TESTS_TRACE, trace, ("src",), (result,)),
    Task(TESTS_BOARD, lambda log: wait("end"), ("src",), after=(TESTS_TRACE,)),
]
def pages():
    shown = (result,) if (root / result).exists() else ()
    return [Task(DOCUMENTS, documents, ("src", *shown))]

cli.ROOT = root
make_portal.RESULT_TASKS = (TESTS_TRACE, TESTS_BOARD)
make_portal.graph = lambda root: Graph(root, tests)
make_portal.pages_graph = lambda root, out=sys.stdout: Graph(
    root, pages(), out, record=Path("build/pages.json"))
sys.exit(cli.main(["portal", "--no-open", *sys.argv[2:]]))
"""


class Project:
    def __init__(self, root: Path) -> None:
        self.root = root
        (root / "src").mkdir()
        (root / "src/a.cpp").write_text("int a;\n")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]

    def start(self, *options: str) -> subprocess.Popen[str]:
        environment = {name: value for name, value in os.environ.items() if name != HOLDER}
        words = [sys.executable, "-c", PORTAL, str(self.root), "--port", str(self.port), *options]
        return subprocess.Popen(
            words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment
        )

    def get(self, name: str) -> str:
        address = f"http://127.0.0.1:{self.port}/{name}"
        with urllib.request.urlopen(address, timeout=5) as answer:
            return str(answer.read().decode())

    def status(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self.get("status.json"))
        return found

    def until(self, holds: Callable[[], bool]) -> None:
        for _ in range(500):
            try:
                if holds():
                    return
            except (OSError, HTTPException):
                pass
            time.sleep(0.02)
        raise AssertionError("the page did not reach the expected state in time")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


@pytest.fixture
def portal(project: Project) -> Iterator[subprocess.Popen[str]]:
    with project.start() as program:
        yield program
        program.kill()


def test_pages_are_served_before_the_results_and_again_with_them(
    project: Project, portal: subprocess.Popen[str]
) -> None:
    project.until(lambda: project.status()["running"] != [])
    assert project.get("index.html") == "no results"
    first = project.status()
    assert [task["name"] for task in first["running"]] == ["tests (trace)"]
    assert [task["name"] for task in first["waiting"]] == ["tests (virtual K64)"]
    (project.root / "go on").touch()
    project.until(lambda: project.status()["pages"] != first["pages"])
    assert project.get("index.html") == "results"
    assert not project.status()["over"]
    (project.root / "end").touch()
    project.until(lambda: bool(project.status()["over"]))
    assert project.status()["running"] == project.status()["waiting"] == []
    times = json.loads((project.root / METRICS).read_text())
    assert 0 <= times["build.first_page_s"] <= times["build.cold_s"]
    portal.send_signal(signal.SIGINT)
    assert portal.wait(20) == 130


def test_what_was_interrupted_continues_and_the_rest_is_unchanged(
    project: Project, portal: subprocess.Popen[str]
) -> None:
    (project.root / "go on").touch()
    project.until(lambda: project.get("index.html") == "results")
    portal.send_signal(signal.SIGINT)
    assert portal.wait(20) == 130
    (project.root / "end").touch()
    with project.start("--no-serve") as again:
        assert again.stdout is not None
        printed = again.stdout.read()
    assert "tests (trace) ... unchanged" in printed
    assert re.search(r"tests \(virtual K64\) \.\.\. [\d.]+ s", printed)


def test_a_port_in_use_is_said_before_anything_is_measured(project: Project) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", project.port))
        taken.listen()
        with project.start() as program:
            assert program.stdout is not None
            printed = program.stdout.read()
    assert program.returncode == 1
    assert f"port {project.port} is in use" in printed
    assert "tests (trace)" not in printed
