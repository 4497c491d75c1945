"""A signal ends a command at a random time. The next run has the right results. If the sources are
unchanged, the next run repeats no completed task.
"""

from __future__ import annotations

import os
import random
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.python.commands.small_command import RESULT, expected, write_sources
from tools.lock import HOLDER, only_one, outliving, programs_of
from weeding_robot_client.exit_codes import BUSY, INTERRUPTED

pytestmark = pytest.mark.runs_tools

SOURCE = Path(__file__).resolve().parents[3]
# The command, as ./wr starts it. The program prints a line as soon as it can handle interrupts.
COMMAND = """
import sys
from pathlib import Path
from tools.steps import heed_interrupts
heed_interrupts()
print("begun", flush=True)
try:
    from tests.python.commands.small_command import main
    sys.exit(main(Path(sys.argv[1])))
except KeyboardInterrupt:
    sys.exit(130)
"""
# A command that is interrupted in the callback of a weak reference. Python ignores exceptions of
# this callback.
IN_CALLBACK = """
import signal, sys, time, weakref
from tools.steps import heed_interrupts
class Thing: ...
heed_interrupts()
thing = Thing()
reference = weakref.ref(thing, lambda _reference: signal.raise_signal(signal.SIGINT))
try:
    del thing
    time.sleep(10)
except KeyboardInterrupt:
    sys.exit(130)
"""
KILLS = 8  # number of times that each signal is sent
SEED = int(os.environ.get("WR_SEED", "1"))


def start(root: Path) -> subprocess.Popen[str]:
    environment = {name: value for name, value in os.environ.items() if name != HOLDER}
    program = subprocess.Popen(
        [sys.executable, "-c", COMMAND, str(root)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        cwd=SOURCE,
    )
    assert program.stdout is not None
    assert program.stdout.readline() == "begun\n"
    return program


def run(root: Path) -> str:
    program = start(root)
    output, errors = program.communicate(timeout=60)
    assert (program.returncode, errors) == (0, "")
    return output


def done(output: str) -> set[str]:
    """Returns the completed tasks."""
    return set(re.findall(r"^\[\d/3\] (.*?) \.\.\. .*(?: s|unchanged)$", output, re.MULTILINE))


def unchanged(output: str) -> set[str]:
    return set(re.findall(r"^\[\d/3\] (.*?) \.\.\. (?:.*, )?unchanged$", output, re.MULTILINE))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_after_a_run_that_was_ended_the_next_run_is_right(
    tmp_path: Path, number: signal.Signals
) -> None:
    chosen = random.Random(SEED + number)
    write_sources(tmp_path, "text 0")
    begin = time.monotonic()
    run(tmp_path)
    whole = time.monotonic() - begin
    ended = 0
    for turn in range(1, KILLS + 1):
        write_sources(tmp_path, f"text {turn}")
        program = start(tmp_path)
        time.sleep(chosen.uniform(0, 0.8 * whole))
        program.send_signal(number)
        before, errors = program.communicate(timeout=60)
        print(f"WR_SEED={SEED}, {number.name}, turn {turn}: exit code {program.returncode}")
        if program.returncode == 0:
            whole /= 2  # The run ended before the signal. The next signals come earlier.
        else:
            ended += 1
        assert program.returncode in (0, INTERRUPTED, -number), before + errors
        assert "Traceback" not in errors
        if program.returncode == INTERRUPTED:
            assert programs_of(tmp_path) == []
        if chosen.random() < 0.5:
            # Restores the sources of the previous turn. That turn ended with a complete run.
            write_sources(tmp_path, f"text {turn - 1}")
            run(tmp_path)
        else:
            assert unchanged(run(tmp_path)) >= done(before)
        assert (tmp_path / RESULT).read_text() == expected(tmp_path)
        assert unchanged(run(tmp_path)) == {"copy src/a.txt", "copy src/b.txt", "sum"}
        write_sources(tmp_path, f"text {turn}")
        run(tmp_path)
    assert ended > KILLS // 3, "most signals arrived after the run had ended"


def test_an_interrupt_during_a_callback_is_not_lost() -> None:
    program = subprocess.run(
        [sys.executable, "-c", IN_CALLBACK], capture_output=True, text=True, cwd=SOURCE, check=False
    )
    assert (program.returncode, program.stderr) == (INTERRUPTED, "")


def test_the_next_command_ends_the_programs_that_a_killed_one_left(tmp_path: Path) -> None:
    write_sources(tmp_path, "long", lines=10_000)
    program = start(tmp_path)
    end = time.monotonic() + 60
    while len(programs_of(tmp_path)) < 2 and time.monotonic() < end:
        time.sleep(0.01)
    program.kill()
    program.communicate()
    assert programs_of(tmp_path) != []
    write_sources(tmp_path, "short")
    run(tmp_path)
    assert programs_of(tmp_path) == []
    assert (tmp_path / RESULT).read_text() == expected(tmp_path)


def test_a_program_that_outlives_its_command_is_not_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(HOLDER, raising=False)
    with only_one(tmp_path, "portal"), outliving():
        program = subprocess.Popen(["sleep", "100"])
    with only_one(tmp_path, "check"):
        assert program.poll() is None
    program.kill()
    program.wait()


def test_of_commands_that_start_at_once_one_runs_and_the_others_say_so(tmp_path: Path) -> None:
    write_sources(tmp_path, "text", lines=10_000)
    programs = [start(tmp_path) for _ in range(4)]
    end = time.monotonic() + 60
    while len(running(programs)) > 1 and time.monotonic() < end:
        time.sleep(0.01)
    (owner,) = running(programs)
    for program in programs:
        if program is not owner:
            assert program.wait() == BUSY
            text = f"process {owner.pid}.* is running in this folder. Wait until that"
            assert program.stderr is not None
            assert re.search(text, program.stderr.read())
    owner.send_signal(signal.SIGINT)
    owner.communicate(timeout=60)
    assert owner.returncode == INTERRUPTED


def running(programs: list[subprocess.Popen[str]]) -> list[subprocess.Popen[str]]:
    return [program for program in programs if program.poll() is None]
