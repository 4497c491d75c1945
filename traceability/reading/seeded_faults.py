"""The seeded faults in tests/drift, and the record of their outcomes. Each fault is an edit of the
project that a check must find."""

from __future__ import annotations

import re
import tomllib
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from traceability.reading.published import last_score
from traceability.reading.results import RESULTS, day_of, read_fresh, read_object
from traceability.reading.task_record import SEEDED_FAULTS, is_fresh
from traceability.schema import LastRecord
from traceability.sources import DESIGN
from traceability.whole_file import write_json

FAULTS = Path("tests/drift")
RECORD = RESULTS / "drift.json"
SOURCES = (
    *(*DESIGN, "changes", "ports", "sim", "tests", "requirements", "design", "docs"),
    *("traceability", "tools", "client", "README.md", "CONTRIBUTING.md"),
    *("CMakeLists.txt", "CMakePresets.json", "setup"),
)
# The stages at which a fault can be seeded: in the sources, in sources that have test results, in
# the pages, or in the finished site.
STAGES = ("sources", "results", "pages", "site")
COMPILER = "syntax-error"


@dataclass(frozen=True)
class Edit:
    """A replacement of the first match of a pattern. An edit without a pattern creates a new
    file."""

    file: str
    find: str = ""
    put: str = ""

    def apply(self, root: Path) -> int:
        """Changes the file. Returns the number of the first changed line."""
        path = root / self.file
        if not self.find:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(self.put, encoding="utf-8")
            return 1
        text = path.read_text(encoding="utf-8")
        match = re.search(self.find, text, re.MULTILINE | re.DOTALL)
        if match is None:
            raise ValueError(f"no text in {self.file} matches {self.find}")
        path.write_text(
            text[: match.start()] + match.expand(self.put) + text[match.end() :], encoding="utf-8"
        )
        return text.count("\n", 0, match.start()) + 1


@dataclass(frozen=True)
class Fault:
    """A seeded fault. Its finding must be in the file ``place``, on the first line that ``at``
    matches.

    Without ``at``, the finding must be on the line where the first edit begins. A finding about a
    folder has no line."""

    name: str
    check: str
    says: str
    edits: list[Edit] = field(default_factory=list)
    place: str = ""
    at: str = ""
    stage: str = "sources"
    compiles: bool = True  # False if the compiler also finds the fault.

    def expected_line(self, root: Path, changed: int) -> int:
        if not self.at:
            return changed
        path = root / self.place
        if path.is_dir():
            return 0
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if re.search(self.at, line):
                return number
        raise ValueError(f"no line in {self.place} matches {self.at}")


def read_faults(root: Path) -> list[Fault]:
    """Returns all faults, in the order of their files."""
    faults: list[Fault] = []
    for path in sorted((root / FAULTS).glob("*.toml")):
        entries = tomllib.loads(path.read_text(encoding="utf-8"))["fault"]
        faults += [_fault(f"{path.stem}-{number}", item) for number, item in enumerate(entries, 1)]
    return faults


def _fault(name: str, item: dict[str, Any]) -> Fault:
    first = {key: item.pop(key) for key in ("file", "find", "put") if key in item}
    edits = [Edit(**change) for change in item.pop("edits", [first])]
    return Fault(name, edits=edits, **{"place": edits[0].file, **item})


@dataclass(frozen=True)
class Outcome:
    """The outcome of a seeded fault. ``said`` lists the findings of the checks. If the expected
    check has findings near the expected ``line``, ``said`` lists only these findings."""

    name: str
    check: str
    says: str
    file: str
    line: int
    caught: bool
    compiles: bool
    said: list[str]


def write_record(root: Path, outcomes: list[Outcome], left_out: int, commit: str) -> None:
    """Writes the outcomes. ``left_out`` is the number of faults that were not tried. For these
    faults, the necessary test results or the built site did not exist."""
    record = {
        "commit": commit,
        "left_out": left_out,
        "outcomes": [asdict(outcome) for outcome in outcomes],
    }
    write_json(root / RECORD, record)


def last_seeded(root: Path) -> LastRecord | None:
    """Returns the result of the last run, even if files have changed since."""
    record = read_object(root / RECORD)
    if not record:
        return last_score(root, "drift")
    caught = sum(outcome["caught"] for outcome in record["outcomes"])
    tried, current = len(record["outcomes"]), is_fresh(root, SEEDED_FAULTS)
    return LastRecord(
        "check --drift", record.get("commit", ""), caught, tried, current, day_of(root / RECORD)
    )


def read_record(root: Path) -> list[Outcome] | None:
    """Returns the outcomes. Returns None if files have changed since the faults were seeded."""
    record = read_fresh(root, RECORD, SEEDED_FAULTS)
    return [Outcome(**outcome) for outcome in record["outcomes"]] if record else None
