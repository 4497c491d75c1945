"""The record of ./wr lint is used only while the input files of ./wr lint are unchanged."""

from __future__ import annotations

from pathlib import Path

from traceability.reading.lint_record import (
    FAILED,
    NOT_RUN,
    PASSED,
    files_hash,
    read_exemptions,
    read_lint,
    write_lint,
)
from traceability.schema import Exemption, LintRun, Place


def test_the_record_of_other_files_is_not_read(tmp_path: Path) -> None:
    source = tmp_path / "src" / "a.cpp"
    source.parent.mkdir()
    source.write_text("int a;\n")
    assert read_lint(tmp_path) is None
    write_lint(tmp_path, {"ruff": PASSED, "mypy": FAILED}, "c0ffee", files_hash(tmp_path))
    assert read_lint(tmp_path) == LintRun("c0ffee", {"ruff": PASSED, "mypy": FAILED})
    source.write_text("int b;\n")
    assert read_lint(tmp_path) is None


def test_a_step_that_did_not_run_keeps_its_result_for_the_same_files(tmp_path: Path) -> None:
    before = files_hash(tmp_path)
    write_lint(tmp_path, {"ruff": PASSED, "clang-tidy": PASSED}, "c0ffee", before)
    write_lint(tmp_path, {"ruff": FAILED, "clang-tidy": NOT_RUN}, "c0ffee", before)
    assert read_lint(tmp_path) == LintRun("c0ffee", {"ruff": FAILED, "clang-tidy": PASSED})


def test_files_that_change_while_the_steps_run_leave_no_record(tmp_path: Path) -> None:
    before = files_hash(tmp_path)
    write_lint(tmp_path, {"ruff": PASSED}, "c0ffee", before)
    (tmp_path / "wr").write_text("changed\n")
    write_lint(tmp_path, {"ruff": PASSED}, "c0ffee", before)
    assert read_lint(tmp_path) is None
    (tmp_path / "wr").unlink()
    assert read_lint(tmp_path) is None


def test_exemptions_are_listed_from_the_files_that_clang_tidy_reads(tmp_path: Path) -> None:
    for name in ("src/a.cpp", "ports/can/a.hpp", "ports/can/tests/a.cpp", "tests/a.cpp"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("int a;\n  int b;  // NOLINT(misc-x,misc-y): a register\n")
    assert read_exemptions(tmp_path) == [
        Exemption(Place(name, 2), "misc-x,misc-y", "a register")
        for name in ("ports/can/a.hpp", "src/a.cpp")
    ]
