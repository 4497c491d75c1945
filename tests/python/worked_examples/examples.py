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
PYTHON = re.compile(r"^\+\+\+ b/(\S+\.py)$", re.MULTILINE)  # an edited file of Python


def patches(example: str) -> list[str]:
    section = (ROOT / PAGE).read_text(encoding="utf-8").split(f".. _{example}:")[1]
    blocks = BLOCK.findall(section.partition("\n.. _")[0])
    return [dedent(block).lstrip("\n") for block in blocks]


def apply(root: Path, example: str) -> None:
    """Applies an example to a copy of the project. The lines around a change must be the same in
    the file and on the page. The program ``patch`` is not sufficient: it places a change without
    lines above it only at the start of a file."""
    for text in patches(example):
        done = subprocess.run(
            ["git", "apply"], cwd=root, input=text, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"an example no longer applies; update {PAGE}: {done.stderr}"
