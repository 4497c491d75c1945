"""The totals of gcovr. Totals that do not belong to the last run of the tests are not used."""

import json
import subprocess
from pathlib import Path

import pytest

from tests.python.reading.task_records import record_task
from tools.coverage_run import count_coverage, remove_stale_notes
from tools.steps import FailureError
from traceability.model.metrics import of_task
from traceability.reading.results import COVERAGE as TOTALS
from traceability.reading.results import COVERAGE_LINES
from traceability.reading.task_record import COVERAGE

CHOOSE = """\
int choose(int value) {
  if (value > 0) {
    return 1;
  }
  return 2;
}
template <int kNumber>
int twice() {
  return 2 * kNumber;
}
int main() { return choose(1) - 1 + twice<0>() + (choose(1) < 0 ? twice<1>() : 0); }
"""
RUN = "build/results/trace.json"


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Returns a project with one file. The program executed 6 of 7 lines and 2 of 4 branches."""
    for name in ("src", "build/results", "build/trace"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "src/choose.cpp").write_text(CHOOSE)
    (tmp_path / RUN).write_text("{}")
    run_program(tmp_path)
    return tmp_path


def run_program(root: Path, source: str = "src/choose.cpp", folder: str = "build/trace") -> None:
    build = root / folder
    words = ["g++", "--coverage", "-fprofile-abs-path", root / source, "-o", "program"]
    subprocess.run(words, cwd=build, check=True)
    subprocess.run([build / "program"], check=True)


def count(root: Path) -> str:
    with (root / "log").open("a") as log:
        text = count_coverage(root, log)
    record_task(root, COVERAGE, RUN)
    return text


def test_a_line_of_several_functions_counts_once(root: Path) -> None:
    assert count(root) == "85.7 % of the lines, 50.0 % of the branches"
    assert of_task(root, TOTALS) == {"coverage.line": 85.7, "coverage.branch": 50.0}


def test_another_program_of_the_same_folder_does_not_count(root: Path) -> None:
    """The result depends only on the program of the tests. The other program does not change this
    result."""
    (root / "src/other.cpp").write_text("int main() { return 0; }")
    folder = "build/trace/tests/CMakeFiles/usual_design_tests.dir"
    (root / folder).mkdir(parents=True)
    run_program(root, "src/other.cpp", folder)
    (root / folder / "program-other.o").touch()
    count(root)
    (file,) = json.loads((root / COVERAGE_LINES).read_text())["files"]
    assert file["file"] == "src/choose.cpp"


def test_a_run_without_a_line_of_the_design_is_a_failure(root: Path) -> None:
    (root / "src").rename(root / "other")
    for path in (root / "build/trace").iterdir():
        path.unlink()
    run_program(root, "other/choose.cpp")
    with pytest.raises(FailureError, match="no line of the design"):
        count(root)
    assert of_task(root, TOTALS) == {}


def test_notes_of_an_object_that_is_no_longer_made_are_removed(root: Path) -> None:
    objects = root / "build/trace/src/CMakeFiles/firmware.dir"
    kept = [objects / "choose.cpp.gcno", objects / "Unity/unity_0_cxx.cxx.gcda"]
    stale = [objects / "gone.cpp.gcno", objects / "Unity/unity_1_cxx.cxx.gcda"]
    for file in [*kept, *(one.with_suffix(".o") for one in kept), *stale]:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(b"")
    with (root / "log").open("w") as log:
        remove_stale_notes(root, root / "build/trace", log)
    assert [file.exists() for file in kept] == [True, True]
    assert [file.exists() for file in stale] == [False, False]
    assert "gone.cpp.gcno" in (root / "log").read_text()
