"""The metrics of build/metrics.json that depend only on files."""

from __future__ import annotations

from pathlib import Path

from traceability.model.metrics import sizes


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
