"""The steps of a command. Each step has a title, a log file, a time and an outcome."""

from __future__ import annotations

import errno
import os
import re
import signal
import subprocess
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO, TypeVar

from weeding_robot_client.exit_codes import FAILED, MISSING, USAGE

TAIL_LINES = 30
REPEAT = 0.001  # If Python ignores an interrupt, the interrupt is repeated after this delay [s].
Result = TypeVar("Result")


class FailureError(Exception):
    """A step failed. The message states the reason."""

    code = FAILED


class MissingError(FailureError):
    """A program, a file, a device or a setting is missing."""

    code = MISSING


class UsageError(FailureError):
    """The arguments of the command are wrong, or the content of its input file is wrong."""

    code = USAGE


def need_file(path: Path, action: str) -> None:
    """Raises MissingError if the file does not exist. The message contains the action for the
    user."""
    if not path.is_file():
        raise MissingError(f"the file {path} does not exist: {action}")


# the running programs, which this process started
_started: list[subprocess.Popen[Any]] = []
# This event is set after an interrupt. From then on, no thread may start another program, even if
# the thread itself has not been interrupted.
_interrupted = threading.Event()


def run(
    log: TextIO,
    command: Sequence[str | Path],
    env: Mapping[str, str] | None = None,
    folder: Path | None = None,
) -> float:
    """Runs a command and writes its output to the log. Raises FailureError if the command fails.

    Returns the processor time that the command used [s]."""
    words = [str(word) for word in command]
    log.write(f"$ {' '.join(words)}\n")
    log.flush()
    if _interrupted.is_set():
        raise FailureError("not started: Ctrl-C ended the command; start it again")
    try:
        program = subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            env=env,
            cwd=folder,
            process_group=0,
        )
    except FileNotFoundError as error:
        raise MissingError(f"{words[0]} is not installed; install it with ./wr setup") from error
    with stoppable(program):
        _, status, used = os.wait4(program.pid, 0)
        program.returncode = os.waitstatus_to_exitcode(status)
    if program.returncode != 0:
        raise FailureError(f"{Path(words[0]).name} ended with exit code {program.returncode}")
    return used.ru_utime + used.ru_stime


def heed_interrupts() -> None:
    """Sets the handlers of signals. SIGTERM then ends the command in the same way as SIGINT.

    SIGTERM needs a handler because a program that limits the time of a command sends SIGTERM. The
    handler of SIGINT is set too, because SIGINT can be ignored in a command that a shell started in
    the background.

    A pool of processes ends its processes with SIGTERM. In a forked process, SIGTERM therefore
    keeps its usual effect: the process ends without an exception.

    Python ignores an exception in the callback of a weak reference, for example during an import.
    If Python ignores an interrupt in this way, a timer repeats the interrupt."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM):
        signal.signal(number, signal.default_int_handler)
    os.register_at_fork(after_in_child=lambda: signal.signal(signal.SIGTERM, signal.SIG_DFL))
    usual = sys.unraisablehook

    def repeat_interrupt(ignored: sys.UnraisableHookArgs) -> None:
        if issubclass(ignored.exc_type, KeyboardInterrupt):
            signal.setitimer(signal.ITIMER_REAL, REPEAT)
        else:
            usual(ignored)

    sys.unraisablehook = repeat_interrupt


@contextmanager
def stoppable(program: subprocess.Popen[Any]) -> Iterator[None]:
    """If an interrupt occurs inside the ``with`` block, ends all running programs of this process.
    The given program is one of them. If an interrupt occurred before the block, ends the given
    program at once."""
    _started.append(program)
    if _interrupted.is_set():
        stop(program)
    try:
        yield
    except KeyboardInterrupt:
        stop_programs()
        raise
    finally:
        _started.remove(program)


def stop_programs() -> None:
    """Ends all running programs of this process, and all programs that were started by these
    programs."""
    for program in list(_started):
        stop(program)


@contextmanager
def no_program_left() -> Iterator[None]:
    """If the ``with`` block ends with an interrupt or an error, ends all running programs of this
    process. Other threads may still run. After an interrupt they can start no further program."""
    _interrupted.clear()
    try:
        yield
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            _interrupted.set()
        stop_programs()
        raise


def stop(program: subprocess.Popen[Any]) -> None:
    """Ends a program and the programs that it started."""
    with suppress(ProcessLookupError):
        os.killpg(program.pid, signal.SIGTERM)


def tail(path: Path) -> str:
    return "\n".join(path.read_text(errors="replace").splitlines()[-TAIL_LINES:])


def cannot_write(error: OSError) -> str | None:
    """Returns the message of an error that the user must correct. Returns None for any other
    error."""
    if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        action = "free space on this disk, then run the command again"
    elif error.errno in (errno.EROFS, errno.EACCES, errno.EPERM):
        action = "make it writable, or copy the project to a folder that is writable"
    else:
        return None
    return f"cannot write {error.filename or 'a file'}: {error.strerror}; {action}"


@contextmanager
def log_file(path: Path) -> Iterator[TextIO]:
    """Opens the log of a step. If the log cannot be written, the step fails."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("w") as log:
            yield log
    except OSError as error:
        raise FailureError(cannot_write(error) or str(error)) from error


def attempt(action: Callable[[TextIO], Result], log: TextIO) -> Result:
    """Runs the action. If the tools themselves have an error, the step fails, and the log contains
    the traceback."""
    try:
        return action(log)
    except FailureError:
        raise
    except Exception as error:
        with suppress(OSError):
            log.write(traceback.format_exc())
        said = cannot_write(error) if isinstance(error, OSError) else None
        raise FailureError(said or f"{type(error).__name__}: {error}") from error


def log_of(root: Path, title: str) -> Path:
    """Returns the file for the output of a step."""
    return root / "build" / "logs" / (re.sub(r"\W+", "-", title).strip("-") + ".log")


@dataclass
class Steps:
    """The steps of one command, and the titles of the failed steps."""

    root: Path
    total: int
    out: TextIO = field(default_factory=lambda: sys.stdout)
    number: int = 0
    failed: list[str] = field(default_factory=list)

    def run(self, title: str, action: Callable[[TextIO], str | None]) -> bool:
        """Runs one step. Returns whether the step succeeded.

        The action writes to the log, and returns a short note or None."""
        self.number += 1
        path = log_of(self.root, title)
        self._say(f"[{self.number}/{self.total}] {title} ... ", end="")
        start = time.monotonic()
        try:
            with log_file(path) as log, redirect_stdout(log), redirect_stderr(log):
                result = attempt(action, log)
        except FailureError as error:
            self.failed.append(title)
            self._say(f"FAILED, {time.monotonic() - start:.1f} s: {error}")
            if path.exists():
                self._say(tail(path))
                self._say(f"The whole log: {path.relative_to(self.root)}")
            return False
        seconds = f"{time.monotonic() - start:.1f} s"
        self._say(f"{result}, {seconds}" if result else seconds)
        return True

    def skip(self, title: str, reason: str) -> None:
        """Prints that a step does not run, with the reason."""
        self.number += 1
        self._say(f"[{self.number}/{self.total}] {title} ... not run: {reason}")

    def _say(self, text: str, end: str = "\n") -> None:
        print(text, end=end, file=self.out, flush=True)
