"""The check finds a part that is initialised with another part of the same kind. In an example, a
left part is initialised with a right part."""

from pathlib import Path

from tests.python.model.small_tree import write_tree
from traceability.checks import swap_checks
from traceability.model.build import build

CODE = """\
// A comment: leftEnd(rightEnd)
Port leftEnd(pinOf("steering_right_end"), Level::High);
Port rightEnd(pinOf("steering_right_end"));
Device device({.step = devices.step,
               .direction = devices.enable,
               .enable = devices.enable,
               .hallA = Port(pinOf("hall_b"))});
Builder::Builder() : outerWheel_(innerWheel_), innerWheel_{rear.innerWheel} {}
int total = step(direction) + left(right) + other.leftEnd(rightEnd);
"""


def test_a_part_that_is_initialised_with_another_part_is_found(tmp_path: Path) -> None:
    root = write_tree(tmp_path)
    (root / "src" / "main_control" / "MainController.cpp").write_text(CODE)
    found = [(one.place.line, one.text) for one in swap_checks.check(*build(root))]
    assert found == [
        (2, 'leftEnd is initialised with pinOf("steering_right_end")'),
        (5, "direction is initialised with devices.enable"),
        (7, 'hallA is initialised with Port(pinOf("hall_b"))'),
        (8, "outerWheel_ is initialised with innerWheel_"),
    ]
