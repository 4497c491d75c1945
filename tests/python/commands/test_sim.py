"""./wr sim: its choice of the program and of the program's options."""

import os
import subprocess
from functools import partial
from pathlib import Path
from typing import TextIO

import pytest

from tools import cli, sim
from tools.closed_loop_runs import HOST_PROGRAM
from tools.cmake_build import BOARD_PROGRAM
from tools.steps import FailureError
from tools.task_graph import Graph, Task
from tools.tasks import HOST_FIRMWARE, K64_FIRMWARE, RECORDED_IMAGES, VIRTUAL_BOARD

pytestmark = pytest.mark.runs_tools


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Returns a project with two programs. Each program writes its name and its options to the file
    ``called``. Each line contains the name or one option."""
    folder = tmp_path / "build/host/sim"
    folder.mkdir(parents=True)
    for name in (HOST_PROGRAM, BOARD_PROGRAM):
        add_program(tmp_path, name, 0)
    monkeypatch.setattr(cli, "ROOT", tmp_path)
    replace_builds(monkeypatch, tmp_path)
    monkeypatch.setattr(
        os, "execv", lambda _path, words: subprocess.run(words, check=False).returncode
    )
    return tmp_path


def replace_builds(monkeypatch: pytest.MonkeyPatch, root: Path, broken: str = "") -> None:
    """Replaces the builds by stubs. The build ``broken`` fails, and the others do nothing."""

    def action(name: str, _log: TextIO) -> None:
        if name == broken:
            raise FailureError("no library")

    names = (HOST_FIRMWARE, K64_FIRMWARE, RECORDED_IMAGES, VIRTUAL_BOARD)
    tasks = [Task(name, partial(action, name), always=True) for name in names]
    monkeypatch.setattr(sim, "graph", lambda _root: Graph(root, tasks))


def add_program(root: Path, name: str, code: int) -> None:
    program = root / "build/host/sim" / name
    program.write_text(
        f'#!/bin/sh\nprintf "%s\\n" {name} "$@" >"{root}/called"\n'
        f"echo 'finding: clock-gate: UART0'\nexit {code}\n"
    )
    program.chmod(0o755)


def called(root: Path) -> list[str]:
    return (root / "called").read_text().splitlines()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (
            "--cycles 3",
            "weeding_robot_host --link {root}/build/pc-link --control {root}/build/sim-control"
            " --cycles 3",
        ),
        (
            "--scenario a.scenario --reports r.csv",
            "weeding_robot_host --scenario a.scenario --reports r.csv",
        ),
        (
            "--board --link here --control there --trace events",
            "weeding_robot_board --image {image}.bin --elf {image}.elf"
            " --robot --link here --control there --trace events",
        ),
        (
            "--board --cycles 9 --fast --resets",
            "weeding_robot_board --image {image}.bin --elf {image}.elf"
            " --robot --cycles 9 --fast --resets",
        ),
        (
            "--board --scenario a.scenario --gdb 0",
            "weeding_robot_board --image {debugged}.bin --elf {debugged}.elf"
            " --robot --scenario a.scenario --gdb 0",
        ),
        (
            "--board --gdb 7777",
            "weeding_robot_board --image {debugged}.bin --elf {debugged}.elf"
            " --robot --link {root}/build/pc-link --gdb 7777",
        ),
        (
            "--board --product weeding_robot_pc --cycles 9 --fast",
            "weeding_robot_board --image {image}_pc.bin --elf {image}_pc.elf"
            " --robot --cycles 9 --fast",
        ),
    ],
)
def test_options_choose_the_program_and_its_words(
    root: Path, monkeypatch: pytest.MonkeyPatch, options: str, words: str
) -> None:
    monkeypatch.chdir(root)
    Path("a.scenario").touch()
    assert cli.main(["sim", *options.split()]) == 0
    image = root / "build/k64/weeding_robot"
    debugged = root / "build/k64_calls/weeding_robot"
    assert called(root) == words.format(root=root, image=image, debugged=debugged).split()


@pytest.mark.parametrize(
    "options", ["--resets", "--product weeding_robot_pc", "--board --product x"]
)
def test_options_that_do_not_fit_are_wrong_usage(root: Path, options: str) -> None:
    with pytest.raises(SystemExit) as ended:
        cli.main(["sim", *options.split()])
    assert ended.value.code == 2
    assert not (root / "called").exists()


@pytest.mark.parametrize("code", [1, 4])
def test_the_exit_code_of_the_program_is_that_of_the_command(root: Path, code: int) -> None:
    add_program(root, BOARD_PROGRAM, code)
    assert cli.main(["sim", "--board"]) == code


@pytest.mark.parametrize("broken", [VIRTUAL_BOARD, K64_FIRMWARE])
def test_a_failed_build_runs_no_program(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], broken: str
) -> None:
    replace_builds(monkeypatch, root, broken)
    assert cli.main(["sim", "--board"]) == 1
    assert "no library" in capsys.readouterr().out
    assert not (root / "called").exists()


def test_a_program_that_is_missing_is_an_error(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (root / "build/host/sim" / HOST_PROGRAM).unlink()
    assert cli.main(["sim"]) == 1
    assert "weeding_robot_host: No such file" in capsys.readouterr().err
