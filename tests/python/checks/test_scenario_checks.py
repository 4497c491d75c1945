"""The words of the page about scenarios agree with the words that the scenario reader accepts. The
numbers in the comments of a scenario agree with the numbers in its lines."""

from pathlib import Path

import pytest

from tests.python.project_files import write_files
from traceability.checks.scenario_checks import missing_numbers, wrong_words

READER = """if (word == "mark" || words.takeIf("replay")) {
    {"side_slip0", sideSlip<0>},
    {"grip", 1},
    words.skip("at");
"""
PAGE = """``mark``, ``at T wait 01 ff``, ``--reports FILE`` and ``side_slip0`` to ``3``

   at 50 grip 7
   at 60 skid yes
"""
SCENARIO = """# At {}.
at 50 plant supply 21000
at 100 fault block 1
at 150 order velocity 200
at 600 expect ground_speed between -90 -70
at 700 expect velocity0 between 190 210
at 800 expect inhibit None within 300 mm
"""


def test_words_of_the_page_and_of_the_reader_are_compared(tmp_path: Path) -> None:
    files = {
        "sim/scenario/Scenario.cpp": READER,
        "docs/scenarios.rst": PAGE,
        "design/frames.toml": 'values = [{ name = "yes" }]\n',
    }
    write_files(tmp_path, files)
    found = [(one.place.file, one.place.line, one.text) for one in wrong_words(tmp_path)]
    reason = "but a scenario cannot contain this word"
    assert found == [
        ("docs/scenarios.rst", 1, f"this page names 'wait', {reason}"),
        ("docs/scenarios.rst", 4, f"this page names 'skid', {reason}"),
        ("sim/scenario/Scenario.cpp", 1, "docs/scenarios.rst does not name replay"),
    ]


@pytest.mark.parametrize(
    ("comment", "missing"),
    [
        ("20 rpm and 21 V the robot is slower than 0.08 m/s", []),
        ("2 rpm and 21.5 V", ["2 rpm", "21.5 V"]),
        ("15 rpm, about 30 rpm", ["15 rpm"]),
        ("0.3 m the robot stops, after 0.1 s and 500 ms", []),
        ("0.4 m, after 3 seconds", ["0.4 m", "3 seconds"]),
        ("20 rpm the error is below 5 percent, not 7 percent", ["7 percent"]),
        ("9 V (FR-1) and 8 V", ["8 V"]),
    ],
)
def test_a_number_of_a_comment_that_no_line_has_is_found(comment: str, missing: list[str]) -> None:
    requirements = {"FR-1": "The robot shall stop at 9 V."}
    found = missing_numbers(SCENARIO.format(comment), requirements)
    assert list(found) == [(1, number) for number in missing]
