"""If a step of ./wr lint passed, it is not repeated on unchanged files."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from tools.lint import LINT_RECORD, lint_tasks
from tools.task_graph import Graph
from traceability.reading.lint_record import PROSE, read_prose

pytestmark = [pytest.mark.runs_tools, pytest.mark.reads(".")]

ROOT = Path(__file__).parents[3]
GLOSSARY = "Glossary\n========\n\n.. glossary::\n\n   voltage\n      Not: tension.\n"


def run_prose(root: Path) -> str:
    out = io.StringIO()
    Graph(root, lint_tasks(root, quick=True), out, record=LINT_RECORD).run(["prose"])
    return out.getvalue()


def test_the_inputs_of_each_step_exist() -> None:
    for task in lint_tasks(ROOT, quick=False):
        assert all((ROOT / name).exists() for name in task.inputs), task.name


def test_the_prose_is_read_again_only_after_a_change(tmp_path: Path) -> None:
    page = tmp_path / "docs/page.rst"
    page.parent.mkdir()
    (page.parent / "glossary.rst").write_text(GLOSSARY)
    page.write_text("A voltage.\n")
    assert "unchanged" not in run_prose(tmp_path)
    assert "unchanged" in run_prose(tmp_path)
    (tmp_path / PROSE).unlink()
    assert "unchanged" not in run_prose(tmp_path)
    page.write_text("A tension.\n")
    assert "1 words that the glossary replaces" in run_prose(tmp_path)
    assert read_prose(tmp_path) == 1
    assert "1 words that the glossary replaces" in run_prose(tmp_path)
