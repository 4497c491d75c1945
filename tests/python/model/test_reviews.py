"""The baseline of a requirement, the changes that make the requirement suspect, and the review by a
person."""

from __future__ import annotations

import argparse
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.python.git_project import git
from tests.python.model.small_tree import write_tree
from tests.python.project_files import replace_in, write_files
from tools.review import review
from tools.steps import FailureError
from traceability.checks import run_checks
from traceability.model.build import build
from traceability.model.reviews import BASELINE, QUESTIONS, REVIEWS, read_baseline
from traceability.reading.link_texts import FINDERS, code_with_bounds, hash_of

TEST = "tests/main_control/WorkingTest.cpp"
HELPER = "tests/support/helper.hpp"
SCENARIO = "sim/scenario/examples/waiting.scenario"
HEADER = "src/main_control/operation_modes/Mode.hpp"
BODY = "src/main_control/operation_states/OperationState.cpp"
TEXT = "requirements/reading.dox"
TREE = "design/trees/reading.tree"
REMARK = "Read the text, the tree and the test; both limits are there."
REASONS, PAGE = "design/justified.toml", "docs/page.rst"
OTHERS = "src/main_control/operation_states/helper.cpp"
TYPES = "src/services/Kind.hpp"
SAFETY_PAGE = "docs/bring_up.rst"
PLANT = "sim/plant/Plant.hpp"
TEXTS = {
    REASONS: '[[method]]\nnames = ["one"]\nwhy = "The timers of the robot never stop."\n',
    PAGE: "Memory\n======\n\nThe stack has 8 KB.\n",
    OTHERS: "namespace wr {\nint helper() {\n  return 1;\n}\n}  // namespace wr\n",
    TYPES: "namespace wr {\nenum class Kind {\n  First = 1,\n};\n}  // namespace wr\n",
    SAFETY_PAGE: "Wires\n=====\n\nConnect nothing to this plug.\n",
    PLANT: "struct Plant {\n  double mass = 175.0;\n};\n",
}
OTHER = {"name": "Ada Reader", "email": "ada@example.org"}


def options(*ids: str, baseline: bool = False, **person: str) -> argparse.Namespace:
    chosen = {"name": None, "email": None, **person}
    return argparse.Namespace(ids=list(ids), baseline=baseline, **chosen)


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = write_tree(tmp_path_factory.mktemp("baseline"))
    (root / TEST).write_text('#include "support/helper.hpp"\n' + (root / TEST).read_text())
    replace_in(root / TEST, "EXPECT_TRUE(true)", 'EXPECT_TRUE(plays("waiting"))')
    write_files(root, {HELPER: "constexpr int kLimit = 5;\n", SCENARIO: "at 5 order 1\n"})
    assert review(root, options(baseline=True)) == 0
    git(root, "init", "-q")
    git(root, "add", "src", "tests", "requirements", "design", "sim")
    git(root, "commit", "-qm", "x")
    return root


def findings(root: Path, check: str) -> list[tuple[str, str]]:
    found = run_checks(*build(root)).findings
    return [(finding.check, finding.text) for finding in found if finding.check.startswith(check)]


@pytest.fixture
def tree(sound: Path, tmp_path: Path) -> Path:
    root = tmp_path / "tree"
    subprocess.run(["cp", "-a", sound, root], check=True)
    return root


