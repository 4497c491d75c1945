"""The last commit of each file is read from git."""

from __future__ import annotations

import subprocess
from pathlib import Path

from traceability.reading.last_changes import last_changes


def commit(folder: Path, date: str, **files: str) -> None:
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    person = ["-c", "user.name=A", "-c", "user.email=a@b.c"]
    for words in (["add", "-A"], [*person, "commit", "-qm", "change", "--date", date]):
        subprocess.run(
            ["git", "-C", str(folder), *words],
            check=True,
            env={"GIT_COMMITTER_DATE": date, "PATH": "/usr/bin:/bin"},
        )


def test_a_file_has_its_newest_commit(tmp_path: Path) -> None:
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    commit(tmp_path, "2026-01-02T00:00:00Z", one="a", two="b")
    commit(tmp_path, "2026-03-04T00:00:00Z", two="c")
    found = last_changes(tmp_path)
    assert found["one"].startswith("2026-01-02 ")
    assert found["two"].startswith("2026-03-04 ")


def test_a_folder_without_git_has_no_changes(tmp_path: Path) -> None:
    assert last_changes(tmp_path) == {}
