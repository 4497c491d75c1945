"""./wr sim: which program runs, with which options."""

import os
import subprocess
from functools import partial
from pathlib import Path
from typing import TextIO

import pytest

from tools import cli, sim
from tools.cmake_build import BOARD_PROGRAM
from tools.steps import FailureError
from tools.task_graph import Graph, Task
from tools.tasks import HOST_FIRMWARE, K64_FIRMWARE, VIRTUAL_BOARD


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project whose two programs print their name and their options, one a line."""
    folder = tmp_path / "build/host/sim"
    folder.mkdir(parents=True)
    for name in (sim.PROGRAM, BOARD_PROGRAM):
        add_program(tmp_path, name, 0)
    monkeypatch.setattr(cli, "ROOT", tmp_path)
    replace_builds(monkeypatch, tmp_path)
    monkeypatch.setattr(
        os, "execv", lambda _path, words: subprocess.run(words, check=False).returncode
    )
    return tmp_path


def replace_builds(monkeypatch: pytest.MonkeyPatch, root: Path, broken: str = "") -> None:
    """Builds that do nothing, or fail."""

    def action(name: str, _log: TextIO) -> None:
        if name == broken:
            raise FailureError("no library")

    names = (HOST_FIRMWARE, K64_FIRMWARE, VIRTUAL_BOARD)
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


def test_without_board_the_firmware_runs_on_this_machine(root: Path) -> None:
    assert cli.main(["sim", "--cycles", "3"]) == 0
    link, control = str(root / "build/pc-link"), str(root / "build/sim-control")
    assert called(root) == [
        *("weeding_robot_host", "--link", link, "--control", control, "--cycles", "3")
    ]


def test_with_board_the_image_runs_on_the_virtual_k64(root: Path) -> None:
    assert (
        cli.main(["sim", "--board", "--link", "here", "--control", "there", "--trace", "events"])
        == 0
    )
    image = str(root / "build/k64/weeding_robot")
    assert called(root) == [
        *("weeding_robot_board", "--image", f"{image}.bin", "--elf", f"{image}.elf"),
        *("--robot", "--link", "here", "--control", "there", "--trace", "events"),
    ]


def test_a_scenario_takes_the_place_of_the_link(root: Path) -> None:
    assert cli.main(["sim", "--scenario", "a.scenario", "--reports", "r.csv"]) == 0
    assert called(root)[1:] == ["--scenario", "a.scenario", "--reports", "r.csv"]


def test_a_fast_run_has_no_link(root: Path) -> None:
    assert cli.main(["sim", "--board", "--cycles", "9", "--fast"]) == 0
    assert called(root)[6:] == ["--cycles", "9", "--fast"]


def test_resets_are_passed_to_the_virtual_board(root: Path) -> None:
    assert cli.main(["sim", "--board", "--cycles", "9", "--fast", "--resets"]) == 0
    assert called(root)[6:] == ["--cycles", "9", "--fast", "--resets"]


@pytest.mark.usefixtures("root")
def test_resets_need_the_virtual_board() -> None:
    with pytest.raises(SystemExit):
        cli.main(["sim", "--resets"])


@pytest.mark.parametrize("code", [1, 4])
def test_the_exit_code_of_the_program_is_that_of_the_command(root: Path, code: int) -> None:
    add_program(root, BOARD_PROGRAM, code)
    assert cli.main(["sim", "--board"]) == code


def test_what_cannot_be_built_is_not_run(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    replace_builds(monkeypatch, root, broken=VIRTUAL_BOARD)
    assert cli.main(["sim", "--board"]) == 1
    assert "no library" in capsys.readouterr().out
    assert not (root / "called").exists()


def test_a_program_that_cannot_be_run_is_said(
    root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (root / "build/host/sim" / sim.PROGRAM).unlink()
    assert cli.main(["sim"]) == 1
    assert "weeding_robot_host: No such file" in capsys.readouterr().err


def test_without_an_image_the_board_is_not_switched_on(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replace_builds(monkeypatch, root, broken=K64_FIRMWARE)
    assert cli.main(["sim", "--board"]) == 1
    assert not (root / "called").exists()


def test_the_image_of_a_product_can_be_run(root: Path) -> None:
    assert cli.main(["sim", "--board", "--product", "weeding_robot_pc"]) == 0
    image = str(root / "build/k64/weeding_robot_pc")
    assert called(root)[1:5] == ["--image", f"{image}.bin", "--elf", f"{image}.elf"]


@pytest.mark.parametrize(
    "options", [["--product", "weeding_robot_pc"], ["--board", "--product", "x"]]
)
def test_a_product_is_one_of_those_on_the_board(root: Path, options: list[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        cli.main(["sim", *options])
    assert ended.value.code == 2
    assert not (root / "called").exists()
