"""The extent of a patch, and the comparison of the two designs."""

from pathlib import Path

import pytest

from traceability.reading import baseline_record
from traceability.reading.baseline_record import PATTERNS, USUAL

pytestmark = pytest.mark.reads("tests/usual_design", "extensions/warning", "src", "design")

ROOT = Path(__file__).parents[3]
PATCH = """\
diff --git a/src/Old.cpp b/src/Old.cpp
--- a/src/Old.cpp
+++ b/src/Old.cpp
@@ -1,3 +1,4 @@
 kept
-was
+is
+// why
+
diff --git a/src/New.hpp b/src/New.hpp
new file mode 100644
--- /dev/null
+++ b/src/New.hpp
@@ -0,0 +1,2 @@
+/// Its purpose.
+class New;
"""


def test_a_patch_is_counted_from_its_text() -> None:
    touched = baseline_record.count_patch(PATCH)
    assert touched.files_changed == ["src/Old.cpp"]
    assert touched.files_added == ["src/New.hpp"]
    assert touched.lines_touched == 1
    assert touched.lines_added == 5
    assert touched.code_added == 2


def test_every_change_has_a_title_two_patches_and_a_test() -> None:
    assert baseline_record.changes_of(ROOT) == sorted(baseline_record.TITLES)
    for change in baseline_record.TITLES:
        assert list((ROOT / baseline_record.CHANGES / change).glob("*Test.cpp"))
        for design in baseline_record.DESIGNS:
            text = (ROOT / baseline_record.patch_of(change, design)).read_text()
            assert baseline_record.count_patch(text).lines_added


@pytest.mark.parametrize(("folder", "change"), [("warning", "waiting_k")])
def test_what_a_patch_adds_to_the_patterns_is_what_the_extension_is(
    folder: str, change: str
) -> None:
    """The test leaves out the change for Bluetooth. The patch of this change adds only the reading
    mode, but the extension also authenticates frames."""
    text = (ROOT / baseline_record.patch_of(change, PATTERNS)).read_text()
    added = [
        name
        for name in baseline_record.count_patch(text).files_added
        if Path(name).parent.name == folder
    ]
    assert added
    for name in added:
        part = text.partition(f"+++ b/{name}\n")[2].partition("\ndiff --git ")[0]
        lines = [line[1:] for line in part.splitlines() if line.startswith("+")]
        extension = ROOT / "extensions" / folder / Path(name).name
        assert code(lines) == code(extension.read_text().splitlines())


def code(lines: list[str]) -> list[str]:
    return [line for line in lines if line.strip() and not line.strip().startswith("//")]


def test_a_target_is_met_or_missed() -> None:
    figures = {USUAL: {"flash": 100.0, "lines": 0.0}, PATTERNS: {"flash": 110.0, "lines": 3.0}}
    assert baseline_record.more(figures, "flash") == pytest.approx(10)
    assert baseline_record.more(figures, "lines") is None
    assert baseline_record.verdict({**figures, PATTERNS: {"flash": 109.9}}, "flash") is True
    assert baseline_record.verdict({**figures, PATTERNS: {"flash": 111.0}}, "flash") is False
    assert baseline_record.verdict(figures, "lines") is None


def test_each_line_of_both_designs_belongs_to_one_part() -> None:
    parts = baseline_record.read_parts(ROOT)
    part_of = baseline_record.PartOfLine(ROOT, parts)
    modules = [module for part in parts for module in part.modules]
    assert len(modules) == len(set(modules))
    assert all((ROOT / "src" / module).is_dir() for module in modules)
    files = [path.relative_to(ROOT) for path in (ROOT / "src").rglob("*.cpp")]
    without = {str(file) for file in files if part_of(str(file), 1) is None}
    # The designs with one wheel have no steering.
    steering = ("src/steering_control/", "src/sensing/position/")
    assert without == {str(file) for file in files if str(file).startswith(steering)}
    lines = (ROOT / baseline_record.SOURCE).read_text().splitlines()
    sections = {found["title"] for line in lines if (found := baseline_record.SECTION.match(line))}
    assert sections < {name for part in parts for name in part.usual}


def test_a_method_of_the_baseline_design_can_belong_to_the_part_of_another_section() -> None:
    part_of = baseline_record.PartOfLine(ROOT, baseline_record.read_parts(ROOT))
    lines = (ROOT / baseline_record.SOURCE).read_text().splitlines()
    start = next(n for n, line in enumerate(lines, 1) if "UsualDesign::sendReport(" in line)
    before = next(n for n, line in enumerate(lines, 1) if "UsualDesign::release(" in line)
    source = str(baseline_record.SOURCE)
    assert part_of(source, start) == part_of("src/communication/framing/Crc16.cpp", 1)
    assert part_of(source, before) == part_of("src/main_control/MainController.cpp", 1)
    assert part_of("include/c++/optional", 1) is None
