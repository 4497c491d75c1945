"""What the documents were last made from, and what was found then: unchanged ones stay."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, dataclass
from pathlib import Path

from traceability.exports.metrics_file import METRICS
from traceability.model.build import commit
from traceability.reading.results import RESULTS, read_json
from traceability.reading.traces import SOURCES
from traceability.schema import Finding, Place
from traceability.sources import DESIGN, FRAMES, file_hash, files_below

RECORD = Path("build/model/made.json")
SITE = Path("build/site")
READ = (
    *(*DESIGN, "sim", "tests", "requirements", "design", "docs", "site"),
    *("traceability", "tools", *FRAMES),
    *("setup", "wr", "README.md", "CMakeLists.txt", "CMakePresets.json", str(RESULTS)),
)
# Beside the results: what the documents themselves write there, and what no document shows.
WRITTEN = ("verification.json", "verification.xml")
NOT_SHOWN = re.compile(r"pytest_\w+\.(hash|xml)")


@dataclass
class Made:
    """The hash of each file that was read, and the state of what was written."""

    files: dict[str, str]
    written: dict[str, str]
    findings: list[Finding]


def files_read(root: Path) -> dict[str, str]:
    """The hash of each file; the commit, and the programs whose symbols are read."""
    paths = [
        path
        for path in files_below(root, READ)
        if path.name not in WRITTEN and not NOT_SHOWN.fullmatch(path.name)
    ]
    found = {str(path.relative_to(root)): file_hash(path) for path in paths}
    found["commit"] = commit(root)
    for source in SOURCES.values():
        found |= _states(root, [source.executable, source.folder])
    return found


def read_made(root: Path) -> Made | None:
    """What was made last, if all of it is still there."""
    record = read_json(root / RECORD)
    if not isinstance(record, dict) or not (root / SITE).is_dir():
        return None
    findings = [Finding(**{**one, "place": Place(**one["place"])}) for one in record["findings"]]
    return Made(record["files"], record["written"], findings)


def write_made(root: Path, files: dict[str, str], findings: list[Finding]) -> None:
    """``files`` are those of before the documents were made."""
    made = Made(files, files_written(root), findings)
    (root / RECORD).parent.mkdir(parents=True, exist_ok=True)
    (root / RECORD).write_text(json.dumps(asdict(made)), encoding="utf-8")


def is_whole(root: Path, made: Made) -> bool:
    """Whether nobody has changed what was written."""
    return files_written(root) == made.written


def files_written(root: Path) -> dict[str, str]:
    paths = [path for path in (root / SITE).rglob("*") if path.is_file()]
    return _states(root, [METRICS, *(path.relative_to(root) for path in paths)])


def _states(root: Path, names: list[Path]) -> dict[str, str]:
    """Size and time of files."""
    states = {}
    for name in names:
        if (root / name).exists():
            state = (root / name).stat()
            states[str(name)] = f"{state.st_size} {state.st_mtime_ns}"
    return states
