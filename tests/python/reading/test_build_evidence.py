from pathlib import Path

import pytest

from tests.python.reading.task_records import record_task
from traceability.reading.build_evidence import (
    git,
    library_version,
    program_version,
    read_hashes,
)
from traceability.reading.task_record import CLOSED_LOOP


def test_the_output_of_git_is_empty_when_git_is_not_installed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert git(tmp_path, "rev-parse", "HEAD") == ""


def test_the_version_of_a_program_is_the_first_number_with_a_point(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "spin"
    program.write_text("#!/bin/sh\n[ $1 = -V ] && echo 'Spin Version 6.5.2 -- 6 December 2019'\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin")
    assert program_version("spin", "-V") == "6.5.2"
    assert program_version("spin", "--version") == "unknown"
    assert program_version("absent", "--version") == "not installed"


def test_the_version_of_a_library_comes_from_its_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert library_version("libunicorn-dev") == "unknown"
    program = tmp_path / "dpkg-query"
    program.write_text("#!/bin/sh\n[ $3 = libunicorn-dev ] && printf 2.0.1\n")
    program.chmod(0o755)
    assert library_version("libunicorn-dev") == "2.0.1"
    assert library_version("libabsent-dev") == "not installed"


def test_a_result_of_older_sources_has_no_hash(tmp_path: Path) -> None:
    source, result = tmp_path / "src/a.cpp", tmp_path / "build/results/closed_loop.json"
    for path in (source, result):
        path.parent.mkdir(parents=True)
        path.write_text("1")
    record_task(tmp_path, CLOSED_LOOP, "src")
    assert [item.kind for item in read_hashes(tmp_path)] == ["input", "result"]
    source.write_text("22")
    assert [item.kind for item in read_hashes(tmp_path)] == ["input"]
