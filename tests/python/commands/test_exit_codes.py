"""Each command has a help text. All exit codes are in the table that ./wr --help shows."""

import re
import subprocess
from pathlib import Path

import pytest

from tools import cli
from tools.steps import FailureError, MissingError, UsageError
from weeding_robot_client import exit_codes
from weeding_robot_client.exit_codes import DONE, FAILED, MISSING, USAGE

pytestmark = pytest.mark.runs_tools

ROOT = Path(__file__).parents[3]
(COMMANDS,) = (one.choices for one in cli.parser()._actions if one.dest == "command")
assert COMMANDS is not None
NEEDED = {"review": ["FR-15"], "diff": ["HEAD"], "impact": ["FR-15"], "plot": ["a.csv"]}
NEEDED["campaign"] = ["faults"]
NONE = "/no-folder/none"
# Command with a missing file, folder or device -> the next action in the message of this command.
WITHOUT_FILE = {
    f"plot {NONE}.mcap": "./wr monitor",
    f"debug {NONE}.scenario": "sim/scenario/examples",
    "debug tests/python/none.py::test_none": "the page 'Tests'",
    f"sim --scenario {NONE}.scenario": "sim/scenario/examples",
    f"sim --board --trace {NONE}.csv --cycles 1": "make the folder",
    "impact src/none.hpp": "name a file of the project",
    f"flash --image {NONE}.bin": "./wr firmware",
    f"flash --bluetooth-key {NONE}.key": "od -An -tx1",
    f"bench --port {NONE}": "connect the board",
    f"drive --script {NONE}": "--script",
    f"monitor --link {NONE}": "--link",
    f"arm --link {NONE}": "--link",
    f"acknowledge --link {NONE}": "--link",
    f"monitor --csv {NONE}.csv": "Name another file",
    f"bring-up --simulated --link {NONE} --control {NONE}": "./wr sim",
    "serve": "./wr portal",
    "book": "./wr portal",
    "release": "git clone",
    "verify-build": "git clone",
}
UNKNOWN_NAMES = (
    "review FR-0",
    "review",
    "diff no-commit",
    "impact no-commit..HEAD",
    "impact FR-0",
    "debug No.Test",
    "prove no-property",
    "check --drift no-check",
    "test no-part",
    "campaign no-kind",
)


def ended(capsys: pytest.CaptureFixture[str], words: list[str]) -> tuple[int, str, str]:
    """Returns the exit code of a command, its output and its errors."""
    try:
        code = cli.main(words)
    except SystemExit as exited:
        code = int(exited.code or 0)
    shown = capsys.readouterr()
    return code, shown.out, shown.err


@pytest.mark.parametrize("command", COMMANDS)
def test_each_command_explains_itself(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    code, shown, _ = ended(capsys, [command, "--help"])
    assert code == DONE
    assert shown.startswith(f"usage: ./wr {command} [-h]")


@pytest.mark.parametrize("command", COMMANDS)
def test_a_wrong_option_shows_the_usage_of_its_command(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    code, _, error = ended(capsys, [command, *NEEDED.get(command, []), "--fly-away"])
    assert code == USAGE
    assert error.startswith(f"usage: ./wr {command} [-h]")
    assert "--fly-away" in error


@pytest.mark.parametrize("words", WITHOUT_FILE)
def test_a_missing_input_is_named_with_the_next_action(
    words: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(cli, "ROOT", tmp_path)
    code, _, error = ended(capsys, words.split())
    assert code == MISSING
    assert WITHOUT_FILE[words] in error
    assert "Errno" not in error
    assert "Traceback" not in error


@pytest.mark.parametrize("words", UNKNOWN_NAMES)
def test_a_name_that_does_not_exist_is_wrong_usage(
    words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    code, _, error = ended(capsys, words.split())
    assert code == USAGE
    assert error.startswith(f"usage: ./wr {words.split(maxsplit=1)[0]} [-h]")


def test_the_help_shows_the_table_of_the_codes() -> None:
    help_text = subprocess.run(
        [ROOT / "wr", "--help"], capture_output=True, text=True, check=True
    ).stdout.partition("Exit codes:\n")[2]
    table = {
        value
        for name, value in vars(exit_codes).items()
        if name.isupper() and isinstance(value, int)
    }
    assert {int(code) for code in re.findall(r"^  (\d+)  \w", help_text, re.MULTILINE)} == table


def test_each_error_has_a_code_of_the_table() -> None:
    codes = {error: error.code for error in (FailureError, MissingError, UsageError)}
    assert codes == {FailureError: FAILED, MissingError: MISSING, UsageError: USAGE}


def test_the_simulators_have_the_same_codes() -> None:
    header = (ROOT / "sim/programs/Program.hpp").read_text()
    (values,) = re.findall(r"enum class Exit \{(.*?)\}", header)
    codes = {name.upper(): int(code) for name, code in re.findall(r"(\w+) = (\d+)", values)}
    assert codes == {name: getattr(exit_codes, name) for name in codes}
    footer = (ROOT / "sim/programs/Program.cpp").read_text().partition('"Exit codes: ')[2]
    shown = re.findall(r"\b(\d) ", footer.partition(");")[0])
    assert [int(code) for code in shown] == list(codes.values())
