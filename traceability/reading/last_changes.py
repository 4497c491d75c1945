"""The last commit that changed each file, and the changes of the firmware since a commit."""

from __future__ import annotations

import re
from pathlib import Path

from traceability.reading.build_evidence import git
from traceability.sources import DESIGN

COMMENT_LINE = "^ *//"


def last_changes(root: Path) -> dict[str, str]:
    """Returns for each file the date and the hash of the last commit that changed it. Returns an
    empty dictionary without git."""
    found: dict[str, str] = {}
    log = git(root, "log", "--no-merges", "--format=%x00%cs %h", "--name-only")
    for entry in filter(None, log.split("\0")):
        commit, *files = entry.split("\n")
        for file in filter(None, files):
            found.setdefault(file, commit)
    return found


def changed_since(root: Path, commit: str) -> int | None:
    """Returns the number of files of the firmware in which lines other than comment lines have
    changed since a commit. Returns ``None`` if the commit is unknown, for example because the
    history was not cloned.
    """
    if not commit or not git(root, "rev-parse", "--verify", "--quiet", f"{commit}^{{commit}}"):
        return None
    changed = git(root, "diff", "--numstat", "-w", "-I", COMMENT_LINE, commit, "--", *DESIGN)
    return len([line for line in changed.splitlines() if re.search(r"\.(cpp|hpp|ld)$", line)])
