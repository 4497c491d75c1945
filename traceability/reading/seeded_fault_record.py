"""Reads and writes the results of the seeded faults, and detects whether these results belong to
the present files."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from traceability.reading.published import last_score
from traceability.reading.results import RESULTS, day_of, read_fresh, read_object
from traceability.reading.task_record import SEEDED_FAULTS, is_fresh
from traceability.schema import LastRecord
from traceability.sources import DESIGN
from traceability.whole_file import write_whole

RECORD = RESULTS / "drift.json"
SOURCES = (
    *(*DESIGN, "changes", "ports", "sim", "tests", "requirements", "design", "docs"),
    *("traceability", "tools", "client", "README.md", "CONTRIBUTING.md"),
    *("CMakeLists.txt", "CMakePresets.json", "setup"),
)


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
    """Writes the outcomes. ``left_out`` is the number of faults that were not tried, because the
    test results or the built site that these faults need did not exist."""
    record = {
        "commit": commit,
        "left_out": left_out,
        "outcomes": [asdict(outcome) for outcome in outcomes],
    }
    write_whole(root / RECORD, json.dumps(record, indent=1))


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
