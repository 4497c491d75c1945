"""The check demands a description of each parameter of a constructor. A constructor needs no brief,
but an existing brief must have more than one word."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from traceability.checks import module_checks
from traceability.model.build import build

CONSTRUCTOR = "  explicit RC(Mode& other)"
NESTED = """\
  /// @brief Two numbers.
  struct Pair {
    Pair();
    explicit Pair(int first);
  };

"""


def messages(root: Path, *, find: str, put: str) -> list[str]:
    """Replaces a part of the header of RC. Returns the findings about the constructors."""
    header = root / "src" / "main_control" / "operation_modes" / "RC.hpp"
    text = header.read_text()
    assert find in text
    header.write_text(text.replace(find, put))
    found = module_checks.check(*build(root))
    return [
        one.text
        for one in found
        if one.check == "module-spec" and one.text.startswith(("RC::RC", "RC::Pair::Pair"))
    ]


@pytest.mark.parametrize(
    ("find", "put", "expected"),
    [
        (CONSTRUCTOR, CONSTRUCTOR, []),
        (CONSTRUCTOR, f"  /// @brief Begins.\n{CONSTRUCTOR}", ["RC::RC has no @brief"]),
        ("  /// @param other the other mode", "  /// @param", ["RC::RC has no @param other"]),
        (
            "  [[nodiscard]]",
            f"{NESTED}  [[nodiscard]]",
            ["RC::Pair::Pair is public, but has no @param"],
        ),
    ],
    ids=["without a brief", "a brief of one word", "without a description", "nested class"],
)
def test_a_constructor_describes_its_parameters(
    tmp_path: Path, find: str, put: str, expected: list[str]
) -> None:
    assert messages(write_tree(tmp_path), find=find, put=put) == expected
