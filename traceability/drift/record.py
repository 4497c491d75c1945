"""What became of the seeded faults, and whether it holds for the present state of the project."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from traceability.model.results import RESULTS, read_json
from traceability.sources import files_below, hash_of

RECORD = RESULTS / "drift.json"
SOURCES = (
    *(
        "src",
        "extensions",
        "sim",
        "tests",
        "requirements",
        "design",
        "docs",
        "traceability/doxygen",
    ),
    *("README.md", "CMakeLists.txt", "CMakePresets.json", "setup/k64-toolchain.cmake"),
)
# What decides whether a fault is found: the sources, the checks, and the faults.
READ = (*SOURCES, "traceability")


@dataclass
class Outcome:
    """``line`` is where the finding was to lie; ``said`` is what was found, there if possible."""

    name: str
    check: str
    says: str
    file: str
    line: int
    caught: bool
    compiles: bool
    said: list[str]


def state_of(root: Path) -> str:
    """The hash of all that decides the outcome."""
    suffixes = (".cpp", ".hpp", ".dox", ".toml", ".tree", ".py", ".rst", ".html", ".md", ".txt")
    return hash_of(root, files_below(root, READ, suffixes))


def write_record(root: Path, outcomes: list[Outcome], left_out: int) -> None:
    """``left_out`` counts the faults that need results of tests, or a site, which are not there."""
    record = {
        "read": state_of(root),
        "left_out": left_out,
        "outcomes": [asdict(outcome) for outcome in outcomes],
    }
    path = root / RECORD
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(record, indent=1), encoding="utf-8")


def read_record(root: Path) -> list[Outcome] | None:
    """The outcomes, when all faults were seeded in the present state of the project."""
    record = read_json(root / RECORD)
    if not isinstance(record, dict) or record.get("read") != state_of(root):
        return None
    return [Outcome(**outcome) for outcome in record["outcomes"]]
