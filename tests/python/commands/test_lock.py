"""If two commands run at the same time, the second command ends. Its message contains the name of
the first command."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tools import cli
from tools.lock import HOLDER, LOCK, BusyError, only_one
from weeding_robot_client.exit_codes import BUSY

pytestmark = pytest.mark.runs_tools

HOLD = """
import sys, time
from pathlib import Path
from tools.lock import only_one
with only_one(Path(sys.argv[1]), "portal"):
    print("held", flush=True)
    time.sleep(100)
"""


def hold(root: Path) -> "subprocess.Popen[str]":
    environment = {name: value for name, value in os.environ.items() if name != HOLDER}
    words = [sys.executable, "-c", HOLD, str(root)]
    program = subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment)
    assert program.stdout is not None
    assert program.stdout.readline() == "held\n"
    return program


def test_the_second_command_says_who_is_at_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cli, "ROOT", tmp_path)
    monkeypatch.delenv(HOLDER, raising=False)
    with hold(tmp_path) as program:
        assert cli.main(["check"]) == BUSY
        assert f"./wr portal (process {program.pid}, since" in capsys.readouterr().err
        program.kill()
    with only_one(tmp_path, "check"):  # If a process was killed, its lock is free.
        pass


def test_a_command_that_the_holder_starts_is_not_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(HOLDER, raising=False)
    with only_one(tmp_path, "test"), only_one(tmp_path, "check"):
        assert (tmp_path / LOCK).read_text().startswith("./wr test")
    monkeypatch.delenv(HOLDER, raising=False)
    with only_one(tmp_path, "test"):
        del os.environ[HOLDER]
        with pytest.raises(BusyError), only_one(tmp_path, "check"):
            pass
        os.environ[HOLDER] = str(tmp_path)
