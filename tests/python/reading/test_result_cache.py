"""The cache of results. A result is valid as long as its inputs are the same."""

from __future__ import annotations

from pathlib import Path

from traceability.reading.result_cache import cached_result


def test_a_result_is_made_anew_when_a_part_is_another(tmp_path: Path) -> None:
    made = []

    def make() -> str:
        made.append("once")
        return f"result {len(made)}"

    path = tmp_path / "cache" / "result.pickle"
    assert cached_result(path, ["a", 1], make) == "result 1"
    assert cached_result(path, ["a", 1], make) == "result 1"
    assert cached_result(path, ["a", 2], make) == "result 2"
    assert cached_result(path, ["a", 1], make) == "result 3"


def test_parts_are_not_run_together(tmp_path: Path) -> None:
    path = tmp_path / "result.pickle"
    assert cached_result(path, ["ab", "c"], lambda: 1) == 1
    assert cached_result(path, ["a", "bc"], lambda: 2) == 2
