"""Runs of tests: when they are repeated, and how they are counted."""

import io
import json
import stat
from pathlib import Path

import pytest

from traceability.commands import builds
from traceability.commands.builds import Counts
from traceability.commands.steps import FailureError

BUILD = builds.build  # the tests of runs replace it
PASSED = {"status": "RUN", "result": "COMPLETED"}
FAILED = {**PASSED, "failures": [{"failure": "x"}]}
SKIPPED = {"status": "RUN", "result": "SKIPPED"}
DISABLED = {"status": "NOTRUN", "result": "SUPPRESSED"}


def gtest_json(*tests: dict[str, object]) -> str:
    named = [{"name": "Falls", **test} for test in tests]
    return json.dumps({"testsuites": [{"name": "Wheel", "testsuite": named}]})


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A tree whose tests are a script that counts its runs and copies results.json."""
    monkeypatch.setattr(builds, "build", lambda *_arguments: None)
    tests = tmp_path / "build/trace/tests/firmware_tests"
    tests.parent.mkdir(parents=True)
    write_program(tests, "exit 0")
    (tmp_path / "src").mkdir()
    (tmp_path / "src/RC.cpp").write_text("int a;\n")
    (tmp_path / "results.json").write_text(gtest_json(PASSED, PASSED))
    return tmp_path


def write_program(path: Path, end: str) -> None:
    base = path.parents[3]
    path.write_text(
        f"#!/bin/sh\necho run >>{base}/runs\n"
        f"cp {base}/results.json ${{1#--gtest_output=json:}}\n{end}\n"
    )
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


def run_tests(root: Path) -> tuple[Counts, bool]:
    with (root / "log").open("a") as log:
        return builds.run_tests(root, "trace", log)


def runs(root: Path) -> int:
    return len((root / "runs").read_text().splitlines())


def test_tests_run_once_for_the_same_sources(root: Path) -> None:
    assert run_tests(root) == (Counts(2, 0, 0), True)
    assert run_tests(root) == (Counts(2, 0, 0), False)
    assert runs(root) == 1


def test_tests_run_again_when_a_source_changed(root: Path) -> None:
    run_tests(root)
    assert builds.is_current(root, "trace")
    (root / "src/RC.cpp").write_text("int b;\n")
    assert not builds.is_current(root, "trace")
    assert run_tests(root)[1]
    assert runs(root) == 2


def test_tests_run_again_when_their_results_are_gone(root: Path) -> None:
    run_tests(root)
    builds.results_of(root, "trace").unlink()
    assert run_tests(root)[1]


def test_tests_run_again_when_what_they_left_is_gone(root: Path) -> None:
    run_tests(root)
    (root / "build/trace/tests/firmware_tests").unlink()
    assert not builds.is_current(root, "trace")


def test_failed_tests_stay_failed_without_a_second_run(root: Path) -> None:
    (root / "results.json").write_text(gtest_json(PASSED, FAILED))
    write_program(root / "build/trace/tests/firmware_tests", "exit 1")
    assert run_tests(root) == (Counts(1, 1, 0), True)
    assert run_tests(root) == (Counts(1, 1, 0), False)


def test_a_program_that_fails_after_passing_tests_is_a_failure_each_time(root: Path) -> None:
    write_program(root / "build/trace/tests/firmware_tests", "exit 9")
    for _ in range(2):
        with pytest.raises(FailureError, match="exit code 9"):
            run_tests(root)


def test_a_crash_before_the_results_is_a_failure(root: Path) -> None:
    run_tests(root)
    (root / "src/RC.cpp").write_text("int c;\n")
    program = root / "build/trace/tests/firmware_tests"
    program.write_text("#!/bin/sh\nkill -SEGV $$\n")
    with pytest.raises(FailureError, match="exit code -11"):
        run_tests(root)
    assert not builds.is_current(root, "trace")


def test_traces_of_the_run_before_are_removed(root: Path) -> None:
    old = root / "build/trace/traces/Old.Test.bin"
    old.parent.mkdir()
    old.touch()
    run_tests(root)
    assert not old.exists()


def test_counters_of_the_run_before_are_removed(root: Path) -> None:
    old = root / "build/trace/src/RC.cpp.gcda"
    old.parent.mkdir()
    old.touch()
    run_tests(root)
    assert not old.exists()


def test_counts_of_googletest(tmp_path: Path) -> None:
    results = tmp_path / "results.json"
    results.write_text(gtest_json(PASSED, FAILED, SKIPPED, DISABLED))
    assert builds.gtest_counts(results) == Counts(1, 1, 2)


def test_failures_of_googletest_are_told_with_their_seed(tmp_path: Path) -> None:
    results, log = tmp_path / "results.json", io.StringIO()
    results.write_text(gtest_json(PASSED, {**FAILED, "seed": "42"}))
    builds.write_failures(results, log)
    assert log.getvalue() == "\nFAILED Wheel.Falls, WR_SEED=42\nx\n"


def test_counts_of_pytest(tmp_path: Path) -> None:
    results = tmp_path / "results.xml"
    results.write_text(
        "<testsuites><testsuite><testcase/><testcase><failure/></testcase>"
        "<testcase><error/></testcase><testcase><skipped/></testcase></testsuite></testsuites>"
    )
    assert builds.junit_counts(results) == Counts(1, 2, 1)


def test_the_line_of_counts() -> None:
    assert str(Counts(3, 0, 0)) == "3 passed, 0 failed"
    assert str(Counts(3, 1, 2) + Counts(1, 0, 0)) == "4 passed, 1 failed, 2 skipped"


def test_failed_tests_and_no_tests_fail_the_step() -> None:
    assert builds.require_counts(Counts(2, 0, 0), fresh=True) == "2 passed, 0 failed"
    assert "unchanged" in builds.require_counts(Counts(2, 0, 0), fresh=False)
    for counts in (Counts(2, 1, 0), Counts(0, 0, 3)):
        with pytest.raises(FailureError):
            builds.require_counts(counts, fresh=True)


@pytest.fixture
def board(root: Path) -> Path:
    """The same tree with tests on the virtual K64, and an image."""
    tests = root / "build/host/tests/board_tests"
    tests.parent.mkdir(parents=True)
    write_program(tests, "exit 0")
    (root / "build/k64").mkdir()
    (root / builds.IMAGE).write_bytes(b"image")
    return root


def run_board_tests(root: Path) -> tuple[Counts, bool]:
    with (root / "log").open("a") as log:
        return builds.run_tests(root, builds.BOARD, log)


def test_tests_on_the_board_run_once_for_the_same_sources_and_image(board: Path) -> None:
    assert run_board_tests(board) == (Counts(2, 0, 0), True)
    assert run_board_tests(board) == (Counts(2, 0, 0), False)
    assert (board / "build/results/board.json").exists()


def test_tests_on_the_board_run_again_with_another_image(board: Path) -> None:
    run_board_tests(board)
    (board / builds.IMAGE).write_bytes(b"other image")
    assert not builds.is_current(board, builds.BOARD)
    assert run_board_tests(board)[1]
    (board / "src/RC.cpp").write_text("int b;\n")
    assert run_board_tests(board)[1]
    assert runs(board) == 3


def test_results_of_the_board_and_of_this_machine_are_kept_apart(board: Path) -> None:
    (board / "build/trace/traces").mkdir(parents=True)
    run_tests(board)
    kept = board / "build/trace/traces/New.Test.bin"
    kept.parent.mkdir(exist_ok=True)
    kept.touch()
    run_board_tests(board)
    assert kept.exists()
    assert builds.is_current(board, "trace")
    assert builds.is_current(board, builds.BOARD)


@pytest.mark.parametrize("changed", builds.SETTINGS)
def test_a_build_is_configured_anew_when_its_settings_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, changed: str
) -> None:
    called: list[str] = []
    monkeypatch.setattr(
        builds, "run", lambda _log, words: called.append(" ".join(str(word) for word in words))
    )
    made = tmp_path / "build/k64/build.ninja"
    made.parent.mkdir(parents=True)
    (tmp_path / "setup").mkdir()
    for name in builds.SETTINGS:
        (tmp_path / name).touch()

    def configured() -> bool:
        called.clear()
        with (tmp_path / "log").open("w") as log:
            BUILD(tmp_path, "k64", log, "weeding_robot")
        assert called[-1].endswith("--target weeding_robot")
        made.touch()
        return len(called) == 2 and "--fresh" in called[0]

    assert configured()
    assert not configured()
    (tmp_path / changed).write_text("changed")
    assert configured()
    assert not configured()
    made.unlink()
    assert configured()
