"""The record of the prose linter: the number of its findings, and the hash of the texts that it
read."""

from __future__ import annotations

import json
from pathlib import Path

from traceability.reading.results import RESULTS, read_object
from traceability.sources import DESIGN, files_below, hash_of
from traceability.whole_file import write_whole

RECORD = RESULTS / "prose.json"
FOLDERS = (
    *("docs", "requirements", "design", *DESIGN, "changes", "ports", "sim", "client", "tests"),
    *("tools", "traceability", "site/portal", "site/templates", "site/theme", "setup"),
    *("README.md", "wr"),
)


def texts_hash(root: Path) -> str:
    return hash_of(root, files_below(root, FOLDERS))


def write_prose(root: Path, findings: int) -> None:
    content = {"findings": findings, "texts": texts_hash(root)}
    write_whole(root / RECORD, json.dumps(content))


def read_prose(root: Path) -> int | None:
    """Returns the number of findings in the present texts. Returns None if the texts changed since
    the linter read them."""
    record = read_object(root / RECORD)
    fresh = record and record.get("texts") == texts_hash(root)
    return int(record["findings"]) if fresh else None
