"""The worked examples of the page docs/how_these_pages_are_made.rst, as patches."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from textwrap import dedent

ROOT = Path(__file__).parents[3]
PAGE = Path("docs/how_these_pages_are_made.rst")
EXAMPLES = ("example-check", "example-page", "one-more-field")  # labels on the page
BLOCK = re.compile(r"^\.\. code-block:: diff\n((?:\n|   .*\n?)+)", re.MULTILINE)
BEFORE = re.compile(r"^--- a/(\S+)$", re.MULTILINE)


def patches(example: str) -> list[str]:
    section = (ROOT / PAGE).read_text(encoding="utf-8").split(f".. _{example}:")[1]
    blocks = BLOCK.findall(section.partition("\n.. _")[0])
    return [dedent(block).strip("\n") + "\n\n" for block in blocks]


def apply(root: Path, example: str) -> None:
    """Applies an example to a copy of the project. The lines around a change must be the same in
    the file and on the page."""
    for text in patches(example):
        words = ["patch", "-p1", "--fuzz=0"]
        done = subprocess.run(
            words, cwd=root, input=text, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"an example no longer applies; update {PAGE}: {done.stdout}"
