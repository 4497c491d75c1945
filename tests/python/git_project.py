"""Git in the projects of tests. The author is always the same."""

from __future__ import annotations

import subprocess
from pathlib import Path


def git(root: Path, *words: str) -> str:
    """Returns the output of a git command in a project."""
    author = ("-c", "user.name=Ida Author", "-c", "user.email=ida@example.org")
    command = ["git", "-C", str(root), *author, "-c", "commit.gpgsign=false", *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
