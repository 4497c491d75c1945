"""The tables on hand-written pages whose content is read from files of the project."""

import csv
from pathlib import Path

from portal.tables import (
    COMMANDS,
    DEBIAN,
    command_table,
    package_table,
)

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


def test_each_command_of_the_help_is_a_row(tmp_path: Path) -> None:
    (tmp_path / COMMANDS).write_text(USAGE)
    assert list(csv.reader(command_table(tmp_path).splitlines())) == [
        ["command", "effect"],
        ["``./wr portal``", "build and serve"],
        ["``./wr test``", "run every test"],
        ["``./wr bring-up``", "check a new robot"],
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
