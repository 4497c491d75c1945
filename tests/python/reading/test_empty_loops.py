"""A test can contain a loop whose body never runs. The reader finds such loops."""

import pytest

from traceability.reading.gtest_cases import empty_loops


@pytest.mark.parametrize(
    ("loop", "found"),
    [
        ("int i = 0; i < 3; ++i", False),
        ("int i = 0; i < 0; ++i", True),
        ("int i = 1; i <= kNone; ++i", True),
        ("int i = 0; i <= kNone; ++i", False),
        ("unsigned i = 3U; i > 3U; --i", True),
        ("int i = count(); i > 0; --i", False),
        ("int i = count(); i < 0; --i", True),
        ("int i = 9; i > count(); i += 2", True),
        ("int i = 0; i < kLater; ++i", False),
    ],
)
def test_a_loop_that_never_runs_is_found(loop: str, *, found: bool) -> None:
    text = f"constexpr int kNone = 0;\n  for ({loop}) {{\n  }}\nconstexpr int kLater = 0;\n"
    assert list(empty_loops(text)) == ([(2, f"for ({loop})")] if found else [])
