"""What a review holds, and what makes it suspect."""

from __future__ import annotations

import argparse
import subprocess
from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from tools.review import review
from tools.steps import FailureError
from traceability.checks import run_checks
from traceability.model.build import build
from traceability.model.reviews import REVIEWS, read_reviews

TEST = "tests/main_control/WorkingTest.cpp"
HEADER = "src/main_control/operation_modes/Mode.hpp"
TEXT = "requirements/reading.dox"


def reviewed(root: Path) -> int:
    return review(root, argparse.Namespace(id="FR-15", name="A. Reader", yes=True))


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = write_tree(tmp_path_factory.mktemp("reviewed"))
    for words in (["init", "-q"], ["add", "src", "tests", "requirements"], ["commit", "-qm", "x"]):
        who = ["-c", "user.name=x", "-c", "user.email=x@x"]
        subprocess.run(["git", "-C", root, *who, *words], check=True)
    assert reviewed(root) == 0
    return root


def change(root: Path, file: str, old: str, new: str) -> None:
    path = root / file
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def suspect(root: Path) -> list[tuple[str, str]]:
    found = run_checks(*build(root)).findings
    return [(one.check, one.text) for one in found if one.check.startswith("suspect-")]


@pytest.fixture
def tree(sound: Path, tmp_path: Path) -> Path:
    root = tmp_path / "tree"
    subprocess.run(["cp", "-a", sound, root], check=True)
    return root


def test_a_reviewed_requirement_is_not_suspect(sound: Path) -> None:
    assert suspect(sound) == []
    known = read_reviews(sound)["FR-15"]
    assert known.reviewer == "A. Reader"
    assert set(known.hashes["method"]) == {"Mode::newMessage", "OperationState::read"}
    assert set(known.hashes["test"]) == {"Working.WaitsWithoutMessage"}


def test_one_that_nobody_reviewed_is(tree: Path) -> None:
    (tree / REVIEWS).unlink()
    assert suspect(tree) == [("suspect-requirement", "FR-15 was never reviewed")]


@pytest.mark.parametrize(
    ("file", "old", "new", "check"),
    [
        (TEXT, "if no message", "whenever no message", "suspect-requirement"),
        (TEXT, "@priority high", "@priority low", "suspect-requirement"),
        (HEADER, "true when there is one", "false when there is one", "suspect-method"),
        (HEADER, "newMessage() const", "newMessage()", "suspect-method"),
        (HEADER, "  /// @satisfies FR-15\n", "", "suspect-method"),
        (TEST, "EXPECT_TRUE(true)", "EXPECT_FALSE(false)", "suspect-test"),
        (TEST, "/// @verifies FR-15\n", "", "suspect-test"),
        (TEST, "WaitsWithoutMessage", "Waits", "suspect-test"),
    ],
)
def test_what_was_reviewed_and_changed_is(
    tree: Path, file: str, old: str, new: str, check: str
) -> None:
    change(tree, file, old, new)
    assert {name for name, _ in suspect(tree)} == {check}


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        (TEXT, "set a waiting state", "set a\n  waiting state"),
        (
            HEADER,
            "an order has come.",
            "an\n  /// order has come.",
        ),
        (TEST, "EXPECT_TRUE(true);", "EXPECT_TRUE( true );  // at once"),
    ],
)
def test_formatting_does_not_matter(tree: Path, file: str, old: str, new: str) -> None:
    change(tree, file, old, new)
    assert suspect(tree) == []


def test_a_review_shows_what_changed_and_is_recorded(
    tree: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    change(tree, TEST, "EXPECT_TRUE(true)", "EXPECT_FALSE(false)")
    assert reviewed(tree) == 0
    said = capsys.readouterr().out
    assert "-  EXPECT_TRUE(true);" in said
    assert "+  EXPECT_FALSE(false);" in said
    assert suspect(tree) == []
    assert reviewed(tree) == 0
    assert "Nothing changed since A. Reader" in capsys.readouterr().out


def test_a_review_needs_a_known_id_and_someone_who_answers(
    tree: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    change(tree, TEST, "EXPECT_TRUE(true)", "EXPECT_FALSE(false)")
    monkeypatch.setattr("sys.stdin.isatty", lambda: False)
    for identifier, name, yes in (("all", "A", True), ("FR-15", None, True), ("FR-15", "A", False)):
        with pytest.raises(FailureError):
            review(tree, argparse.Namespace(id=identifier, name=name, yes=yes))
    assert len(suspect(tree)) == 1
