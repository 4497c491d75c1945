"""Updates the files of a folder: leaves unchanged files as they are and removes old files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


def write_changed(path: Path, content: str | bytes) -> None:
    """Writes a file only if its content changes, because Sphinx reads each newer file again."""
    data = content.encode() if isinstance(content, str) else content
    if path.is_file() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def remove_others(folder: Path, names: str, kept: Iterable[str]) -> None:
    """Removes the files below a folder that match the pattern ``names`` and are not in ``kept``.
    The paths in ``kept`` are relative to the folder."""
    kept_names = set(kept)
    for path in folder.rglob(names):
        if path.is_file() and str(path.relative_to(folder)) not in kept_names:
            path.unlink()
