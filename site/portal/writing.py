"""Files of a folder that is brought up to date: unchanged ones stay, old ones go."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


def write_changed(path: Path, content: str | bytes) -> None:
    """Writes a file unless it has this content: a newer file is read again."""
    data = content.encode() if isinstance(content, str) else content
    if path.is_file() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def remove_others(folder: Path, names: str, kept: Iterable[str]) -> None:
    """Removes the files of these names that are not kept; a kept one is named from the folder."""
    known = set(kept)
    for path in folder.rglob(names):
        if path.is_file() and str(path.relative_to(folder)) not in known:
            path.unlink()
