"""The cost of the safety extensions, as git counts it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.git_project import git
from tests.python.project_files import write_files
from traceability.reading.safety_cost import correction_of, edits_of_code, read_cost
from traceability.schema import Correction, Place, SafetyCase, TouchedFile

WHERE = Place("design/safety_case.toml", 1)


def commit(root: Path, files: dict[str, str]) -> str:
    write_files(root, files)
    git(root, "add", "-A")
    git(root, "commit", "-q", "-m", "A change")
    return git(root, "rev-parse", "HEAD")


@pytest.fixture
def project(tmp_path: Path) -> tuple[Path, str]:
    """Returns a project with two commits, and the hash of the first commit. The second commit edits
    modules. The edit in ``src/sensing`` may count as a correction. The second commit also adds a
    module of the robot and a module of an extension."""
    git(tmp_path, "init", "-q")
    base = commit(
        tmp_path,
        {
            "src/Mode": "one\ntwo\n",
            "src/Text": "/// A class.\none  // line\n",
            "src/sensing/Hall": "one\n",
            "docs/page": "a\n",
        },
    )
    commit(
        tmp_path,
        {
            "src/Mode": "one\n2\nthree\n",
            "src/Text": "/// Another comment\n/// of the class.\none\n",
            "src/sensing/Hall": "one\ntwo\n",
            "src/New": "x\n",
            "extensions/safety/Stop": "a\nb\nc\n",
            "docs/page": "b\n",
        },
    )
    return tmp_path, base


FILTER = Correction(["src/sensing/"], "A bug.", WHERE)
PARTLY = Correction(["src/sensing/"], "A bug.", WHERE, for_safety=1)
ELSEWHERE = Correction(["src/none/"], "Nothing was edited there.", WHERE, for_safety=100)


@pytest.mark.parametrize(
    ("corrections", "reason", "for_safety"),
    [([], "", 4), ([FILTER], "A bug.", 3), ([PARTLY, ELSEWHERE], "A bug.", 4)],
)
def test_edits_of_existing_modules_are_counted_and_new_files_listed(
    project: tuple[Path, str], corrections: list[Correction], reason: str, for_safety: int
) -> None:
    root, base = project
    cost = read_cost(root, SafetyCase(base=base, corrections=corrections))
    assert cost is not None
    assert (cost.files_added, cost.lines_added) == (["extensions/safety/Stop"], 3)
    assert cost.touched == [
        TouchedFile("src/Mode", 2, 1, ""),
        TouchedFile("src/sensing/Hall", 1, 0, reason),
    ]
    assert cost.for_safety == for_safety


def test_without_the_whole_history_there_is_no_cost(
    project: tuple[Path, str], tmp_path_factory: pytest.TempPathFactory
) -> None:
    root, base = project
    assert read_cost(root, SafetyCase(base="0" * 40)) is None
    assert read_cost(root, SafetyCase()) is None
    folder = tmp_path_factory.mktemp("other")
    assert read_cost(folder, SafetyCase(base="HEAD")) is None
    git(root, "clone", "-q", "--depth", "1", f"file://{root}", str(folder / "shallow"))
    assert read_cost(folder / "shallow", SafetyCase(base=base)) is None


def test_the_longest_path_decides() -> None:
    folder = Correction(["src/k64/"], "The board.", WHERE)
    file = Correction(["src/k64/Uart.cpp"], "The port.", WHERE)
    assert correction_of("src/k64/Uart.cpp", [folder, file]) is file
    assert correction_of("src/k64/Adc.cpp", [folder, file]) is folder
    assert correction_of("src/k64x/Adc.cpp", [folder, file]) is None


@pytest.mark.parametrize("file", ["src/CMakeLists.txt", "src/identity.cmake"])
def test_comments_of_cmake_do_not_count(file: str) -> None:
    before = 'set(A "#1")  # one\n# a comment\n'
    same = 'set(A "#1")  # another\n# a new comment\n# of two lines\n'
    assert edits_of_code(file, before, same) == TouchedFile(file, 0, 0)
    assert edits_of_code(file, before, 'set(A "#2")\n') == TouchedFile(file, 1, 1)
