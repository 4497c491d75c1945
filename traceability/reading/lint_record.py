"""The records of ./wr lint: the result of each step, the number of findings of the prose linter,
and the hashes of the files that the steps and the linter read."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from traceability.reading.results import RESULTS, read_object
from traceability.schema import Exemption, LintRun, Place
from traceability.sources import DESIGN, files_below, hash_of
from traceability.whole_file import write_json

RECORD = RESULTS / "lint.json"
PROSE = RESULTS / "prose.json"
FOLDERS = (  # the texts that the prose linter reads
    *("docs", "requirements", "design", *DESIGN, "changes", "ports", "sim", "client", "tests"),
    *("tools", "traceability", "site/portal", "site/templates", "site/theme", "setup"),
    *("README.md", "wr"),
)
SETTINGS = (
    *("pyproject.toml", "CMakeLists.txt", "CMakePresets.json", ".clang-format", ".clang-tidy"),
    *("site/search_words.txt", "site/synonyms.txt", "site/conf.py"),
)
TIDIED = ("src", "extensions", "ports", "sim")  # folders that clang-tidy reads
# Files in these folders that clang-tidy does not read: it does not find the library of WebAssembly.
NOT_TIDIED = re.compile(r"sim/web/module/|ports/\w+/tests/")
EXEMPTION = re.compile(r"NOLINT(?:NEXTLINE|BEGIN)?\((?P<rules>[^)]+)\): (?P<why>.+)")
NOT_RUN, PASSED, FAILED = "not run", "passed", "failed"


def files_hash(root: Path) -> str:
    return hash_of(root, files_below(root, (*FOLDERS, *SETTINGS)))


def write_lint(root: Path, steps: Mapping[str, str], commit: str, files: str) -> None:
    """Writes the result of each step. ``files`` is the hash of the files before the first step. If
    the files have changed since then, no result is valid and the record is removed. A step that did
    not run keeps its earlier result for the same files."""
    if files != files_hash(root):
        (root / RECORD).unlink(missing_ok=True)
        return
    earlier = read_object(root / RECORD)
    kept = earlier["steps"] if earlier.get("files") == files else {}
    results = {name: kept.get(name, how) if how == NOT_RUN else how for name, how in steps.items()}
    write_json(root / RECORD, {"commit": commit, "files": files, "steps": results})


def read_lint(root: Path) -> LintRun | None:
    """Returns the results for the present files. Returns None if the files changed since the
    linters read them."""
    record = read_object(root / RECORD)
    fresh = record and record.get("files") == files_hash(root)
    return LintRun(record["commit"], record["steps"]) if fresh else None


def texts_hash(root: Path) -> str:
    return hash_of(root, files_below(root, FOLDERS))


def write_prose(root: Path, findings: int) -> None:
    write_json(root / PROSE, {"findings": findings, "texts": texts_hash(root)})


def read_prose(root: Path) -> int | None:
    """Returns the number of findings in the present texts. Returns None if the texts changed since
    the linter read them."""
    record = read_object(root / PROSE)
    fresh = record and record.get("texts") == texts_hash(root)
    return int(record["findings"]) if fresh else None


def tidied(root: Path, suffixes: tuple[str, ...]) -> list[Path]:
    files = files_below(root, TIDIED, suffixes)
    return [path for path in files if not NOT_TIDIED.match(str(path.relative_to(root)))]


def read_exemptions(root: Path) -> list[Exemption]:
    """In the files that clang-tidy reads, some comments exempt a source line from rules of
    clang-tidy. Returns these comments."""
    return [
        Exemption(Place(str(path.relative_to(root)), number), match["rules"], match["why"])
        for path in tidied(root, (".hpp", ".cpp"))
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if (match := EXEMPTION.search(line))
    ]
