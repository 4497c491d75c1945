"""Only one command at a time may build, test or write pages. A second command would change the
files of the first command.

A command that was ended by force can leave programs behind, such as a build. The next command ends
these programs before it begins."""

from __future__ import annotations

import fcntl
import os
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

LOCK = Path("build/lock")
HOLDER = "WR_LOCK"  # environment variable that marks all programs started by the owner of the lock
GRACE = 2.0  # A program that must end is killed if it still runs after this time [s].
MOST_WAIT = 10.0  # longest time to wait until the programs have ended [s]


class BusyError(Exception):
    """Another command is running."""


@contextmanager
def only_one(root: Path, command: str) -> Iterator[None]:
    """Locks the project. Raises BusyError if another process has the lock.

    When a process ends, even by a crash, the system frees the lock of the process."""
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
                f"{file.read().strip() or 'another command'} is running in this folder. Wait until "
                "that command has ended, or end it with Ctrl-C"
            ) from error
        file.truncate(0)
        file.write(f"./wr {command} (process {os.getpid()}, since {time.strftime('%H:%M')})\n")
        file.flush()
        end_programs_of(root)
        os.environ[HOLDER] = str(root)
        try:
            yield
        except BaseException:
            end_programs_of(root)
            raise
        finally:
            os.environ.pop(HOLDER, None)
            with suppress(OSError):
                file.truncate(0)


@contextmanager
def outliving() -> Iterator[None]:
    """If a program, such as the browser, is started inside the ``with`` block, it continues after
    the end of the command."""
    owner = os.environ.pop(HOLDER, None)
    try:
        yield
    finally:
        if owner is not None:
            os.environ[HOLDER] = owner


def end_programs_of(root: Path) -> None:
    """Ends all programs that were started by an owner of the lock. Waits until they have ended."""
    begin = time.monotonic()
    while (left := programs_of(root)) and time.monotonic() < begin + MOST_WAIT:
        gentle = time.monotonic() < begin + GRACE
        for process in left:
            with suppress(ProcessLookupError):
                os.kill(process, signal.SIGTERM if gentle else signal.SIGKILL)
        time.sleep(0.02)


def programs_of(root: Path) -> list[int]:
    """Returns the processes whose environment contains the mark of the owner of the lock."""
    mark = f"{HOLDER}={root}".encode()
    processes = []
    for path in Path("/proc").glob("[0-9]*/environ"):
        with suppress(OSError):
            if mark in path.read_bytes().split(b"\0"):
                processes.append(int(path.parent.name))
    return processes
