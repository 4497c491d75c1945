"""The folders of likely changes: their changed lines, classes and tests, and the conditions of a
proven change."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.python.project_files import write_files
from traceability.model.made_changes import proven, unproven
from traceability.reading.change_kits import Kit, TouchedLines, images_of, read_kits, touched_lines
from traceability.reading.toml_reader import Entries
from traceability.schema import HOST, VIRTUAL_K64, KitTest, MadeChange, Place

PLACE = Place("changes/one/change.toml", 1)
PATCH = """\
--- a/src/construction/Builder.hpp
+++ b/src/construction/Builder.hpp
@@ -1,2 +1,3 @@
-  Old part;
+  New part;
+  Other other;
--- a/src/sensing/Sensor.cpp
+++ b/src/sensing/Sensor.cpp
@@ -7,2 +7,2 @@
-  measure(1);
-  measure(2);
+  measure(3);
"""
TESTS = "TEST(New, Works) {}\nTEST_F(NewOnBoard, WorksThere) {}\n"


def made_kit(root: Path, text: str = 'event = "It changes."\nclasses = ["New"]\n') -> Kit | None:
    files = {
        "changes/one/change.toml": text,
        "changes/one/New.hpp": "class New final : public Base {\n};\n",
        "changes/one/NewTest.cpp": TESTS,
        "changes/one/composition.patch": PATCH,
    }
    write_files(root, files)
    return read_kits(root, Entries(root)).get("one")


def test_lines_of_the_composition_and_others_are_counted_apart(tmp_path: Path) -> None:
    kit = made_kit(tmp_path)
    assert kit is not None
    files = ["src/construction/Builder.hpp", "src/sensing/Sensor.cpp"]
    assert kit.touched == TouchedLines(outside=2, composition=1, added=3, files=files)


def test_files_classes_and_tests_are_those_of_the_folder(tmp_path: Path) -> None:
    kit = made_kit(tmp_path)
    assert kit is not None
    assert kit.files == ["changes/one/New.hpp"]
    assert kit.bases == {"New": "Base"}
    assert kit.tests == {
        "New.Works": Place("changes/one/NewTest.cpp", 1),
        "NewOnBoard.WorksThere": Place("changes/one/NewTest.cpp", 2),
    }
    assert images_of([kit]) == ["change_one", "weeding_robot_paper"]


def test_a_kit_without_its_event_is_no_kit(tmp_path: Path) -> None:
    assert made_kit(tmp_path, 'classes = ["New"]\n') is None


@pytest.mark.parametrize(
    ("host", "board", "expected"),
    [
        ("passed", "passed", True),
        ("passed", None, False),
        ("failed", "passed", False),
        (None, None, False),
    ],
)
def test_a_change_is_proven_by_tests_that_passed_on_both_targets(
    host: str | None, board: str | None, expected: bool
) -> None:
    tests = [KitTest("A.B", HOST, host, PLACE), KitTest("AOnBoard.B", VIRTUAL_K64, board, PLACE)]
    assert proven(a_change(tests)) is expected


def test_a_change_that_is_not_proven_has_a_reason() -> None:
    passed = KitTest("A.B", HOST, "passed", PLACE)
    assert unproven(a_change([passed])) == f"the change has no test on this target: {VIRTUAL_K64}"
    failed = KitTest("AOnBoard.B", VIRTUAL_K64, "failed", PLACE)
    assert unproven(a_change([passed, failed])) == "AOnBoard.B did not pass"
    not_run = KitTest("AOnBoard.B", VIRTUAL_K64, None, PLACE)
    assert "run ./wr test" in unproven(a_change([passed, not_run]))


def test_new_lines_are_those_that_replace_no_line() -> None:
    change = replace(a_change([]), composition_lines=2, outside_lines=1, added_lines=7)
    assert change.new_lines == 4


def test_lines_of_both_designs_are_counted_apart() -> None:
    def numbers(patch: str) -> tuple[int, int]:
        touched = touched_lines(patch)
        return touched.outside, touched.composition

    assert numbers(PATCH) == (2, 1)
    composed = PATCH.replace("src/sensing/Sensor", "tests/usual_design/patterns/PatternDesign")
    assert numbers(composed) == (0, 3)
    baseline = composed.replace("/patterns/PatternDesign", "/usual/UsualDesign")
    assert numbers(baseline) == (2, 1)


def test_tests_on_one_target_prove_nothing() -> None:
    assert not proven(a_change([KitTest("A.B", HOST, "passed", PLACE)]))
    assert not proven(a_change([]))
    assert not proven(None)


def a_change(tests: list[KitTest]) -> MadeChange:
    return MadeChange(
        application="one",
        event="It changes.",
        hard="",
        why="",
        classes=[],
        extension="",
        files=[],
        patched=[],
        composition_lines=0,
        outside_lines=0,
        added_lines=0,
        flash=None,
        ram=None,
        instructions=None,
        tests=tests,
        place=PLACE,
    )
