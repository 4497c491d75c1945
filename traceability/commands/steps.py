"""Steps of a command: each has a title, a log file, a time, and an outcome."""

from __future__ import annotations

import re
import subprocess
import sys
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO

TAIL_LINES = 30


class FailureError(Exception):
    """A step failed. The message says what is wrong."""


class MissingError(FailureError):
    """What the command needs is not there."""


def run(log: TextIO, command: Sequence[str | Path], env: Mapping[str, str] | None = None) -> None:
    """Runs a command with its output in the log; raises FailureError when it fails."""
    words = [str(word) for word in command]
    log.write(f"$ {' '.join(words)}\n")
    log.flush()
    try:
        code = subprocess.run(
            words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=env, check=False
        ).returncode
    except FileNotFoundError as error:
        raise FailureError(f"{words[0]} is not installed") from error
    if code != 0:
        raise FailureError(f"{Path(words[0]).name} ended with exit code {code}")


def tail(path: Path, lines: int = TAIL_LINES) -> str:
    return "\n".join(path.read_text(errors="replace").splitlines()[-lines:])


def _attempt(action: Callable[[TextIO], str | None], log: TextIO) -> str | None:
    """Runs the action; an error in the tools themselves fails the step, its place is in the log."""
    try:
        return action(log)
    except FailureError:
        raise
    except Exception as error:
        log.write(traceback.format_exc())
        raise FailureError(f"{type(error).__name__}: {error}") from error


@dataclass
class Steps:
    """Runs the steps of one command and remembers those that failed."""

    root: Path
    total: int
    out: TextIO = field(default_factory=lambda: sys.stdout)
    number: int = 0
    failed: list[str] = field(default_factory=list)

    def run(self, title: str, action: Callable[[TextIO], str | None]) -> bool:
        """Runs one step. The action writes to the log and returns a short note, or nothing."""
        self.number += 1
        path = self.log_of(title)
        path.parent.mkdir(parents=True, exist_ok=True)
        self._say(f"[{self.number}/{self.total}] {title} ... ", end="")
        start = time.monotonic()
        try:
            with path.open("w") as log, redirect_stdout(log), redirect_stderr(log):
                note = _attempt(action, log)
        except FailureError as error:
            self.failed.append(title)
            self._say(f"FAILED, {time.monotonic() - start:.1f} s: {error}")
            self._say(tail(path))
            self._say(f"The whole log: {path.relative_to(self.root)}")
            return False
        seconds = f"{time.monotonic() - start:.1f} s"
        self._say(f"{note}, {seconds}" if note else seconds)
        return True

    def log_of(self, title: str) -> Path:
        """Where the output of a step is written."""
        return self.root / "build" / "logs" / (re.sub(r"\W+", "-", title).strip("-") + ".log")

    def skip(self, title: str, reason: str) -> None:
        """Counts a step that cannot run."""
        self.number += 1
        self._say(f"[{self.number}/{self.total}] {title} ... not run: {reason}")

    def _say(self, text: str, end: str = "\n") -> None:
        print(text, end=end, file=self.out, flush=True)
