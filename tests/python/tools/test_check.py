"""./wr check: its findings, its measurements, and a file that it cannot read."""

from __future__ import annotations

import json
import sys
from functools import partial
from pathlib import Path
from typing import TextIO

import pytest

from tools import check
from tools.documents import FINDINGS, make_documents, read_findings, read_times
from tools.steps import FailureError
from tools.task_graph import Graph, Task
from tools.tasks import DOCUMENTS
from traceability.checks.document_checks import not_text
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
    for name in ("src/a.hpp", "src/b.hpp"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("first")

    def make(_log: TextIO) -> None:
        (tmp_path / FINDINGS).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / FINDINGS).write_text(json.dumps([FINDING]))

    documents = Task(DOCUMENTS, make, ("src",), (str(FINDINGS),))
    monkeypatch.setattr(check, "pages_graph", lambda root: Graph(root, [documents]))
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
    for name in ("src/a.hpp", "src/b.hpp"):
        (tree / name).write_text("second")
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
    monkeypatch.setattr(check, "pages_graph", lambda root: Graph(root, [documents]))
    for _ in range(2):
        assert check.check(tmp_path) == 1
        assert "FAILED: a step failed" in capsys.readouterr().out


@pytest.mark.runs_tools
@pytest.mark.parametrize("ends", ["raise SystemError", "os.kill(os.getpid(), signal.SIGKILL)"])
def test_findings_of_earlier_documents_are_not_shown_when_the_process_ends_early(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, ends: str
) -> None:
    (tmp_path / FINDINGS).parent.mkdir(parents=True)
    (tmp_path / FINDINGS).write_text("[]", encoding="utf-8")
    (tmp_path / "tools").mkdir()
    (tmp_path / "tools/__init__.py").touch()
    (tmp_path / "tools/documents.py").write_text(f"import os, signal\n{ends}\n", encoding="utf-8")
    made = Task(DOCUMENTS, partial(make_documents, tmp_path, sys.stdout), ("src",))
    monkeypatch.setattr(check, "pages_graph", lambda root: Graph(root, [made]))
    assert check.check(tmp_path) == 1
    printed = capsys.readouterr().out
    assert "the process of the documents ended early" in printed
    assert printed.splitlines()[-1] == "the findings are not known"


def test_a_file_that_is_not_text_is_found_at_its_line(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "Lamp.hpp").write_bytes(b"// one\n// tw\xf6\n")
    (tmp_path / "src" / "Pipe.hpp").write_text("// größer\n", encoding="utf-8")
    (found,) = not_text(tmp_path)
    assert (found.place.file, found.place.line) == ("src/Lamp.hpp", 2)
    assert found.text == "the byte 0xf6 is not UTF-8"
