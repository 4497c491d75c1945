"""Writes a file in one step. A program that reads the file finds either the complete previous
content or the complete new content, even if the writing program is killed or the disk is full."""

from __future__ import annotations

import json
import os
import threading
from pathlib import Path


def write_whole(path: Path, content: str | bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f"{path.name}.{os.getpid()}-{threading.get_ident()}")
    try:
        draft.write_bytes(content.encode() if isinstance(content, str) else content)
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def write_json(path: Path, content: object) -> None:
    write_whole(path, json.dumps(content, indent=1) + "\n")
