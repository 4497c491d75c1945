"""The last commit that changed each file."""

from __future__ import annotations

from pathlib import Path

from traceability.reading.build_evidence import git


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
