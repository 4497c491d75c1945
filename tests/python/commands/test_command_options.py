"""The reader of the options finds exactly the commands and options of the parser of ./wr. It also
finds options of the simulators."""

from pathlib import Path

import pytest

from tools import cli
from traceability.reading.command_options import options_of_commands, options_of_programs

pytestmark = pytest.mark.runs_tools

ROOT = Path(__file__).parents[3]


def test_the_options_of_each_command_are_read() -> None:
    (commands,) = (one.choices for one in cli.parser()._actions if one.dest == "command")
    assert commands is not None
    parsed = {
        name: {word for action in parser._actions for word in action.option_strings}
        for name, parser in dict(commands).items()
    }
    assert options_of_commands(ROOT) == {
        name: {word for word in words if word.startswith("--")} for name, words in parsed.items()
    }


def test_the_options_of_the_simulators_are_read() -> None:
    options = options_of_programs(ROOT)
    assert {"--analog", "--image", "--gdb", "--help"} <= options["weeding_robot_board"]
    assert {"--image", "--elf", "--seed", "--only"} <= options["weeding_robot_faults"]
