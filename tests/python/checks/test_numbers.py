"""Figures of texts: found however they are laid out, and compared with the code."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from traceability.checks import numbers
from traceability.checks.numbers import _asked, _sizes
from traceability.model.build import build
from traceability.model.schema import Model, Place, Requirement

HEADER = """\
#pragma once
namespace wr {
inline constexpr int kMost = 128;
enum class Kind : unsigned char { First = 0x01, Last = 0x82 };
struct Limits {
  int most() const { return 3'200; }
  int period() const { return milliseconds(100); }
  static constexpr Angle kNear{25};
  static int milliseconds(int count) { return count * 1000; }
};
}  // namespace wr
"""


def found(root: Path, text: str, **figure: str) -> list[tuple[str, int, str]]:
    write_tree(root)
    folder = next((root / "src").rglob("*.hpp")).parent
    (folder / "Limits.hpp").write_text(HEADER)
    (root / "docs").mkdir(exist_ok=True)
    (root / "docs" / "page.rst").write_text(text)
    entry = {"text": '"docs/page.rst"'} | figure
    lines = "".join(f"{key} = {value}\n" for key, value in entry.items())
    (root / "design" / "figures.toml").write_text(f"[[figure]]\n{lines}")
    model = build(root)
    assert model.facts is not None
    findings = numbers.check(model, model.facts)
    return [(one.place.file, one.place.line, one.text) for one in findings]


@pytest.mark.parametrize(
    ("text", "of", "wrong"),
    [
        ("It has at\nmost 128 bytes.", "kMost", ""),
        ("It has at\nmost 127 bytes.", "kMost", "the text says 127, and kMost is 128"),
        ("It has at most 3200 bytes.", "Limits::most", ""),
        ("It has at most 0x82 bytes.", "Kind::Last", ""),
        ("It has at most 25 bytes.", "Limits::kNear", ""),
        (
            "It has at most 0x83 bytes.",
            "Kind::Last",
            "the text says 0x83, and Kind::Last is 0x82",
        ),
    ],
)
def test_a_figure_is_that_of_the_code(tmp_path: Path, text: str, of: str, wrong: str) -> None:
    line = text.count("\n") + 1
    result = found(tmp_path, text, says='"at most {} bytes"', of=f'"{of}"')
    assert result == ([("docs/page.rst", line, wrong)] if wrong else [])


def test_a_figure_can_have_another_unit(tmp_path: Path) -> None:
    text = "Every 100 ms."
    entry = {"says": '"Every {} ms"', "of": '"Limits::period"', "times": "0.001"}
    assert found(tmp_path, text, **entry) == []
    assert found(tmp_path, "Every 99 ms.", **entry) != []


def test_words_and_names_that_are_not_there_are_found(tmp_path: Path) -> None:
    assert found(tmp_path, "Nothing.", says='"at most {} bytes"', of='"kMost"') == [
        ("design/figures.toml", 1, "docs/page.rst does not say 'at most {} bytes'")
    ]
    assert found(tmp_path, "at most 1 bytes", says='"at most {} bytes"', of='"kLeast"') == [
        ("design/figures.toml", 4, "the code has no number kLeast")
    ]


ROW = """\
   * - {}
     - {}
     - name
"""


@pytest.mark.parametrize(
    ("rows", "wrong"),
    [
        ([("0", "u32"), ("4", "4 times u8, i16"), ("16", "8 characters"), ("24", "u8")], []),
        ([("0", "u16"), ("4", "u8")], [4]),
        ([("0", "u8"), ("1, 4", "u8, i16"), ("7", "u8")], []),
        ([("0", "u32"), ("name", "what"), ("0", "u8")], []),
    ],
)
def test_the_rows_of_a_table_follow_each_other(
    tmp_path: Path, rows: list[tuple[str, str]], wrong: list[int]
) -> None:
    text = "".join(ROW.format(*row) for row in rows)
    result = found(tmp_path, text + "at most 128 bytes", says='"at most {} bytes"', of='"kMost"')
    assert [line for _, line, _ in result] == wrong


def test_a_row_has_the_figures_of_its_requirements() -> None:
    says = "The motor stops within 20 ms, at most 1.5 m away."
    model = Model("", "", "", {})
    model.requirements["FR-1"] = Requirement("FR-1", says, "", Place("x", 1))
    row = (
        "   * - It stops\n     - after 20\n       ms, {} on\n"
        "     - :requirement:`FR-1`\n\nIn 3 s.\n"
    )
    assert list(_asked("a.rst", row.format("1.5 m"), model)) == []
    wrong = [(one.place.line, one.text) for one in _asked("a.rst", row.format("2 m"), model)]
    assert wrong == [(3, "the row says 2 m, and none of its requirements does")]
    assert list(_asked("a.rst", row.format("2 m").replace("FR-1", "FR-2"), model)) == []


@pytest.mark.parametrize(("size", "wrong"), [(6, []), (7, [4])])
def test_a_frame_has_the_size_of_its_table(size: int, wrong: list[int]) -> None:
    frames = f"   * - 0x04\n     - Order\n     - to the robot\n     - {size} bytes\n"
    table = "".join(ROW.format(*row) for row in [("0", "u16"), ("2, 4", "i16")])
    found = list(_sizes("a.rst", f"{frames}\nOrder\n-----\n\n{table}"))
    assert [one.place.line for one in found] == wrong
