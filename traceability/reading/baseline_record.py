"""The comparison of the baseline design (nested ifs) with the pattern design of the robot. It
compares the costs of both designs. For each likely change, it also compares the numbers of source
lines that must be edited in the two designs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from traceability.reading.results import RESULTS, read_fresh
from traceability.reading.task_record import BASELINE
from traceability.reading.toml_reader import Entries
from traceability.schema import Place
from traceability.sources import SRC

FOLDER = Path("tests/usual_design")
SOURCE = FOLDER / "usual/UsualDesign.cpp"
PARTS = Path("design/baseline_parts.toml")
SECTION = re.compile(r"// ---- (?P<title>.+?) -+$")
METHOD = re.compile(r"\w.*UsualDesign::(?P<name>\w+)\(")
FIRST = "construction"  # section of the methods before the first title
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


@dataclass(frozen=True)
class Part:
    """A part of the robot that both designs have. ``modules`` are logic modules of the pattern
    design. ``usual`` are sections and methods of the source of the baseline design."""

    title: str
    modules: Sequence[str]
    usual: Sequence[str]
    why: str
    place: Place


def read_parts(root: Path, entries: Entries | None = None) -> list[Part]:
    return (entries or Entries(root)).records(root / PARTS, "part", Part, "title")


class PartOfLine:
    """Returns the part of the robot to which a source line belongs."""

    def __init__(self, root: Path, parts: Sequence[Part]) -> None:
        self._usual = {name: part.title for part in parts for name in part.usual}
        folders = ((module, part.title) for part in parts for module in part.modules)
        self._folders = sorted(folders, key=lambda item: -len(item[0]))
        self._lines = self._places((root / SOURCE).read_text(encoding="utf-8").splitlines())

    def __call__(self, file: str, line: int) -> str | None:
        """Returns the part of a line. Returns None if the line belongs to no part, for example if
        it is in a header of the standard library."""
        if file.endswith(str(SOURCE)):
            return self._lines.get(line)
        _, found, path = f"/{file}".partition(f"/{SRC}/")
        inside = (title for module, title in self._folders if path.startswith(f"{module}/"))
        return next(inside, None) if found else None

    def _places(self, lines: Iterable[str]) -> dict[int, str]:
        section, method = FIRST, ""
        found = {}
        for number, text in enumerate(lines, 1):
            if title := SECTION.match(text):
                section = title["title"]
            elif start := METHOD.match(text):
                method = start["name"]
            part = self._usual.get(method) or self._usual.get(section)
            if method and part:
                found[number] = part
        return found


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
    """Returns the increase of a metric from the baseline design to the pattern design, in per cent
    of the value in the baseline design. Returns None if this value is 0."""
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

    A function is left out if this difference is less than ``least``."""
    names: Iterable[str] = functions[USUAL].keys() | functions[PATTERNS].keys()
    rows = []
    for name in names:
        usual, patterns = (functions[design].get(name, 0.0) for design in (USUAL, PATTERNS))
        if abs(patterns - usual) >= least:
            rows.append({"name": name, USUAL: usual, PATTERNS: patterns})
    return sorted(rows, key=lambda row: (-abs(row[PATTERNS] - row[USUAL]), row["name"]))
