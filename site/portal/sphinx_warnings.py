"""Converts the warnings of Sphinx to findings. A finding names the file and line of its warning."""

from __future__ import annotations

import io
import re
from pathlib import Path

from traceability.schema import Finding, Place

COLOUR = re.compile(r"\x1b\[[0-9;]*m")
MESSAGE = re.compile(
    r"^(?:(?P<file>[^:\n]+?)(?::(?P<line>\d+))?: )?(?:WARNING|ERROR|CRITICAL): (?P<text>.*)$"
)
LINKS = (
    "undefined label",
    "unknown document",
    "unknown target",
    "label",
    "download file not readable",
)


class WarningCollector(io.StringIO):
    """The stream to which Sphinx writes its warnings."""

    def __init__(self, root: Path, pages: Path) -> None:
        super().__init__()
        self.root = root
        self.pages = pages

    def findings(self) -> list[Finding]:
        lines = COLOUR.sub("", self.getvalue()).splitlines()
        findings = [self._finding(match) for line in lines if (match := MESSAGE.match(line))]
        return list({(f.place.file, f.place.line, f.text): f for f in findings}.values())

    def _finding(self, match: re.Match[str]) -> Finding:
        text = re.sub(r" \[[a-z._-]+\]$", "", match["text"])
        is_link = any(text.startswith(start) for start in LINKS)
        fix = "name a target that exists" if is_link else "correct the page; see the message"
        place = Place(self._source(match["file"] or "site"), int(match["line"] or 0))
        return Finding(place, "link-doc" if is_link else "doc-warning", text, fix)

    def _source(self, file: str) -> str:
        """Returns the path of the hand-written page that causes a warning. ``file`` is the path of
        the copy that Sphinx reads."""
        path = Path(file)
        for base in (self.pages, self.root):
            if path.is_relative_to(base):
                return str(path.relative_to(base))
        return file
