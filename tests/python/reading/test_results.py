"""The results of tests, read from files in the form in which the test programs write them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tests.python.reading.task_records import record_task
from traceability.reading import task_record
from traceability.reading.results import (
    bindings_of,
    read_branches,
    read_recording_factor,
    read_results,
)
from traceability.schema import HOST, VIRTUAL_K64


def write(root: Path, name: str, data: Any) -> None:
    path = root / "build" / "results" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(data), encoding="utf-8")


def test_a_folder_of_tests_has_its_bindings() -> None:
    assert bindings_of("tests/services/PipeTest.cpp") == [HOST]
    assert bindings_of("tests/sim/host/HostPlatformTest.cpp") == [HOST]
    assert bindings_of("tests/sim/emulator/NvicTest.cpp") == [VIRTUAL_K64]
    assert bindings_of("tests/k64/K64BoardTest.cpp") == [VIRTUAL_K64]
    assert bindings_of("tests/system/OrdersTest.cpp") == [HOST, VIRTUAL_K64]
    assert bindings_of("tests/system/host/RcTest.cpp") == [HOST]
    assert bindings_of("tests/system/board/LineTest.cpp") == [VIRTUAL_K64]
    assert bindings_of("tests/usual_design/BehaviourTest.cpp") == []


def test_branches_count_only_with_the_present_sources(tmp_path: Path) -> None:
    file = {"filename": "src/a.hpp", "branch_covered": 1, "branch_total": 4}
    write(tmp_path, "coverage.json", {"files": [file]})
    assert read_branches(tmp_path) == {}
    record_task(tmp_path, task_record.COVERAGE)
    assert read_branches(tmp_path) == {"src/a.hpp": (1, 4)}


def test_one_failed_instance_fails_a_parameterised_test(tmp_path: Path) -> None:
    base = {"status": "RUN", "result": "COMPLETED", "time": "0.001s"}
    failure = {"failures": [{"failure": "expected 1"}]}
    cases = [base | {"name": "T/0"} | failure, base | {"name": "T/1"}]
    suite = {"name": "All/Suite", "testsuite": cases}
    write(tmp_path, "trace.json", {"testsuites": [suite]})
    result = read_results(tmp_path, HOST)["Suite.T"]
    assert (result.result, result.message, result.milliseconds) == ("failed", "expected 1", 2.0)
    assert sorted(result.recordings) == ["All_Suite.T_0", "All_Suite.T_1"]


def test_the_types_of_a_typed_test_are_its_instances(tmp_path: Path) -> None:
    base = {"name": "T", "status": "RUN", "time": "0.001s"}
    failed = {**base, "failures": [{"failure": "expected 1"}]}
    suites = [
        {"name": f"Levers/{number}", "testsuite": [case]}
        for number, case in enumerate((failed, base))
    ]
    write(tmp_path, "trace.json", {"testsuites": suites})
    result = read_results(tmp_path, HOST)["Levers.T"]
    assert result.instances == {"Levers_0.T": "failed", "Levers_1.T": "passed"}
    assert result.result == "failed"


def test_a_test_that_fails_with_one_image_fails(tmp_path: Path) -> None:
    base = {"name": "T/0", "status": "RUN", "time": "1s"}
    failed = {**base, "image": "other", "failures": [{"failure": "expected 1"}]}
    suites = [{"name": "Suite", "testsuite": [one]} for one in (failed, {**base, "image": "first"})]
    write(tmp_path, "board.json", {"testsuites": suites})
    result = read_results(tmp_path, VIRTUAL_K64)["Suite.T"]
    assert (result.result, result.message) == ("failed", "expected 1")
    assert result.images == ["first", "other"]
    assert result.recordings == ["Suite.T_0"]
    assert result.instances == {"Suite.T_0": "failed"}


def test_what_a_test_measured_stands_with_its_result(tmp_path: Path) -> None:
    tests = [
        {"name": "Counts", "status": "RUN", "time": "1s", "measured": "7 events"},
        {"name": "Plain", "status": "RUN", "time": "1s"},
    ]
    write(tmp_path, "trace.json", {"testsuites": [{"name": "Suite", "testsuite": tests}]})
    results = read_results(tmp_path, HOST)
    assert [results[f"Suite.{name}"].measured for name in ("Counts", "Plain")] == ["7 events", ""]


def test_skipped_and_disabled_tests_did_not_pass(tmp_path: Path) -> None:
    cases = [
        {"name": "A", "status": "RUN", "result": "SKIPPED", "time": "0s"},
        {"name": "B", "status": "NOTRUN", "result": "SUPPRESSED", "time": "0s"},
    ]
    write(tmp_path, "trace.json", {"testsuites": [{"name": "S", "testsuite": cases}]})
    assert {name: result.result for name, result in read_results(tmp_path, HOST).items()} == {
        "S.A": "skipped",
        "S.B": "skipped",
    }


def test_what_records_cost_is_known_of_two_runs_with_the_same_sources(tmp_path: Path) -> None:
    write(tmp_path, "trace.cost.json", {"sources": "a", "seconds": 3.0})
    assert read_recording_factor(tmp_path, "a") is None
    write(tmp_path, "plain.cost.json", {"sources": "a", "seconds": 2.0})
    assert read_recording_factor(tmp_path, "a") == 1.5
    assert read_recording_factor(tmp_path, "b") is None
