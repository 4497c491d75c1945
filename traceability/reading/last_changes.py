"""The last commit that changed each file, and the changes of the firmware since a commit."""

from __future__ import annotations

import re
from pathlib import Path

from traceability.reading.build_evidence import git
from traceability.sources import DESIGN, text_of

FIRMWARE = re.compile(r"\.(cpp|hpp|ld)$")
NO_CODE = re.compile(r"//[^\n]*|/\*.*?\*/|\s+", re.DOTALL)  # comments and white space


def last_changes(root: Path) -> dict[str, str]:
    """Returns the date and the hash of the last commit that changed each file. The file of the
    newest commit is the first. A merge is regarded as a change of a file only if the file differs
    from the same file in all parents of the merge. Returns an empty dictionary if git fails."""
    found: dict[str, str] = {}
    log = git(root, "log", "-c", "--format=%x00%cs %h", "--name-only")
    for entry in filter(None, log.split("\0")):
        commit, *files = entry.split("\n")
        for file in filter(None, files):
            found.setdefault(file, commit)
    return found


def changed_since(root: Path, commit: str) -> int | None:
    """Returns the number of files of the firmware whose code has changed since a commit. Changes of
    comments and of the layout are ignored. Returns ``None`` if the commit is unknown, for example
    because the history was not cloned."""
    if not commit or not git(root, "rev-parse", "--verify", "--quiet", f"{commit}^{{commit}}"):
        return None
    names = git(root, "diff", "--name-only", "--no-renames", commit, "--", *DESIGN).splitlines()
    return sum(
        _code(git(root, "show", f"{commit}:{name}")) != _code(text_of(root / name))
        for name in filter(FIRMWARE.search, names)
    )


def _code(text: str) -> str:
    return NO_CODE.sub("", text)
