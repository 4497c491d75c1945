"""Results of the virtual K64: the results of tests, and the findings for seeded faults in
drivers."""

from __future__ import annotations

import json
from pathlib import Path

from tests.python.model.small_tree import write_tree
from tests.python.project_files import write_files
from tests.python.reading.task_records import record_task
from traceability.checks.board_checks import check
from traceability.model.build import build
from traceability.reading.task_record import TESTS_BOARD
from traceability.schema import VIRTUAL_K64
from traceability.sources import source_hash

DECLARED = """\
[[finding]]
id = "clock-gate"
says = "A clock is off."
"""
TESTS = """\
#include <gtest/gtest.h>

/// @brief A clock that is off is found.
TEST(Findings, ClockGate) {
  EXPECT_EQ(id, "clock-gate");
}

/// @brief Nothing is found.
TEST(Findings, Nothing) {
  EXPECT_EQ(id, "");
}
"""


def write_board(root: Path) -> Path:
    files = {"design/board_findings.toml": DECLARED, "tests/sim/emulator/FindingsTest.cpp": TESTS}
    return write_files(write_tree(root), files)


def test_faults_count_only_for_the_sources_they_were_seeded_in(tmp_path: Path) -> None:
    root = write_board(tmp_path)
    fault = {"fault": "F", "file": "src/a.cpp", "finding": "other", "caught": True, "text": "t"}
    for sources, known in (("older", None), (source_hash(root), 1)):
        record = json.dumps({"sources": sources, "faults": [fault]})
        write_files(root, {"build/results/driver_faults.json": record})
        model, facts = build(root)
        assert (model.driver_faults and len(model.driver_faults)) == known
    assert any("'F' caused the finding other" in one.text for one in check(model, facts))


def test_results_of_the_board_are_stale_on_their_own(tmp_path: Path) -> None:
    root = write_board(tmp_path)
    record = {"name": "ClockGate", "status": "RUN", "result": "COMPLETED", "time": "0.002s"}
    failed = record | {"name": "Nothing", "failures": [{"failure": "not nothing"}]}
    suites = {"testsuites": [{"name": "Findings", "testsuite": [record, failed]}]}
    write_files(root, {"build/results/board.json": json.dumps(suites)})
    record_task(root, TESTS_BOARD, "src", "tests")
    model = build(root).model
    assert not model.stale_on(VIRTUAL_K64)
    assert model.results_stale  # The results of the host are missing.
    assert model.tests["Findings.ClockGate"].passed
    assert model.tests["Findings.Nothing"].gave("failed") == [VIRTUAL_K64]
