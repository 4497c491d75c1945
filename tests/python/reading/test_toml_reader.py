"""The entries of the design. If an entry cannot be read, the reader reports its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from traceability.checks import run_checks
from traceability.model.build import build
from traceability.reading.toml_reader import Entries

SOUND = """\
total = 2

# The lamps.
[[lamp]]
name = "red"
pins = ["PTA1"]  # green is another one

[[lamp]]
name = "green"
pins = ["PTA2"]
why = "It shows that all is well."
"""


def problems(root: Path, text: str) -> list[tuple[int, str]]:
    path = root / "lamps.toml"
    path.write_text(text, encoding="utf-8")
    entries = Entries(root)
    entries.value(path, "total", 0)
    entries.tables(path, "lamp", {"name": str, "pins": list}, {"why": str}, own="name")
    entries.others()
    assert {problem.place.file for problem in entries.problems} <= {"lamps.toml"}
    return [(problem.place.line, problem.text) for problem in entries.problems]


def test_a_sound_file_has_no_problem(tmp_path: Path) -> None:
    assert problems(tmp_path, SOUND) == []


@pytest.mark.parametrize(
    ("old", "new", "line", "text"),
    [
        ('"green"', '"green', 9, "lamps.toml is not valid TOML: "),
        ('pins = ["PTA2"]\n', "", 8, "the key pins is missing, or its value is not a list"),
        (
            'pins = ["PTA2"]',
            'pins = "PTA2"',
            8,
            "the key pins is missing, or its value is not a list",
        ),
        ("why =", "because =", 11, "the key because is unknown: no tool reads it"),
        ('"green"', '"red"', 8, "line 4 already has an entry with the name red"),
        ("total =", "sum =", 1, "the name sum is unknown: no tool reads it"),
        (
            "[[lamp]]\nname = ",
            "[[lamps]]\nname = ",
            4,
            "the name lamps is unknown: no tool reads it",
        ),
        ("[[lamp]]\n", "[[ lamp ]]  # first\n", 0, ""),
    ],
)
def test_a_fault_is_told_at_its_line(
    old: str, new: str, line: int, text: str, tmp_path: Path
) -> None:
    assert old in SOUND
    found = problems(tmp_path, SOUND.replace(old, new, 1))
    if not line:
        assert found == []
        return
    assert [number for number, _ in found] == [line]
    assert found[0][1].startswith(text)


def test_a_file_that_is_no_toml_hides_the_other_checks(tmp_path: Path) -> None:
    root = write_tree(tmp_path)
    (root / "design" / "stack.toml").write_text("faults = [\n", encoding="utf-8")
    assert {finding.check for finding in run_checks(*build(root)).findings} == {"design-entry"}


def test_a_file_that_a_whole_design_lacks_is_found(tmp_path: Path) -> None:
    root = write_tree(tmp_path)
    (root / "design" / "modules.toml").write_text("total = 133\n", encoding="utf-8")
    found = {
        (one.place.file, one.text)
        for one in run_checks(*build(root)).findings
        if one.check == "design-entry"
    }
    assert ("design/concordance.toml", "there is no such file") in found


def test_a_text_of_blanks_says_nothing(tmp_path: Path) -> None:
    text = SOUND.replace("It shows that all is well.", " ")
    assert problems(tmp_path, text) == [(11, "why is empty")]
