"""The runs of the test programs, the counts of their tests, and the configuration of builds."""

import io
import json
import os
import stat
import time
from pathlib import Path

import pytest

from tools import cmake_build
from tools.steps import FailureError
from traceability.reading.tool_tests import junit_counts
from traceability.schema import Counts

PASSED = {"status": "RUN", "result": "COMPLETED"}
FAILED = {**PASSED, "failures": [{"failure": "x"}]}
SKIPPED = {"status": "RUN", "result": "SKIPPED"}
DISABLED = {"status": "NOTRUN", "result": "SUPPRESSED"}


def gtest_json(*tests: dict[str, object]) -> str:
    named = [{"name": "Falls", **test} for test in tests]
    return json.dumps({"testsuites": [{"name": "Wheel", "testsuite": named}]})


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns a project whose test program is a script. The script counts its runs and copies
    results.json."""
    monkeypatch.setattr(cmake_build, "jobs", lambda: "2")
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
        f'echo "$GTEST_SHARD_INDEX/$GTEST_TOTAL_SHARDS" >>{base}/shards\n'
        f"cp {base}/results.json ${{1#--gtest_output=json:}}\n{end}\n"
    )
    path.chmod(path.stat().st_mode | stat.S_IXUSR)


def run_tests(root: Path, name: str = "trace") -> Counts:
    with (root / "log").open("a") as log:
        return cmake_build.run_tests(root, name, log)


def runs(root: Path) -> int:
    return len((root / "runs").read_text().splitlines())


def test_each_processor_runs_a_part_of_the_tests(root: Path) -> None:
    assert run_tests(root) == Counts(4, 0, 0)
    assert runs(root) == 2
    assert sorted((root / "shards").read_text().split()) == ["0/2", "1/2"]
    results = json.loads((root / "build/results/trace.json").read_text())
    assert len(results["testsuites"]) == 2


def test_failed_tests_have_results(root: Path) -> None:
    (root / "results.json").write_text(gtest_json(PASSED, FAILED))
    write_program(root / "build/trace/tests/firmware_tests", "exit 1")
    assert run_tests(root) == Counts(2, 2, 0)


@pytest.mark.parametrize(("end", "code"), [("exit 9", 9), ("kill -SEGV $$", -11)])
def test_a_program_that_ends_badly_with_passing_tests_is_a_failure(
    root: Path, end: str, code: int
) -> None:
    write_program(root / "build/trace/tests/firmware_tests", end)
    with pytest.raises(FailureError, match=f"exit code {code}"):
        run_tests(root)


def test_a_crash_before_the_results_is_a_failure(root: Path) -> None:
    run_tests(root)
    (root / "build/trace/tests/firmware_tests").write_text("#!/bin/sh\nkill -SEGV $$\n")
    with pytest.raises(FailureError, match="exit code -11"):
        run_tests(root)


def test_traces_of_the_run_before_are_removed(root: Path) -> None:
    old = root / "build/trace/traces/Old.Test.bin"
    old.parent.mkdir()
    old.touch()
    run_tests(root)
    assert not old.exists()


def test_counts_of_googletest(tmp_path: Path) -> None:
    results = tmp_path / "results.json"
    results.write_text(gtest_json(PASSED, FAILED, SKIPPED, DISABLED))
    assert cmake_build.gtest_counts(results) == Counts(1, 1, 2)


def test_failures_of_googletest_are_told_with_their_seed(tmp_path: Path) -> None:
    results, log = tmp_path / "results.json", io.StringIO()
    results.write_text(gtest_json(PASSED, {**FAILED, "seed": "42"}))
    cmake_build.write_failures(results, log)
    command = "to debug this test: ./wr debug Wheel.Falls"
    assert log.getvalue() == f"\nFAILED Wheel.Falls, WR_SEED=42\n{command}\nx\n"


def test_counts_of_pytest(tmp_path: Path) -> None:
    results = tmp_path / "results.xml"
    results.write_text(
        "<testsuites><testsuite><testcase/><testcase><failure/></testcase>"
        "<testcase><error/></testcase><testcase><skipped/></testcase></testsuite></testsuites>"
    )
    assert junit_counts(results) == Counts(1, 2, 1)


def test_failed_tests_and_no_tests_are_bad() -> None:
    good = cmake_build.outcome_of(Counts(2, 0, 0))
    assert (good.note, good.failed) == ("2 passed, 0 failed", False)
    for counts in (Counts(2, 1, 0), Counts(0, 0, 3)):
        assert cmake_build.outcome_of(counts).failed


def test_results_of_the_board_and_of_this_machine_are_kept_apart(root: Path) -> None:
    tests = root / "build/host/tests/board_tests"
    tests.parent.mkdir(parents=True)
    write_program(tests, "exit 0")
    kept = root / "build/trace/traces/New.Test.bin"
    kept.parent.mkdir()
    kept.touch()
    assert run_tests(root, cmake_build.BOARD) == Counts(4, 0, 0)
    assert kept.exists()
    assert (root / "build/results/board.json").exists()
    assert not (root / "build/results/trace.json").exists()


def test_tests_of_the_image_run_with_two_more_images(root: Path) -> None:
    """The stub writes the same results for each firmware image. The test therefore compares the
    environment variables of all runs."""
    tests = root / "build/host/tests/board_tests"
    tests.parent.mkdir(parents=True)
    write_program(tests, f'echo "$WR_IMAGE $GTEST_FILTER" >>{root}/asked')
    both = {**PASSED, "image": "weeding_robot_paper"}
    alone = {**both, "name": "Alone", "only": "weeding_robot_paper"}
    (root / "results.json").write_text(gtest_json(PASSED, both, alone))
    assert run_tests(root, cmake_build.BOARD) == Counts(18, 0, 0)
    default = f"{root}/build/k64/weeding_robot.bin Wheel.Falls:Wheel.Falls"
    recorded = f"{root}/build/k64_calls/weeding_robot_paper.bin Wheel.Falls:Wheel.Falls"
    asked = [" ", " ", default, default, recorded, recorded]
    assert (root / "asked").read_text().splitlines() == asked


@pytest.mark.parametrize("changed", cmake_build.SETTINGS)
def test_a_build_is_configured_anew_when_its_settings_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, changed: str
) -> None:
    called: list[str] = []
    made = tmp_path / "build/k64/build.ninja"
    stale = tmp_path / "build/k64/Gone.cpp.ci"

    def run(_log: object, words: list[object]) -> None:
        called.append(" ".join(str(word) for word in words))
        made.parent.mkdir(parents=True, exist_ok=True)

    monkeypatch.setattr(cmake_build, "run", run)
    (tmp_path / "setup").mkdir()
    for name in cmake_build.SETTINGS:
        (tmp_path / name).touch()

    def configured() -> bool:
        called.clear()
        with (tmp_path / "log").open("w") as log:
            cmake_build.build(tmp_path, "k64", log, "weeding_robot")
        assert called[-1].endswith("--target weeding_robot")
        made.touch()
        return len(called) == 2 and "--fresh" in called[0]

    assert configured()
    assert not configured()
    later = time.time() + 10
    os.utime(tmp_path / changed, (later, later))
    stale.touch()
    assert configured()
    assert not stale.exists()
    os.utime(made, (later, later))
    assert not configured()
    made.unlink()
    assert configured()
