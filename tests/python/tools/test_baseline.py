"""The comparison of the two designs: the measured instructions, the stack, the sizes, and the
patches for the likely changes."""

import sys
from pathlib import Path

import pytest

from tools import baseline
from tools.cmake_build import copy_sources
from tools.sizes import Size
from tools.steps import FailureError
from traceability.reading.baseline_record import DESIGNS, changes_of, patch_of

pytestmark = pytest.mark.reads(
    "src",
    "extensions",
    "sim",
    "tests",
    "design",
    "docs",
    "setup",
    "client/weeding_robot_client/layout.py",
    "CMakeLists.txt",
    "CMakePresets.json",
)

SIZES = {
    "usual": {"Crc16": Size(10, 1), "UsualDesign": Size(100, 4), "main": Size(5, 50)},
    "patterns": {"Crc16": Size(10, 1), "PC": Size(70, 0), "main": Size(6, 60), "stack": Size(0, 9)},
}


def test_a_run_gives_instructions_and_stack() -> None:
    measured = {"report_instructions": [10, 14], "instructions": [100, 120], "stack_bytes": 300}
    assert baseline.run_figures(measured) == {
        "report_avg": 12,
        "report_max": 14,
        "cycle_avg": 110,
        "cycle_max": 120,
        "stack": 300,
    }


def test_what_both_have_is_not_the_own_of_one() -> None:
    assert baseline.own_parts(SIZES, "usual") == {"UsualDesign", "main"}
    own = baseline.own_parts(SIZES, "patterns") - {"stack"}
    assert baseline.size_figures(SIZES["patterns"], own) == {
        "flash": 86,
        "ram": 61,
        "own_flash": 76,
    }


def test_the_copy_is_renewed_and_patched(tmp_path: Path) -> None:
    root, tree = tmp_path / "project", tmp_path / "project/build/tree"
    (root / "src").mkdir(parents=True)
    (root / "src/a.cpp").write_text("one\n")
    copy_sources(root, tree)
    unchanged = (tree / "src/a.cpp").stat().st_mtime_ns
    patch = root / "a.patch"
    patch.write_text(
        "--- a/src/a.cpp\n+++ b/src/a.cpp\n@@ -1 +1,2 @@\n one\n+two\n"
        "--- /dev/null\n+++ b/src/b.cpp\n@@ -0,0 +1 @@\n+new\n"
    )
    copy_sources(root, tree)
    assert (tree / "src/a.cpp").stat().st_mtime_ns == unchanged
    baseline.apply(sys.stdout, tree, patch)
    assert (tree / "src/a.cpp").read_text() == "one\ntwo\n"
    assert (tree / "src/b.cpp").read_text() == "new\n"
    with pytest.raises(FailureError, match="does not apply"):
        baseline.apply(sys.stdout, tree, patch)
    copy_sources(root, tree)
    assert (tree / "src/a.cpp").read_text() == "one\n"
    assert not (tree / "src/b.cpp").exists()


def test_the_patches_of_each_change_apply_to_the_present_sources(tmp_path: Path) -> None:
    root = Path(__file__).parents[3]
    tree = tmp_path / "tree"
    for change in changes_of(root):
        copy_sources(root, tree)
        for design in DESIGNS:
            baseline.apply(sys.stdout, tree, root / patch_of(change, design))
