"""Comments that exempt source lines from a rule of clang-tidy."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from traceability.sources import files_below

pytestmark = pytest.mark.reads("src", "extensions", "changes", "ports", "sim", "tests")

ROOT = Path(__file__).resolve().parents[3]
FOLDERS = ("src", "extensions", "ports", "sim", "tests", "changes")
EXEMPTION = re.compile(r"NOLINT(?:NEXTLINE|BEGIN)?\b")
WITH_REASON = re.compile(r"NOLINT(?:NEXTLINE|BEGIN)?\([^)]+\): \w+")


def test_each_exemption_names_its_rules_and_its_reason() -> None:
    lines = [
        f"{path.relative_to(ROOT)}:{number}"
        for path in files_below(ROOT, FOLDERS, (".hpp", ".cpp"))
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if EXEMPTION.search(line) and not WITH_REASON.search(line)
    ]
    assert lines == []
