"""The steps of a command: their output, their logs, and their failures."""

import io
import os
import re
from pathlib import Path
from threading import Timer
from typing import TextIO

import pytest

from tools.steps import FailureError, Steps, no_program_left, run, stop_programs


@pytest.fixture
def steps(tmp_path: Path) -> Steps:
    return Steps(tmp_path, 2, io.StringIO())


def said(steps: Steps) -> str:
    assert isinstance(steps.out, io.StringIO)
    return steps.out.getvalue()


def test_a_step_that_succeeds_is_one_line_with_its_note_and_time(steps: Steps) -> None:
    assert steps.run("tests (trace)", lambda _log: "3 passed")
    assert re.fullmatch(r"\[1/2\] tests \(trace\) \.\.\. 3 passed, [\d.]+ s\n", said(steps))
    assert not steps.failed


def test_output_of_a_command_goes_to_the_log(steps: Steps) -> None:
    assert steps.run("tests (trace)", lambda log: run(log, ["sh", "-c", "echo out; echo err >&2"]))
    log = (steps.root / "build/logs/tests-trace.log").read_text()
    assert log == "$ sh -c echo out; echo err >&2\nout\nerr\n"
    assert "err" not in said(steps)


def test_a_command_that_fails_shows_the_end_of_its_log(steps: Steps) -> None:
    command = ["sh", "-c", "seq 1 100; exit 5"]
    assert not steps.run("build", lambda log: run(log, command))
    lines = said(steps).splitlines()
    assert "FAILED" in lines[0]
    assert "sh ended with exit code 5" in lines[0]
    assert lines[1:31] == [str(number) for number in range(71, 101)]
    assert lines[31] == "The whole log: build/logs/build.log"
    assert steps.failed == ["build"]


def test_a_program_that_is_missing_fails_the_step(steps: Steps) -> None:
    assert not steps.run("build", lambda log: run(log, ["no-such-program"]))
    assert "no-such-program is not installed" in said(steps)


def test_an_error_in_the_tools_fails_the_step_and_its_place_is_in_the_log(steps: Steps) -> None:
    def broken(_log: TextIO) -> None:
        raise ValueError("broken")

    assert not steps.run("model", broken)
    assert "ValueError: broken" in said(steps)
    assert "test_steps.py" in (steps.root / "build/logs/model.log").read_text()


def test_an_interrupt_is_not_swallowed(steps: Steps) -> None:
    def interrupted(_log: TextIO) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        steps.run("model", interrupted)


def test_an_interrupt_ends_a_program_with_those_that_it_started() -> None:
    """The pipe of the log stays open until all programs have ended."""
    reading, writing = os.pipe()
    with os.fdopen(writing, "w") as log, os.fdopen(reading) as output:
        Timer(0.5, stop_programs).start()
        with pytest.raises(FailureError, match="exit code -15"):
            run(log, ["sh", "-c", "sleep 60 & sleep 60"])
        log.close()
        assert output.read() == "$ sh -c sleep 60 & sleep 60\n"


def test_after_an_interrupt_a_thread_starts_no_program(tmp_path: Path) -> None:
    def late(log: TextIO) -> None:
        with pytest.raises(FailureError, match="Ctrl-C ended the command"):
            run(log, ["touch", tmp_path / "made"])

    with (tmp_path / "log").open("w") as log:
        with pytest.raises(KeyboardInterrupt), no_program_left():
            raise KeyboardInterrupt
        late(log)
        with no_program_left():
            run(log, ["true"])
    assert not (tmp_path / "made").exists()
