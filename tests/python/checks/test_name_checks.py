"""What a text names: a name of the code or of the paper, or a finding at its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from traceability.checks import name_checks
from traceability.model.build import build


def found(root: Path) -> list[tuple[str, str, int, str]]:
    return [
        (one.check, one.place.file, one.place.line, one.text)
        for one in name_checks.check(*build(root))
    ]


def test_the_names_of_a_small_tree_exist(tmp_path: Path) -> None:
    write_tree(tmp_path)
    assert found(tmp_path) == []


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("// It holds until changeNothing() is called.", "changeNothing"),
        ("/// @brief See HallCounter.", "HallCounter"),
        ("// Mode::switchOver comes next.", "Mode::switchOver"),
        ("// The bound is kLongest.", "kLongest"),
        ("// In kHz, by the NVIC of a K64. NOLINT(HallCounter)", ""),
        ("// Mode is read once.", ""),
    ],
)
def test_a_name_in_a_comment_exists(tmp_path: Path, text: str, name: str) -> None:
    write_tree(tmp_path)
    path = next((tmp_path / "src").rglob("*.hpp"))
    path.write_text(path.read_text() + text + "\n")
    wanted = f"the text names {name}, which the code does not have"
    line = len(path.read_text().splitlines())
    place = str(path.relative_to(tmp_path))
    assert found(tmp_path) == ([("doc-name", place, line, wanted)] if name else [])


@pytest.mark.parametrize(
    ("file", "text", "check"),
    [
        ("docs/page.rst", "See ``HallCounter``.", "doc-name"),
        ("docs/page.rst", "See ``main``, ``Class::method``.", ""),
        ("design/concordance.toml", 'note = "In `Counter`."', "paper-stale"),
        ("design/changes.toml", 'steps = ["Write a `Counter`."]', "pattern-change"),
        ("design/other.toml", "# In `Counter`.", ""),
    ],
)
def test_a_name_in_a_page_or_in_the_design_exists(
    tmp_path: Path, file: str, text: str, check: str
) -> None:
    write_tree(tmp_path)
    built = build(tmp_path)
    (tmp_path / file).parent.mkdir(exist_ok=True)
    (tmp_path / file).write_text(text + "\n")
    assert [one.check for one in name_checks.check(*built)] == ([check] if check else [])
