"""The comparison of the baseline design (nested ifs) with the pattern design of the robot. It
compares the costs of both designs. For each likely change, it also compares the numbers of source
lines that must be edited in the two designs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from traceability.reading.results import RESULTS, read_fresh
from traceability.reading.task_record import BASELINE

FOLDER = Path("tests/usual_design")
RESULT = RESULTS / "usual_design.json"
SCENARIO = FOLDER / "steps.scenario"
CHANGES = FOLDER / "changes"
USUAL, PATTERNS = "usual", "patterns"
DESIGNS = {USUAL: "baseline design", PATTERNS: "pattern design"}
TITLES = {
    "bluetooth": "a Bluetooth reading mode without authentication",
    "waiting_k": "a warning state, WaitingK",
    "wheel_algorithm": "a new control algorithm of the wheel",
}
# Targets: the pattern design may exceed the baseline design by at most this value [per cent].
TARGETS = {"report_avg": 5, "cycle_avg": 5, "flash": 10}


@dataclass(frozen=True)
class Row:
    """A metric that is measured for both designs."""

    key: str
    title: str
    unit: str


ROWS = (
    Row("report_avg", "from clock pulse to report (mean)", "instructions"),
    Row("report_max", "from clock pulse to report (maximum)", "instructions"),
    Row("cycle_avg", "whole cycle of 100 ms (mean)", "instructions"),
    Row("cycle_max", "whole cycle of 100 ms (maximum)", "instructions"),
    Row("flash", "flash of the image", "bytes"),
    Row("own_flash", "flash without the shared code", "bytes"),
    Row("ram", "RAM of the image without the stack", "bytes"),
    Row("stack", "largest measured stack use", "bytes"),
    Row("functions", "functions", ""),
    Row("complexity_max", "highest cyclomatic complexity of a function", ""),
    Row("complexity_mean", "mean cyclomatic complexity of a function", ""),
    Row("complexity_sum", "sum of the cyclomatic complexities of all functions", ""),
    Row("files", "files", ""),
    Row("lines", "lines of code without comments and empty lines", ""),
)


@dataclass
class Touched:
    """The files that a patch adds or edits, and the numbers of the added and edited lines."""

    files_changed: list[str] = field(default_factory=list)
    files_added: list[str] = field(default_factory=list)
    lines_touched: int = 0  # number of existing lines that the patch removes or edits
    lines_added: int = 0
    code_added: int = 0  # number of added lines that contain code, without empty lines and comments

    def as_json(self) -> dict[str, Any]:
        return dict(vars(self))


def count_patch(text: str) -> Touched:
    """Counts the files and lines of a patch in git's format."""
    touched = Touched()
    added = False
    for line in text.splitlines():
        if line.startswith("--- "):
            added = line == "--- /dev/null"
        elif line.startswith("+++ "):
            (touched.files_added if added else touched.files_changed).append(line[6:])
        elif line.startswith("-"):
            touched.lines_touched += 1
        elif line.startswith("+"):
            touched.lines_added += 1
            words = line[1:].strip()
            touched.code_added += bool(words) and not words.startswith("//")
    return touched


def patch_of(change: str, design: str) -> Path:
    return CHANGES / change / f"{design}.patch"


def changes_of(root: Path) -> list[str]:
    """Returns the names of the likely changes with which the designs are compared. Each change has
    a folder with a test and with one patch for each design."""
    return sorted(path.name for path in (root / CHANGES).glob("*") if path.is_dir())


def read_comparison(root: Path) -> dict[str, Any] | None:
    """Returns the measured numbers. Returns None if they were not measured with the present
    sources."""
    return read_fresh(root, RESULT, BASELINE)


def more(figures: dict[str, dict[str, float]], key: str) -> float | None:
    """Returns by how many per cent the value of a metric is higher in the pattern design than in
    the baseline design. Returns None if the value in the baseline design is 0."""
    usual, patterns = figures[USUAL][key], figures[PATTERNS][key]
    return 100 * (patterns / usual - 1) if usual else None


def verdict(figures: dict[str, dict[str, float]], key: str) -> bool | None:
    """Returns whether the pattern design meets the target of a metric. Returns None for a metric
    without a target."""
    increase = more(figures, key)
    return None if key not in TARGETS or increase is None else increase <= TARGETS[key]


def beside(functions: dict[str, dict[str, float]], least: float) -> list[dict[str, Any]]:
    """Returns the functions of both designs. The function with the greatest difference between the
    designs is the first.

    A function is left out if this difference is less than ``least``.
    """
    names: Iterable[str] = functions[USUAL].keys() | functions[PATTERNS].keys()
    rows = []
    for name in names:
        usual, patterns = (functions[design].get(name, 0.0) for design in (USUAL, PATTERNS))
        if abs(patterns - usual) >= least:
            rows.append({"name": name, USUAL: usual, PATTERNS: patterns})
    return sorted(rows, key=lambda row: (-abs(row[PATTERNS] - row[USUAL]), row["name"]))
