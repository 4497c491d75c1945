"""Only one command at a time may build, test or make pages, because a second command would change
its files."""

from __future__ import annotations

import fcntl
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

LOCK = Path("build/lock")
HOLDER = "WR_LOCK"  # set for programs that the owner of the lock starts
BUSY = 5  # exit code


class BusyError(Exception):
    """Another command is running."""


@contextmanager
def only_one(root: Path, command: str) -> Iterator[None]:
    """Locks the project; raises BusyError when another process holds it.

    The system frees the lock of a process that ended, in whatever way.
    """
    if os.environ.get(HOLDER) == str(root):
        yield
        return
    path = root / LOCK
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a+", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            file.seek(0)
            raise BusyError(
                f"{file.read().strip() or 'another command'} is at work in this folder. "
                "Wait until that command has ended, or end it with Ctrl-C"
            ) from error
        file.truncate(0)
        file.write(f"./wr {command} (process {os.getpid()}, since {time.strftime('%H:%M')})\n")
        file.flush()
        os.environ[HOLDER] = str(root)
        try:
            yield
        finally:
            del os.environ[HOLDER]
            file.truncate(0)
