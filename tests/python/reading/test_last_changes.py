"""The last commit of each file, and the changes since a commit, read from git."""

from __future__ import annotations

import subprocess
from pathlib import Path

from tests.python.git_project import git
from traceability.reading.last_changes import changed_since, last_changes


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


def test_the_newest_change_of_a_day_is_first(tmp_path: Path) -> None:
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    for hour, name in enumerate(("one", "two", "three")):
        commit(tmp_path, f"2026-01-02T{hour:02}:00:00Z", **{name: "a"})
    assert list(last_changes(tmp_path)) == ["three", "two", "one"]


def test_a_merge_changes_the_files_that_differ_from_all_its_parents(tmp_path: Path) -> None:
    git(tmp_path, "init", "-q", "-b", "main")
    commit(tmp_path, "2026-01-02T00:00:00Z", one="a", two="a")
    git(tmp_path, "checkout", "-qb", "branch")
    commit(tmp_path, "2026-01-03T00:00:00Z", one="b")
    git(tmp_path, "checkout", "-q", "main")
    commit(tmp_path, "2026-01-04T00:00:00Z", three="a")
    git(tmp_path, "merge", "-q", "--no-commit", "branch")
    commit(tmp_path, "2026-01-05T00:00:00Z", two="merged")
    found = last_changes(tmp_path)
    assert {name: change.split()[0] for name, change in found.items()} == {
        "one": "2026-01-03",
        "two": "2026-01-05",
        "three": "2026-01-04",
    }


def test_a_folder_without_git_has_no_changes(tmp_path: Path) -> None:
    assert last_changes(tmp_path) == {}


def test_a_changed_comment_is_no_change_of_the_firmware(tmp_path: Path) -> None:
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    for folder in ("src", "extensions", "sim"):
        (tmp_path / folder).mkdir()
    code = "// old\nint a;  // old\n"
    files = {"src/a.cpp": code, "extensions/b.hpp": "int b;\n", "sim/c.cpp": "c"}
    commit(tmp_path, "2026-01-02T00:00:00Z", **files)
    first = last_changes(tmp_path)["src/a.cpp"].split()[1]
    (tmp_path / "src/a.cpp").write_text("// new\nint a;  ///< new\n", encoding="utf-8")
    (tmp_path / "sim/c.cpp").write_text("d", encoding="utf-8")
    assert changed_since(tmp_path, first) == 0
    (tmp_path / "extensions/b.hpp").write_text("int d;\n", encoding="utf-8")
    assert changed_since(tmp_path, first) == 1


def test_changes_since_an_unknown_commit_are_not_known(tmp_path: Path) -> None:
    assert changed_since(tmp_path, "aab5f7d322") is None
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    commit(tmp_path, "2026-01-02T00:00:00Z", one="a")
    assert changed_since(tmp_path, "aab5f7d322") is None
    assert changed_since(tmp_path, "") is None
