"""./wr diff, and ./wr impact with commits. The commits are real commits of a small project."""

import re
from pathlib import Path

import pytest

from tests.python.git_project import git
from tests.python.model.small_tree import write_tree
from tests.python.project_files import write_files
from tools import cli
from traceability.exports.revision import read_revision
from traceability.reading.comparison_record import read_comparison
from traceability.sources import FRAMES
from weeding_robot_client import exit_codes

pytestmark = pytest.mark.reads("design/frames.toml")

OTHERS = {
    "tools/a.py": "A = 1\n",
    "tests/python/tools/test_a.py": "from tools.a import A\n",
    "tests/python/tools/test_b.py": "B = 1\n",
    "docs/a.rst": "A\n",
    "sim/a.scenario": "at 0 end\n",
}


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns a project with two commits. The second commit changes the text of a requirement and
    the header of a module."""
    root = write_tree(tmp_path / "project")
    (root / ".gitignore").write_text("/build/\n")
    git(root, "init", "--quiet")
    commit(root, "first")
    (path,) = sorted((root / "requirements").glob("*.dox"))
    old = path.read_text()
    assert " shall " in old
    path.write_text(old.replace(" shall ", " shall always ", 1))
    header = root / "src/main_control/MainController.hpp"
    header.write_text(f"{header.read_text()}\n")
    commit(root, "second")
    monkeypatch.setattr(cli, "ROOT", root)
    return root


def commit(root: Path, message: str) -> None:
    git(root, "add", "--all")
    git(root, "commit", "--quiet", "--message", message)


def test_the_sources_of_two_commits_are_compared(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["diff", "HEAD~1"]) == 0
    shown = capsys.readouterr().out
    assert "text of requirements: 1" in shown
    assert "{+always+}" in shown
    assert "has no recorded results" in shown
    assert read_revision(root, git(root, "rev-parse", "HEAD~1"))
    compared = read_comparison(root)
    assert compared
    assert compared.differences[0].section == "text of requirements"
    assert compared.second == git(root, "rev-parse", "HEAD")
    assert list(compared.unmeasured) == [compared.first, compared.second]
    assert cli.main(["diff", "HEAD", "HEAD"]) == 0
    assert capsys.readouterr().out.startswith("no differences")


def test_changed_files_that_are_not_followed_are_listed(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The changed files are a page, a scenario, two Python tests, and a tool. One of these tests
    imports the tool."""
    write_files(root, OTHERS)
    commit(root, "third")
    assert cli.main(["impact", "HEAD~1..HEAD"]) == 0
    shown = capsys.readouterr().out
    assert "run again: 2 files of Python tests" in shown
    assert "tests/python/tools/test_a.py  changed" in shown
    assert "tests/python/tools/test_b.py  changed" in shown
    assert shown.endswith(
        "effects unknown: 2 files; run ./wr test --all\n  docs/a.rst\n  sim/a.scenario\n"
    )
    assert cli.main(["diff", "HEAD~1"]) == 0
    shown = capsys.readouterr().out
    assert "no differences" not in shown
    for name in OTHERS:
        assert re.search(rf"{name} +\+\d+ -0 lines; content not compared", shown)


def test_the_impact_of_one_python_file_is_that_of_its_imports(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_files(root, OTHERS)
    assert cli.main(["impact", str(root / "tools/a.py")]) == 0
    shown = capsys.readouterr().out
    assert "tests/python/tools/test_a.py  imports tools/a.py" in shown
    assert "test_b.py" not in shown
    assert "effects unknown" not in shown


def test_a_change_of_the_frames_affects_the_tests_that_read_them(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    test = "tests/python/client/test_c.py"
    layout = "from weeding_robot_client.layout import LAYOUTS\n"
    write_files(root, {FRAMES[0]: "", FRAMES[1]: "", test: layout})
    assert cli.main(["impact", str(root / FRAMES[0])]) == 0
    assert f"{test}  imports {FRAMES[1]}" in capsys.readouterr().out


def test_an_unknown_commit_is_an_error(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for command in (["diff", "nothing"], ["impact", "nothing..HEAD"]):
        with pytest.raises(SystemExit, match=str(exit_codes.USAGE)):
            cli.main(command)
        assert "git has no commit nothing" in capsys.readouterr().err
    assert root.exists()


def test_the_impact_of_commits_is_that_of_their_files(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["impact", "HEAD~1..HEAD"]) == 0
    shown = capsys.readouterr().out
    assert "MainController  is written in src/main_control/MainController.hpp" in shown
    assert cli.main(["impact", "HEAD..HEAD"]) == 0
    assert "begins with" not in capsys.readouterr().out
    assert root.exists()