@pytest.fixture
def answers(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Simulates the answers of the person: yes to each question, and a remark."""
    typed = [*("yes" for _ in QUESTIONS), REMARK]
    rest: Iterator[str] = iter(typed)

    def typed_next(question: str) -> str:
        assert question
        nonlocal rest
        return next(rest)

    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    monkeypatch.setattr("builtins.input", typed_next)
    return typed


def test_a_requirement_with_a_baseline_is_not_suspect(sound: Path) -> None:
    assert findings(sound, "suspect") == []
    links = read_baseline(sound).links["FR-15"]
    assert {key.split(" ")[0] for key in links} == {
        *("requirement", "tree", "method", "body", "test", "support")
    }
    assert {f"support {file}" for file in (TEST, HELPER, SCENARIO)} <= set(links)


def test_one_without_a_baseline_is(tree: Path) -> None:
    (tree / BASELINE).unlink()
    found = findings(tree, "suspect")
    assert ("suspect-requirement", "FR-15: its text has no baseline") in found
    assert [name for name, _ in found] == ["suspect-design", "suspect-requirement"]


@pytest.mark.parametrize(
    ("file", "old", "new", "check"),
    [
        (TEXT, "if no message", "whenever no message", "suspect-requirement"),
        (TEXT, "@priority high", "@priority low", "suspect-requirement"),
        (TREE, "Working::actionNoMsg", "Working::actionNoMsg ?", "suspect-requirement"),
        (HEADER, "true when there is one", "false when there is one", "suspect-method"),
        (HEADER, "newMessage() const", "newMessage()", "suspect-method"),
        (HEADER, "  /// @satisfies FR-15\n", "", "suspect-method"),
        (BODY, "if (md.newMessage())", "if (!md.newMessage())", "suspect-method"),
        (TEST, "EXPECT_TRUE", "EXPECT_FALSE", "suspect-test"),
        (TEST, "/// @verifies FR-15\n", "", "suspect-test"),
        (TEST, "WaitsWithoutMessage", "Waits", "suspect-test"),
        (HELPER, "kLimit = 5", "kLimit = 50", "suspect-test"),
        (SCENARIO, "order 1", "order 2", "suspect-test"),
    ],
)
def test_each_text_that_carries_the_verdict_counts(
    tree: Path, file: str, old: str, new: str, check: str
) -> None:
    replace_in(tree / file, old, new)
    assert {name for name, _ in findings(tree, "suspect")} == {check}


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        (TEXT, "set a waiting state", "set a\n  waiting state"),
        (HEADER, "an order has arrived.", "an\n  /// order has arrived."),
        (BODY, "if (md.newMessage())", "// asks\n  if ( md.newMessage() )"),
        (TEST, "EXPECT_TRUE(", "// at once\n  EXPECT_TRUE( "),
        (SCENARIO, "order 1", "order 1  # the only one"),
    ],
)
def test_formatting_and_remarks_do_not_matter(tree: Path, file: str, old: str, new: str) -> None:
    replace_in(tree / file, old, new)
    assert findings(tree, "suspect") == []


@pytest.mark.parametrize(
    ("before", "after", "same"),
    [
        ("int one = read(two);", "int renamed = read(two);", True),
        ("for (auto& one : all) use(one);", "for (auto& item : all) use(item);", True),
        ("int one = 1; int two = 2; use(one);", "int one = 1; int two = 2; use(two);", False),
        ("int one = 1; use(other);", "int other = 1; use(other);", False),
        ("int one = 1; use(a.one);", "int other = 1; use(a.other);", False),
        ("return read(two);", "return write(two);", False),
        ("unsigned int one = 1;", "unsigned long one = 1;", False),
        ("// bound: 4\n  run();", "// bound: 5\n  run();", False),
    ],
)
def test_only_the_name_of_a_local_variable_does_not_matter(
    before: str, after: str, same: bool
) -> None:
    hashes = {hash_of("body", code_with_bounds(text)) for text in (before, after)}
    assert (len(hashes) == 1) == same


def test_the_constants_of_a_file_are_whole_tables_and_objects() -> None:
    text = (
        'constexpr auto kRows = to_array<Row>({{1, "low; high"}, {2, "end"}});\n'
        'constinit K64Gpio red(pinOf("light_red"));\n'
    )
    (found,) = FINDERS["constants"](text, "file.cpp")
    assert '"end"' in found
    assert "light_red" in found


def test_a_lost_tag_is_shown_at_the_method(tree: Path) -> None:
    replace_in(tree / HEADER, "  /// @satisfies FR-15\n", "")
    (found,) = (one for one in run_checks(*build(tree)).findings if one.check == "suspect-method")
    assert found.place.file == HEADER
    assert "has lost the tag @satisfies FR-15" in found.text


@pytest.mark.parametrize(
    ("file", "old", "new", "name"),
    [
        (REASONS, "never stop", "often stop", "the text design/justified.toml method.one.why"),
        (PAGE, "8 KB", "16 KB", "the numbers and names in the section docs/page.rst Memory"),
        (OTHERS, "return 1;", "return 2;", f"helper in {OTHERS}"),
        (TYPES, "First = 1", "First = 2", f"a constant in {TYPES}"),
        (SAFETY_PAGE, "nothing", "the motor", f"the text of the section {SAFETY_PAGE} Wires"),
        (PLANT, "175.0", "75.0", f"the code in {PLANT}"),
    ],
)
def test_a_text_without_a_requirement_has_a_baseline(
    tree: Path, file: str, old: str, new: str, name: str
) -> None:
    write_files(tree, TEXTS)
    assert review(tree, options(baseline=True)) == 0
    assert findings(tree, "suspect") == []
    replace_in(tree / file, old, new)
    expected = ("suspect-design", f"{name} changed since the baseline")
    assert findings(tree, "suspect") == [expected]
    assert review(tree, options("design", baseline=True)) == 0
    assert findings(tree, "suspect") == []


def test_other_words_of_a_page_may_change(tree: Path) -> None:
    write_files(tree, {PAGE: TEXTS[PAGE]})
    assert review(tree, options(baseline=True)) == 0
    replace_in(tree / PAGE, "has", "owns")
    assert findings(tree, "suspect") == []


def test_a_baseline_takes_the_change_and_is_no_review(
    tree: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    replace_in(tree / TEST, "EXPECT_TRUE", "EXPECT_FALSE")
    assert review(tree, options("FR-15", baseline=True)) == 0
    printed = capsys.readouterr().out
    assert "FR-15: test Working.WaitsWithoutMessage changed since the baseline" in printed
    assert "This is not a review" in printed
    assert findings(tree, "suspect") == []
    assert not build(tree).model.requirements["FR-15"].reviewed


def test_a_person_who_wrote_nothing_reviews(
    tree: Path, answers: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    replace_in(tree / TEST, "EXPECT_TRUE", "EXPECT_FALSE")
    git(tree, "commit", "-qam", "y")
    assert review(tree, options("FR-15", **OTHER)) == 0
    printed = capsys.readouterr().out
    assert "-  EXPECT_TRUE" in printed
    assert "+  EXPECT_FALSE" in printed
    assert findings(tree, "req-review") == []
    requirement = build(tree).model.requirements["FR-15"]
    assert requirement.reviewed
    assert [one.remark for one in requirement.reviews] == [answers[-1]]
    replace_in(tree / SCENARIO, "order 1", "order 2")
    assert not build(tree).model.requirements["FR-15"].reviewed


@pytest.mark.parametrize(
    ("place", "answer", "says"),
    [(0, "perhaps", "a question has no answer"), (-1, "fine", "a question has no answer")],
)
def test_no_question_can_be_skipped(
    tree: Path, answers: list[str], place: int, answer: str, says: str
) -> None:
    answers[place : len(answers) if place < 0 else place] = [answer] * 3
    with pytest.raises(FailureError, match=says):
        review(tree, options("FR-15", **OTHER))
    assert not (tree / REVIEWS).exists()


@pytest.mark.usefixtures("answers")
@pytest.mark.parametrize(
    ("person", "says"),
    [
        ({"name": "Ida Author", "email": "other@example.org"}, "Ida Author wrote lines of"),
        ({"name": "Someone Else", "email": "ida@example.org"}, "Someone Else wrote lines of"),
        ({"name": "maintainers", "email": "ada@example.org"}, "first and last name"),
    ],
)
def test_an_author_does_not_review(tree: Path, person: dict[str, str], says: str) -> None:
    with pytest.raises(FailureError, match=says):
        review(tree, options("FR-15", **person))
    assert not (tree / REVIEWS).exists()


@pytest.mark.usefixtures("answers")
def test_a_record_that_is_no_review_is_found(tree: Path) -> None:
    assert review(tree, options("FR-15", **OTHER)) == 0
    replace_in(tree / REVIEWS, "Ada Reader", "Ida Author")
    replace_in(tree / REVIEWS, 'tests = "yes"', 'tests = "later"')
    found = sorted(
        text.split("is not a valid review: ")[1] for _, text in findings(tree, "req-review")
    )
    assert len(found) == 2
    assert found[0].startswith("Ida Author wrote lines of")
    assert found[1].startswith("the question 'tests' needs an answer")
    assert not build(tree).model.requirements["FR-15"].reviewed


@pytest.mark.usefixtures("answers")
def test_only_what_is_committed_is_reviewed(tree: Path) -> None:
    replace_in(tree / TEST, "EXPECT_TRUE", "EXPECT_FALSE")
    with pytest.raises(FailureError, match="not committed"):
        review(tree, options("FR-15", **OTHER))


def test_a_review_needs_one_known_requirement_and_a_terminal(tree: Path) -> None:
    for ids in (["all"], [], ["FR-15", "FR-15"], ["FR-15"]):
        with pytest.raises(FailureError):
            review(tree, options(*ids, **OTHER))
