"""Two measurements of coverage agree: the count of gcovr for the whole test run, and the sum of the
records of all tests."""

import json
from pathlib import Path
from typing import Any

import pytest

from traceability.reading import task_record
from traceability.reading.coverage import Coverage, read_coverage
from traceability.reading.gcov_arcs import Covered
from traceability.reading.results import COVERAGE, COVERAGE_LINES, read_fresh
from traceability.reading.task_record import TESTS_TRACE, is_fresh
from traceability.schema import HOST, VIRTUAL_K64

ROOT = Path(__file__).parents[3]

# source line -> the records of gcovr: one record for each function that shares the line
Lines = dict[int, list[dict[str, Any]]]


@pytest.fixture(scope="module", autouse=True)
def run() -> None:
    if read_fresh(ROOT, COVERAGE, task_record.COVERAGE) is None or not is_fresh(ROOT, TESTS_TRACE):
        pytest.skip("the tests have not run with traces and coverage on the present sources")


@pytest.fixture(scope="module")
def counted() -> dict[str, Lines]:
    """Returns the records of gcovr for each file."""
    found: dict[str, Lines] = {}
    for file in json.loads((ROOT / COVERAGE_LINES).read_text(encoding="utf-8"))["files"]:
        lines = found.setdefault(file["file"], {})
        for line in file["lines"]:
            lines.setdefault(line["line_number"], []).append(line)
    return found


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Coverage:
    return read_coverage(ROOT, tmp_path_factory.mktemp("cache"))[HOST]


def differences(counted: dict[str, set[int]], recorded: dict[str, set[int]]) -> list[str]:
    return [
        f"{file}:{line}: only {'gcovr' if line in counted.get(file, set()) else 'the records'}"
        for file in sorted(counted | recorded)
        for line in sorted(counted.get(file, set()) ^ recorded.get(file, set()))
    ]


def test_code_in_flash_and_in_ram_is_seen_on_the_virtual_k64(tmp_path: Path) -> None:
    board = read_coverage(ROOT, tmp_path)[VIRTUAL_K64]
    if not board.recordings:
        pytest.skip("no test ran on the virtual K64")
    flash, ram = "src/k64/start_up/reset.cpp", "src/k64/K64Pit.cpp"
    assert board.all.lines[flash]
    assert board.all.lines[ram]


def test_both_know_the_same_lines(counted: dict[str, Lines], recorded: Coverage) -> None:
    lines = {file: set(lines) for file, lines in counted.items()}
    assert lines
    assert differences(lines, recorded.whole.lines) == []


def test_both_saw_the_same_lines_executed(counted: dict[str, Lines], recorded: Coverage) -> None:
    executed = {
        file: {line for line, found in lines.items() if any(one["count"] for one in found)}
        for file, lines in counted.items()
    }
    assert differences(executed, recorded.all.lines) == []


def test_both_saw_the_same_branches_taken(counted: dict[str, Lines], recorded: Coverage) -> None:
    """Compares the numbers of executed branches from gcov with those from the records of the tests.

    Headers are left out. Their functions are in several object files, and gcov counts the branches
    of each object file separately.

    Source lines that several functions share are also left out. For such a line, gcov reports
    either the branches of each function or no branches.
    """
    taken = recorded.all
    compared = 0
    for file, lines in counted.items():
        for line, found in lines.items() if file.endswith(".cpp") else []:
            branches = found[0]["branches"]
            if len(found) == 1 and branches:
                compared += len(branches)
                hits = sum(bool(branch["count"]) for branch in branches)
                whole = number_of_branches(recorded.whole, file, line)
                assert (whole, number_of_branches(taken, file, line)) == (len(branches), hits), (
                    f"{file}:{line}"
                )
    assert compared


def number_of_branches(covered: Covered, file: str, line: int) -> int:
    return sum(branch[0] == line for branch in covered.branches.get(file, set()))
