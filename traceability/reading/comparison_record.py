"""The last comparison of two commits, as ./wr diff records it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from traceability.reading.results import RESULTS, read_record
from traceability.whole_file import write_json

RECORD = RESULTS / "diff.json"


@dataclass(frozen=True)
class Difference:
    """One difference between the two commits, as a row of the comparison."""

    section: str
    subject: str
    text: str


@dataclass(frozen=True)
class Comparison:
    """Two commits and the differences between them. ``unmeasured`` lists the commits without
    recorded results. If there are such commits, verdicts, findings, sizes and metrics are not
    compared."""

    first: str
    second: str
    differences: Sequence[Difference]
    unmeasured: Sequence[str]


def write_comparison(root: Path, comparison: Comparison) -> None:
    write_json(root / RECORD, asdict(comparison))


def read_comparison(root: Path) -> Comparison | None:
    return read_record(root / RECORD, Comparison)
