"""Tables on hand-written pages. The content of these tables is read from files of the project."""

import csv
from pathlib import Path

import pytest

from portal.tables import (
    COMMAND_LINE,
    COMMANDS,
    CONNECTION,
    DEBIAN,
    ROOMS,
    VIRTUAL_BOARD,
    command_table,
    connection_table,
    key_table,
    measures_table,
    modelled_blocks,
    package_table,
    review_questions,
    room_table,
)
from traceability.model.metrics import OF_OTHER_STEPS

USAGE = """\
usage() {
    cat <<'TEXT'
usage: ./wr <command> [options]

  portal    build and serve
  test      run every test
  bring-up  check a new robot

./wr <command> --help explains the options.
TEXT
}
  other     no command
"""


def test_each_question_of_a_review_is_an_item(tmp_path: Path) -> None:
    items = review_questions(tmp_path).splitlines()
    assert len(items) == 6, "the answer to the question about reviews names six questions"
    assert all(item.startswith("* ") and item.endswith("?") for item in items)


def test_a_measure_of_the_tools_has_its_unit_or_is_missing() -> None:
    measured = {"tools.design_lines": 12345, "build.edit_s": 8.9}
    table = measures_table(dict.fromkeys(OF_OTHER_STEPS) | measured)
    rows = [row.split("\n     - ") for row in table.split("   * - ")[2:]]
    values = {metric.strip("`\n"): value for _, value, metric in rows}
    assert values["tools.design_lines"] == "12,345 lines"
    assert values["build.edit_s"] == "8.9 s"
    assert values["build.cold_s"] == "(not measured in this build)"


def test_each_command_of_the_help_is_a_row(tmp_path: Path) -> None:
    (tmp_path / COMMANDS).write_text(USAGE)
    (tmp_path / COMMAND_LINE).parent.mkdir()
    (tmp_path / COMMAND_LINE).write_text(
        'MODULES = {\n    "portal": "tools.make_portal",\n    "test": "tools.parts.run",\n}\n'
    )
    assert list(csv.reader(command_table(tmp_path).splitlines())) == [
        ["command", "effect", "source file"],
        ["``./wr portal``", "build and serve", "``tools/make_portal.py``"],
        ["``./wr test``", "run every test", "``tools/parts/run.py``"],
        ["``./wr bring-up``", "check a new robot", "``wr``"],
    ]


def test_each_package_is_a_row_and_no_comment_is(tmp_path: Path) -> None:
    (tmp_path / DEBIAN).parent.mkdir()
    text = "# Packages: a line each.\ng++   # compiles\nlib-1.2 # optional: a, b\n"
    (tmp_path / DEBIAN).write_text(text)
    assert list(csv.reader(package_table(tmp_path).splitlines())) == [
        ["package", "why"],
        ["g++", "compiles"],
        ["lib-1.2", "optional: a, b"],
    ]


def test_each_folder_of_the_simulator_has_its_content_and_its_links(tmp_path: Path) -> None:
    (tmp_path / ROOMS).parent.mkdir()
    (tmp_path / ROOMS).write_text(
        "function(add_room name kind)\nendfunction()\n\n"
        "# The physics of the\n# robot. It is exact.\nadd_room(plant STATIC)\n"
        "  # Programs.\n  add_room(programs OBJECT sim_plant CLI11::CLI11)\n"
    )
    rows = room_table(tmp_path).split("   * - ")[2:]
    assert [row.split() for row in rows] == [
        ["``plant``", "-", "The", "physics", "of", "the", "robot", "-", "nothing"],
        ["``programs``", "-", "Programs", "-", "``plant``,", "CLI11"],
    ]


def test_a_folder_of_the_simulator_needs_a_comment(tmp_path: Path) -> None:
    (tmp_path / ROOMS).parent.mkdir()
    (tmp_path / ROOMS).write_text("# Physics.\nadd_room(plant STATIC)\n\nadd_room(web STATIC)\n")
    with pytest.raises(ValueError, match="no comment"):
        room_table(tmp_path)


def test_the_modelled_blocks_are_those_of_the_virtual_board(tmp_path: Path) -> None:
    (tmp_path / VIRTUAL_BOARD).parent.mkdir(parents=True)
    code = 'osc_(*this, "OSC", 1),\nbyName_{{"SIM", &sim_},  {"FTM0", &ftms_[0]}},\n'
    (tmp_path / VIRTUAL_BOARD).write_text(code)
    assert modelled_blocks(tmp_path) == "FTM0, SIM.\n"


def test_each_key_is_a_row_with_linked_constants(tmp_path: Path) -> None:
    table = key_table(tmp_path)
    assert "* - ``left, j``\n     - turn the steering by :constant:`keyboard." in table
    assert "{" not in table


def test_the_reaction_to_each_frame_in_each_state_is_shown(tmp_path: Path) -> None:
    (tmp_path / CONNECTION).parent.mkdir(parents=True)
    (tmp_path / CONNECTION).write_text(
        """\
[states]
Open = "Open"
Ready = "Ready"

[events]
Hello = "hello"
Order = "order"
"1 s without Confirm" = "checkTime"

[[transition]]
from = "Open"
on = "Hello"
guard = ""
to = "Ready"
action = "Welcome"

[[transition]]
from = "Ready"
on = "Order"
guard = "fresh"
to = "Ready"
action = ""
"""
    )
    assert connection_table(tmp_path).splitlines()[4:] == [
        "   * - state",
        "     - Hello",
        "     - Order",
        "   * - Open",
        "     - Welcome, to Ready",
        "     - unexpected",
        "   * - Ready",
        "     - unexpected",
        "     - accepted, if fresh",
    ]
