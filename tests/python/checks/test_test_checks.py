"""The code of a test must contain each number that the brief of this test states. The check
test-number finds the missing numbers."""

from pathlib import Path

from tests.python.model.small_tree import write_tree
from traceability.checks import test_checks
from traceability.model.build import build

TEST = """\
#include "Helper.hpp"

constexpr int kLimit = 12'000;

/// @brief After 12 V and 200 ms, the error is below 0.5 %. The helper adds 3 s.
/// @verifies FR-1
TEST(Small, FR1_StatesItsNumbers) {
  apply(kLimit, 200);
  EXPECT_NEAR(output(), 1, 0.005);
}

/// @brief The error is below 0.2 % after five cycles, 0.5 us, 0.6 us and 7 A.
/// @verifies FR-1
TEST(Small, FR1_StatesOtherNumbers) {
  wait(nanoseconds(500));
  EXPECT_NEAR(output(), 1, 0.005);
}
"""


def test_a_number_of_a_brief_is_in_the_test_in_its_file_or_in_its_helpers(tmp_path: Path) -> None:
    write_tree(tmp_path)
    (tmp_path / "tests" / "SmallTest.cpp").write_text(TEST, encoding="utf-8")
    (tmp_path / "tests" / "Helper.hpp").write_text("const int kWait = 3000;\n", encoding="utf-8")
    built = build(tmp_path)
    texts = [finding.text for finding in test_checks.check(built.model, built.facts)]
    assert texts == [
        f"the brief of Small.FR1_StatesOtherNumbers states {number}, "
        "but the test does not contain it"
        for number in ("0.2 %", "0.6 us", "7 A")
    ]
