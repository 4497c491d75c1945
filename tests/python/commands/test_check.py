"""./wr check makes the documents anew where something has changed, and only there."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from traceability.checks.documents import not_text
from traceability.commands import check
from traceability.commands.steps import Steps
from traceability.made import RECORD, SITE, read_made
from traceability.model.schema import Finding, Place

FINDING = Finding(Place("src/a.hpp", 3), "module-secret", "It has none.", "write one")


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project whose documents are one page."""
    for name in ("src/a.hpp", "build/results/trace.json"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).write_text("first")

    def make_anew(root: Path, *_: object) -> tuple[list[Finding], bool]:
        (root / SITE).mkdir(parents=True, exist_ok=True)
        (root / SITE / "index.html").write_text("page")
        made.append(root)
        return [FINDING], True

    monkeypatch.setattr(check, "make_anew", make_anew)
    made.clear()
    assert documents(tmp_path) == [FINDING]
    assert made == [tmp_path]
    return tmp_path


made: list[Path] = []


def documents(root: Path) -> list[Finding]:
    return check.make_documents(root, Steps(root, 4, io.StringIO()))


def test_unchanged_documents_stay_and_so_do_their_findings(tree: Path) -> None:
    assert documents(tree) == [FINDING]
    assert made == [tree]


@pytest.mark.parametrize("name", ["src/a.hpp", "build/results/trace.json", "docs/new.rst"])
def test_a_change_of_what_is_read_makes_them_anew(tree: Path, name: str) -> None:
    (tree / name).parent.mkdir(exist_ok=True)
    (tree / name).write_text("second")
    documents(tree)
    assert made == [tree, tree]


def test_a_removed_page_is_made_anew(tree: Path) -> None:
    (tree / SITE / "index.html").unlink()
    documents(tree)
    assert made == [tree, tree]


def test_documents_that_could_not_be_made_are_made_anew(
    tree: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(check, "make_anew", lambda *_: ([], False))
    (tree / "src/a.hpp").write_text("second")
    assert documents(tree) == []
    kept = read_made(tree)
    assert kept is not None
    assert kept.findings == [FINDING]
    (tree / RECORD).unlink()
    assert read_made(tree) is None


def test_only_a_first_run_and_an_edit_of_one_file_are_measured() -> None:
    assert set(check.measured(0.0, None)) == {"build.cold_s"}
    assert set(check.measured(0.0, 1)) == {"build.edit_s"}
    assert check.measured(0.0, 2) == {}
    assert check.count_changes({"a": "1", "b": "1"}, {"a": "2", "c": "1"}) == 3


def test_a_file_that_is_not_text_is_found_at_its_line(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "Lamp.hpp").write_bytes(b"// one\n// tw\xf6\n")
    (tmp_path / "src" / "Pipe.hpp").write_text("// größer\n", encoding="utf-8")
    (found,) = not_text(tmp_path)
    assert (found.place.file, found.place.line) == ("src/Lamp.hpp", 2)
    assert found.text == "the byte 0xf6 is not UTF-8"
