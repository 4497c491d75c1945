"""./wr check: its findings, its measurements, and a file that it cannot read."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import TextIO, cast

import pytest

from tests.python.portal.fixture import make_module
from tests.python.project_files import write_files
from tools import check, documents
from tools.documents import CURRENT, FINDINGS, make_documents, read_findings
from tools.steps import FailureError, Steps
from tools.task_graph import Graph, Task
from tools.tasks import DOCUMENTS
from traceability.checks.document_checks import not_text
from traceability.model.build import Built, Facts
from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.reading.results import read_times
from traceability.schema import Finding, Place

FINDING = {
    "place": {"file": "src/a.hpp", "line": 3},
    "check": "module-secret",
    "text": "It has none.",
    "fix": "write one",
}


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns a project whose documents have one finding."""
    write_files(tmp_path, {"src/a.hpp": "first", "src/b.hpp": "first"})

    def make(_log: TextIO) -> None:
        write_files(tmp_path, {FINDINGS: json.dumps([FINDING])})

    documents = Task(DOCUMENTS, make, ("src",), (str(FINDINGS),))
    monkeypatch.setattr(check, "pages_graph", lambda root, **_: Graph(root, [documents]))
    return tmp_path


def test_unchanged_documents_keep_their_findings(
    tree: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for how in (" s", "unchanged"):
        assert check.check(tree) == 1
        printed = capsys.readouterr().out.splitlines()
        assert printed[0].endswith(how)
        assert printed[1] == "src/a.hpp:3: [module-secret] It has none.; write one"
        assert printed[2] == "1 finding"
    assert read_findings(tree) == [
        Finding(Place("src/a.hpp", 3), "module-secret", "It has none.", "write one")
    ]


def test_the_edit_of_one_file_is_measured(tree: Path) -> None:
    check.check(tree)
    assert read_times(tree) == {}
    write_files(tree, {"src/a.hpp": "second", "src/b.hpp": "second"})
    check.check(tree)
    assert read_times(tree) == {}
    (tree / "src/a.hpp").write_text("third")
    check.check(tree)
    assert set(read_times(tree)) == {"build.edit_s"}


def test_documents_that_could_not_be_made_fail_and_are_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(_log: TextIO) -> None:
        raise FailureError("a step failed")

    documents = Task(DOCUMENTS, fail, ("src",))
    monkeypatch.setattr(check, "pages_graph", lambda root, **_: Graph(root, [documents]))
    for _ in range(2):
        assert check.check(tmp_path) == 1
        assert "FAILED: a step failed" in capsys.readouterr().out


@pytest.mark.runs_tools
@pytest.mark.parametrize("ends", ["raise SystemError", "os.kill(os.getpid(), signal.SIGKILL)"])
def test_findings_of_earlier_documents_are_not_shown_when_the_process_ends_early(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, ends: str
) -> None:
    program = f"import os, signal\n{ends}\n"
    files = {str(FINDINGS): "[]", "tools/__init__.py": "", "tools/documents.py": program}
    write_files(tmp_path, files)
    made = Task(DOCUMENTS, partial(make_documents, tmp_path, sys.stdout, ""), ("src",))
    monkeypatch.setattr(check, "pages_graph", lambda root, **_: Graph(root, [made]))
    assert check.check(tmp_path) == 1
    printed = capsys.readouterr().out
    assert "the process of the documents ended early" in printed
    assert printed.splitlines()[-1] == (
        "the findings are not known, because the documents were not built"
    )


def test_a_file_that_is_not_text_is_found_at_its_line(tmp_path: Path) -> None:
    write_files(tmp_path, {"src/Pipe.hpp": "// größer\n"})
    (tmp_path / "src" / "Lamp.hpp").write_bytes(b"// one\n// tw\xf6\n")
    (found,) = not_text(tmp_path)
    assert (found.place.file, found.place.line) == ("src/Lamp.hpp", 2)
    assert found.text == "the byte 0xf6 is not UTF-8"


@pytest.fixture
def pages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    """Returns a function. This function builds the documents with the option ``keep``, and returns
    the printed lines."""
    for target, result in {
        "portal.site_build.build_site": SimpleNamespace(pages=1, warnings=[]),
        "portal.site_build.write_tool_files": None,
        "traceability.checks.run_checks": Report(findings=()),
        "traceability.exports.metrics_file.site_figures": {},
        "traceability.exports.metrics_file.write_metrics": tmp_path,
        "tools.documents.is_unreadable": False,
        "tools.documents.record_revision": None,
    }.items():
        monkeypatch.setattr(target, lambda *_, it=result: it)

    def made(*names: str, texts: str = "same", dead: tuple[Finding, ...] = ()) -> str:
        modules = {one: make_module(one, "", "", []) for one in names}
        built = Built(Model("", "", "", {}, modules=modules), cast("Facts", None))
        monkeypatch.setattr("traceability.model.build.build", lambda _root: built)
        monkeypatch.setattr("traceability.checks.run_link_checks", lambda *_: list(dead))
        printed = io.StringIO()
        kept = documents.Pages(tmp_path, texts, keep=True)
        documents.make(tmp_path, Steps(tmp_path, 4, printed), kept)
        return printed.getvalue()

    return made


def test_pages_stay_while_no_text_and_no_name_changes(
    tmp_path: Path, pages: Callable[..., str]
) -> None:
    assert "site ... 1 pages" in pages("Wheel")
    assert (tmp_path / CURRENT).exists()
    assert "./wr portal updates the pages" in pages("Wheel")
    assert not (tmp_path / CURRENT).exists(), "a command that needs the pages builds them"
    assert "site ... 1 pages" in pages("Wheel", "Mode")
    assert "site ... 1 pages" in pages("Wheel", "Mode", texts="other")
    assert "./wr portal updates the pages" in pages("Wheel", "Mode", texts="other")


def test_a_dead_link_is_found_in_each_run(pages: Callable[..., str]) -> None:
    dead = Finding(Place("docs/a.rst", 1), "link-site", "dead", "correct it")
    for _ in range(2):
        assert "links ... 1 finding" in pages("Wheel", dead=(dead,))
