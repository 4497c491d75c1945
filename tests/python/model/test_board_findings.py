"""What the virtual K64 finds: declared, tested, and given by seeded faults."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
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

[[finding]]
id = "lockup"
says = "It stops."
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
    write_tree(root)
    for name, text in (
        ("design/board_findings.toml", DECLARED),
        ("tests/sim/emulator/FindingsTest.cpp", TESTS),
    ):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    return root


def test_a_finding_without_a_test_is_found(tmp_path: Path) -> None:
    model, facts = build(write_board(tmp_path))
    assert model.board_findings["clock-gate"].tests == ["Findings.ClockGate"]
    assert list(model.tests["Findings.Nothing"].results) == [VIRTUAL_K64]
    found = check(model, facts)
    assert [(one.place.line, "lockup" in one.text) for one in found] == [(5, True)]


def test_faults_count_only_for_the_sources_they_were_seeded_in(tmp_path: Path) -> None:
    root = write_board(tmp_path)
    fault = {"fault": "F", "file": "src/a.cpp", "finding": "other", "caught": True, "text": "t"}
    path = root / "build/results/driver_faults.json"
    path.parent.mkdir(parents=True)
    for sources, known in (("older", None), (source_hash(root), 1)):
        path.write_text(json.dumps({"sources": sources, "faults": [fault]}), encoding="utf-8")
        model, facts = build(root)
        assert (model.driver_faults and len(model.driver_faults)) == known
    assert any("'F' gave the finding other" in one.text for one in check(model, facts))


def test_results_of_the_board_are_stale_on_their_own(tmp_path: Path) -> None:
    root = write_board(tmp_path)
    results = root / "build" / "results"
    results.mkdir(parents=True)
    record = {"name": "ClockGate", "status": "RUN", "result": "COMPLETED", "time": "0.002s"}
    failed = record | {"name": "Nothing", "failures": [{"failure": "not nothing"}]}
    suites = {"testsuites": [{"name": "Findings", "testsuite": [record, failed]}]}
    (results / "board.json").write_text(json.dumps(suites))
    record_task(root, TESTS_BOARD, "src", "tests")
    model = build(root).model
    assert not model.stale_on(VIRTUAL_K64)
    assert model.results_stale  # those of the host are missing
    assert model.tests["Findings.ClockGate"].passed
    assert model.tests["Findings.Nothing"].gave("failed") == [VIRTUAL_K64]


REGISTERS = """\
namespace wr {
namespace adc {
inline constexpr Register<std::uint32_t, 0x4003B008> CFG1;
}  // namespace adc
}  // namespace wr
"""
BELIEFS = """\
[[source]]
id = "header"
says = "The header."
outside = true

[[source]]
id = "memory"
says = "The manual."
outside = false

[[belief]]
register = "adc::CFG1"
value = "ADICLK = 0"
says = "The bus clock."
source = "header"
model = "sim/emulator/Adc.cpp"
"""


def belief_findings(root: Path, beliefs: str) -> list[str]:
    write_board(root)
    for name, text in (
        ("src/k64/registers.hpp", REGISTERS),
        ("sim/emulator/Adc.cpp", "constexpr std::uint32_t kCfg1 = 0x08;\n"),
        ("design/board_beliefs.toml", beliefs),
    ):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text, encoding="utf-8")
    model, facts = build(root)
    return [one.text for one in check(model, facts) if one.check == "board-belief"]


@pytest.mark.parametrize(
    ("before", "after", "text"),
    [
        ("", "", ""),
        ("sim/emulator/Adc.cpp", "sim/emulator/Pit.cpp", "sim/emulator/Pit.cpp does not name CFG1"),
        ('source = "header"', 'source = "rumour"', "there is no source rumour"),
        (
            'source = "header"',
            'source = "memory"',
            "adc::CFG1 ADICLK = 0 is not marked as shared by driver and model",
        ),
        (
            'source = "header"',
            'source = "header"\nshared = true',
            "adc::CFG1 ADICLK = 0 has an outside source and is marked as shared by driver and"
            " model",
        ),
        ('source = "header"', 'source = "memory"\nshared = true', ""),
    ],
)
def test_a_belief_has_a_register_a_model_and_a_source(
    tmp_path: Path, before: str, after: str, text: str
) -> None:
    found = belief_findings(tmp_path, BELIEFS.replace(before, after) if before else BELIEFS)
    assert found == ([text] if text else [])


def test_beliefs_and_registers_have_the_same_names(tmp_path: Path) -> None:
    assert belief_findings(tmp_path, BELIEFS.replace("adc::CFG1", "pit::CFG1")) == [
        "there is no register pit::CFG1 in src/k64/registers.hpp",
        "no belief in design/board_beliefs.toml is about adc::CFG1",
    ]
