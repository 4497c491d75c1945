"""./wr debug: its choice of the debugger and of the program."""

import json
import re
from pathlib import Path

import pytest

from tools import cli, debug
from traceability.reading.tool_tests import failed_tests
from weeding_robot_client.exit_codes import USAGE

pytestmark = pytest.mark.reads("tests", ".vscode", "CMakePresets.json", "wr")

ROOT = Path(__file__).parents[3]
SCENARIO = str(ROOT / "sim/scenario/examples/velocity_step.scenario")
ON_BOTH = "OrdersOfRobot.FR20_OnlyTheNewestOrderIsReadAndOnce"
ON_BOARD = "K64BoardOnBoard.FR71_NoOutputLeavesItsSafeLevel"


@pytest.fixture
def shown(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> "type[Shown]":
    monkeypatch.setattr(debug, "gdb_for_arm", lambda: "gdb-multiarch")
    Shown.capsys = capsys
    return Shown


class Shown:
    """The commands that ./wr debug prints."""

    capsys: pytest.CaptureFixture[str]

    def __init__(self, *words: str) -> None:
        assert cli.main(["debug", "--print", *words]) == 0
        self.lines = self.capsys.readouterr().out.splitlines()


def test_a_test_of_this_machine_is_debugged_in_its_own_program(shown: type[Shown]) -> None:
    (words,) = shown(ON_BOTH).lines
    assert re.match(r"gdb -q --args \S+/build/debug/tests/firmware_tests ", words)
    assert f"{ON_BOTH}:*/{ON_BOTH}/*:" in words


@pytest.mark.parametrize("words", [[ON_BOARD], ["--board", ON_BOTH]])
def test_a_test_of_the_board_is_debugged_in_the_firmware(
    shown: type[Shown], words: list[str]
) -> None:
    server, gdb = shown(*words).lines
    port = re.match(r"WR_GDB=(\d+) WR_IMAGE=\S+ \S+/build/host/tests/board_tests ", server)
    assert port
    assert gdb.startswith("gdb-multiarch -q ")
    assert "/build/k64_calls/weeding_robot_paper.elf" in gdb
    assert gdb.endswith(f"'target remote :{port[1]}'")


def test_a_test_of_the_emulator_is_debugged_on_this_machine(shown: type[Shown]) -> None:
    (words,) = shown("ExecutedCodeTest.EachHalfWordHasItsBit").lines
    assert "/build/host/tests/board_tests " in words


@pytest.mark.parametrize("words", [[], [SCENARIO]])
def test_a_scenario_and_the_robot_are_debugged_on_the_board(
    shown: type[Shown], words: list[str]
) -> None:
    server, gdb = shown("--product", "weeding_robot_pc", *words).lines
    assert "/weeding_robot_pc.bin " in server
    assert (f"--scenario {SCENARIO}" in server) == bool(words)
    assert server.rpartition(" ")[2] in gdb


def test_a_test_of_the_tools_is_debugged_in_python(shown: type[Shown]) -> None:
    (words,) = shown("tests/python/tools/test_debug.py::test_x").lines
    assert words.endswith("--pdb tests/python/tools/test_debug.py::test_x")


@pytest.mark.parametrize("words", [["No.Test"], ["--board", "PaceTest.x"]])
def test_an_unknown_test_is_an_error(capsys: pytest.CaptureFixture[str], words: list[str]) -> None:
    with pytest.raises(SystemExit, match=str(USAGE)):
        cli.main(["debug", *words])
    assert "there is no test" in capsys.readouterr().err


def test_a_failed_test_of_the_tools_has_its_command(tmp_path: Path) -> None:
    case = '<testcase classname="tests.python.tools.test_x" name="test_y[1]">{}</testcase>'
    inside = case.format("<failure/>") + case.format("").replace("test_y", "test_z")
    (tmp_path / "r.xml").write_text(f"<testsuites><testsuite>{inside}</testsuite></testsuites>")
    assert failed_tests(tmp_path / "r.xml") == ["tests/python/tools/test_x.py::test_y[1]"]


def test_the_editor_finds_its_tasks_and_files() -> None:
    launch, tasks, settings = (
        json.loads((ROOT / ".vscode" / f"{name}.json").read_text())
        for name in ("launch", "tasks", "settings")
    )
    labels = {task["label"]: task for task in tasks["tasks"]}
    for configuration in launch["configurations"]:
        assert configuration["preLaunchTask"] in labels
    for task in labels.values():
        assert task.get("dependsOn", "firmware") in labels
        if task["command"].startswith("./wr "):
            assert task["command"].split()[1] in (ROOT / "wr").read_text()
    port = re.search(r"--gdb (\d+)", labels["virtual board"]["command"])
    assert port
    assert f"localhost:{port[1]}" in launch["configurations"][0]["gdbTarget"]
    presets = json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
    names = {preset["name"] for preset in presets}
    assert {"host", "debug", "k64"} <= names
    assert settings["C_Cpp.default.compileCommands"].split("/build/")[1].split("/")[0] in names
