"""The ports, with their files and changed lines, and with the results that belong to the present
sources."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.python.project_files import write_files
from traceability.reading import task_record
from traceability.reading.ports import RESULT, read_ports
from traceability.reading.toml_reader import Entries

DECLARED = 'title = "A line"\nsays = "It is another line."\ntests = "t"\nimage = "i"\n'
PATCH = """\
--- a/src/k64/pins.hpp
+++ b/src/k64/pins.hpp
@@ -1 +1 @@
-old
+new
--- a/src/k64/start_up/platform.cpp
+++ b/src/k64/start_up/platform.cpp
@@ -1,2 +1,3 @@
-old
-old
+new
+new
+new
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    files = {
        "ports/line/port.toml": DECLARED,
        "ports/line/Port.cpp": "a\nb\n",
        "ports/line/tests/PortTest.cpp": "a\n",
        "ports/Shared.hpp": "a\n",
    }
    return write_files(tmp_path, files)


def write_result(project: Path, result: str) -> None:
    test = {"name": "Runs", "status": "RUN", "result": result, "time": "0s", "file": "", "line": 1}
    size = {"flash": 2, "ram": 1}
    suites = {"line": {"testsuites": [{"name": "Line", "testsuite": [test]}], "image": size}}
    write_files(project, {RESULT: json.dumps(suites)})


def test_a_port_has_its_files_and_the_shared_ones_but_no_tests(project: Path) -> None:
    port = read_ports(project, Entries(project))["line"]
    assert port.files == {"ports/Shared.hpp": 1, "ports/line/Port.cpp": 2}
    assert (port.title, port.outside_lines, port.composition_lines) == ("A line", 0, 0)


def test_the_changed_lines_of_a_port_are_those_of_its_patch(project: Path) -> None:
    (project / "ports/line/composition.patch").write_text(PATCH)
    port = read_ports(project, Entries(project))["line"]
    assert (port.outside_lines, port.composition_lines) == (1, 2)


def test_a_port_without_a_title_is_not_read(project: Path) -> None:
    (project / "ports/line/port.toml").write_text('says = "It is another line."\n')
    entries = Entries(project)
    assert read_ports(project, entries) == {}
    assert entries.problems


@pytest.mark.parametrize("fresh", [True, False])
def test_results_count_for_the_present_sources_only(
    project: Path, monkeypatch: pytest.MonkeyPatch, fresh: bool
) -> None:
    monkeypatch.setattr(task_record, "is_fresh", lambda *_: fresh)
    write_result(project, "COMPLETED")
    port = read_ports(project, Entries(project))["line"]
    assert port.tests == ({"Line.Runs": "passed"} if fresh else None)
    assert port.passed is fresh
    assert port.size == ({"flash": 2, "ram": 1} if fresh else {})


def test_a_port_whose_test_was_skipped_has_not_passed(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(task_record, "is_fresh", lambda *_: True)
    write_result(project, "SKIPPED")
    assert not read_ports(project, Entries(project))["line"].passed
