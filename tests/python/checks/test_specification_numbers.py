"""Two checks of numbers with a unit. A number in the specification of a module must be the value of
a constant of the module, or a number in a requirement. A number in the README of a port must be the
value of a constant of the port."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from tests.python.project_files import write_files
from traceability.checks import number_checks
from traceability.model.build import build

BRIEF = "/// @brief "
LIMIT = "  static constexpr int kLimit = 300;  // [ms]\n"


def messages(root: Path, sentence: str, member: str = "") -> list[str]:
    """Adds a sentence to the brief of the class RC, and a member to this class. Returns the
    findings."""
    header = root / "src" / "main_control" / "operation_modes" / "RC.hpp"
    text = header.read_text().replace(BRIEF, f"{BRIEF}{sentence} ", 1)
    header.write_text(text.replace(" public:\n", f" public:\n{member}", 1))
    found = number_checks.check(*build(root))
    return [one.text for one in found if one.check == "module-number"]


@pytest.mark.parametrize(
    ("sentence", "member", "expected"),
    [
        ("Waits 300 ms.", LIMIT, []),
        ("Waits 0.3 s.", LIMIT, []),
        (
            "Waits 400 ms.",
            LIMIT,
            ["RC states 400 ms, but no constant of the module has this value"],
        ),
        ("Waits 300 ms.", "", ["RC states 300 ms, but no constant of the module has this value"]),
        (
            "Ends at the third successive sample.",
            "  static constexpr int kLimit = 4;\n",
            ["RC states third sample, but no constant of the module has this value"],
        ),
        ("Ends at the fourth sample.", "  static constexpr int kLimit = 4;\n", []),
        ("Assumption: a lead battery of 12 V.", "", []),
        ("Returns an angle in 0.01 degree.", "", []),
    ],
)
def test_a_number_is_the_value_of_a_constant(
    tmp_path: Path, sentence: str, member: str, expected: list[str]
) -> None:
    assert messages(write_tree(tmp_path), sentence, member) == expected


def test_a_number_of_a_port_is_the_value_of_a_constant(tmp_path: Path) -> None:
    readme = "A clock of 25 MHz,\nnot of 50 MHz, for 25 s at 1 kbit/s.\n"
    constants = "constexpr int kClock = 25'000'000;  // [Hz]\nconstexpr int kRate = 1000;\n"
    root = write_tree(tmp_path)
    write_files(root, {"ports/board/README.md": readme, "ports/board/registers.hpp": constants})
    found = [one for one in number_checks.check(*build(root)) if one.check == "doc-number"]
    assert [(one.place.line, one.text.split(",")[0]) for one in found] == [
        (2, "the text states 50 MHz"),
        (2, "the text states 25 s"),
        (2, "the text states 1 kbit/s"),
    ]
