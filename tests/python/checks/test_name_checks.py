"""The checks find wrong names. On a page, they find a test that does not exist and a wrong base
class. In a comment of a module, they find a function that exists neither in this module nor in the
modules that it uses."""

from pathlib import Path

from tests.python.model.small_tree import write_tree
from tests.python.project_files import write_files
from traceability.checks import name_checks
from traceability.model.build import build

PAGE = """\
Working.WaitsWithoutMessage and Working.WaitsWithMessage, ``--gtest_filter='*Waits*'`` or
``--gtest_filter='*FR16*'``. Wish.of(Working.STATE), NoTest.Waits, Other.FR15_Waits.
+ Working.NewTest
:module:`Working` derives
from :module:`Waiting`. ``PC`` derives from :module:`Mode`, RC derives from RC::Mode.
"""


def test_a_test_or_a_base_class_that_does_not_exist_is_found(tmp_path: Path) -> None:
    root = write_files(write_tree(tmp_path), {"docs/page.rst": PAGE})
    found = [(one.place.line, one.text) for one in name_checks.check(*build(root))]
    missing = "the text names the test {}, which does not exist"
    assert [each for each in found if "test" in each[1]] == [
        (1, missing.format("Working.WaitsWithMessage")),
        (2, missing.format("NoTest.Waits")),
        (2, missing.format("Other.FR15_Waits")),
        (2, missing.format("*FR16*")),
    ]
    derives = "the text states that Working derives from Waiting, but Working does not"
    assert (4, derives) in found
    assert sum("derives" in text for _, text in found) == 1


def test_a_function_that_a_comment_names_is_one_of_the_module_or_of_its_uses(
    tmp_path: Path,
) -> None:
    root = write_tree(tmp_path)
    header = root / "src" / "main_control" / "operation_modes" / "RC.hpp"
    comment = "// newMessage(), changeMode(), actionNoMsg(), nothing() and MainController::read()\n"
    header.write_text(comment + header.read_text())
    found = [
        (one.place.line, one.text.partition(",")[0])
        for one in name_checks.check(*build(root))
        if one.place.file.endswith("RC.hpp")
    ]
    assert found == [(1, "the text names actionNoMsg()"), (1, "the text names nothing()")]
