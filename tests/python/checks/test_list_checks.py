"""The number of the items before a list is the number of its items."""

from pathlib import Path

import pytest

from traceability.checks.list_checks import wrong_counts

LIST = "* first\n  and more\n\n  * inner\n* second\n\nNo item.\n* other\n"


@pytest.mark.parametrize(
    ("sentence", "found"),
    [
        ("It has two parts:", []),
        (
            "Of five cases. It has\nThree parts:",
            ["the text states three items, but the list has 2"],
        ),
        ("Two of three parts:", []),
        ("It has parts:", []),
        ("It has three parts.", []),
    ],
)
def test_a_wrong_number_of_items_is_found(tmp_path: Path, sentence: str, found: list[str]) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "page.rst").write_text(f"Text.\n\n{sentence}\n\n{LIST}")
    assert [finding.text for finding in wrong_counts(tmp_path)] == found
