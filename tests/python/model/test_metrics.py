"""The metrics that depend only on files. They are part of build/metrics.json."""

from __future__ import annotations

from pathlib import Path

import pytest

from traceability.model.metrics import sizes, with_others
from traceability.schema import LastRecord


def test_the_sizes_count_the_lines_of_tools_tests_and_tables(tmp_path: Path) -> None:
    for name, lines in {
        "traceability/model/a.py": 3,
        "site/portal/b.py": 4,
        "tools/c.py": 5,
        "tools/__pycache__/c.py": 100,
        "site/theme/d.js": 100,
        "tests/python/e.py": 6,
        "design/f.toml": 7,
        "design/proofs/g.pml": 100,
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(lines * "line\n", encoding="utf-8")
    assert sizes(tmp_path) == {
        "tools.python_lines": 12,
        "tools.python_test_lines": 6,
        "tools.design_lines": 7,
    }


def test_a_record_contains_the_number_of_faults_that_were_not_found() -> None:
    record = LastRecord("mutate", "0123abcd45", found=7, tried=10, current=True, date="2026-11-27")
    assert with_others(record)["others"] == 3


@pytest.mark.parametrize(
    ("total", "text"),
    [
        (None, "The record does not state whether the run tried all possible faults."),
        (10, "The run tried all possible faults."),
        (2000, "The run tried 10 of 2,000 possible faults."),
    ],
)
def test_a_record_states_whether_all_possible_faults_were_tried(
    total: int | None, text: str
) -> None:
    record = LastRecord("mutate", "0123abcd45", 7, 10, True, "2026-11-27", total=total)
    assert with_others(record)["extent"] == text
