"""The checks find two kinds of wrong numbers in a text. First, the text states how many items the
next list has, but the list has more or fewer items. Second, the text states how many parts of a
kind exist, such as hazards, but the design has more or fewer parts of this kind."""

from pathlib import Path

import pytest

from tests.python.project_files import write_files
from traceability.checks.list_checks import wrong_counts, wrong_totals

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
    write_files(tmp_path, {"docs/page.rst": f"Text.\n\n{sentence}\n\n{LIST}"})
    assert [finding.text for finding in wrong_counts(tmp_path)] == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("There are two hazards. The 2 assumptions of use.", []),
        ("There are three hazards.", ["the text states 'There are three hazards', but"]),
        ("They meet 3\nassumptions of use.", ["the text states '3 assumptions of use', but there"]),
        ("Three hazards are new, and the three hazards above, or the two hazards that remain.", []),
        ("Six design patterns, and five modules.", ["the text states 'Six design patterns', but"]),
        ("The seven goals.", []),
    ],
)
def test_a_wrong_number_of_parts_is_found(tmp_path: Path, text: str, found: list[str]) -> None:
    files = {
        "design/safety_case.toml": "[[hazard]]\n[[hazard]]\n[[assumption]]\n[[assumption]]\n",
        "design/applications.toml": 'pattern = "State"\npattern = "State"\npattern = "Pool"\n',
        "docs/page.rst": text,
    }
    write_files(tmp_path, files)
    findings = [finding.text for finding in wrong_totals(tmp_path)]
    assert len(findings) == len(found)
    assert all(one.startswith(part) for one, part in zip(findings, found, strict=True))
