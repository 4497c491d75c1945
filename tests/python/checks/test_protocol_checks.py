"""The checks find wrong numbers and wrong worked examples of the protocol. They also find forbidden
code: uses of the heap, and recursion."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.client.examples import BY_KIND, examples
from tests.python.model.small_tree import write_tree
from tests.python.project_files import write_files
from traceability.checks import run_checks
from traceability.checks.protocol_checks import not_in_body
from traceability.model.build import build

pytestmark = pytest.mark.reads("docs/protocol_examples.txt")

HEADER = "src/main_control/operation_states/Kind.hpp"
FILES = {
    HEADER: """\
#pragma once
namespace wr {
/// @brief Kind.
/// @datatype
enum class Kind { First, Second = 0x10, Third /* last */ };
}  // namespace wr
""",
    "design/frames.toml": """\
[[enumeration]]
name = "kind"
firmware = "Kind"
values = [
  { number = 0, name = "First" },
  { number = 15, name = "Second" },
  { number = 17, name = "Third" },
]

[[frame]]
name = "Hello"
type = 0x01

[[frame]]
name = "Welcome"
type = 0x91
""",
    "src/main_control/operation_states/FrameType.hpp": """\
#pragma once
namespace wr {
/// @brief Type of a frame.
/// @datatype
enum class FrameType { Hello = 0x01, Welcome = 0x81 };
}  // namespace wr
""",
    "docs/protocol_examples.txt": """\
# name; from; body without crc; crc; bytes on the line
right; pc; 020302; d7ed; 06020302edd700
wrong sum; pc; 020303; d7ed; 06020303edd700
wrong line; pc; 020302; d7ed; 06020303edd700
""",
    "src/main_control/operation_states/Loop.cpp": """\
namespace wr {
// A new line, and delete this.
int second(int left);
int first(int left) { return left > 0 ? second(left - 1) : 0; }
int second(int left) { return first(left); }
int apart(int left) { return left; }
int* made() { return new int(3); }
}  // namespace wr
""",
}


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[str, str, int, str]]:
    root: Path = write_tree(tmp_path_factory.mktemp("tree"))
    write_files(root, FILES)
    findings = run_checks(*build(root)).findings
    return [(one.check, Path(one.place.file).name, one.place.line, one.text) for one in findings]


@pytest.mark.parametrize(
    ("check", "places"),
    [
        ("doc-frame", [("frames.toml", 6), ("frames.toml", 15)]),
        ("doc-example", [("protocol_examples.txt", 3), ("protocol_examples.txt", 4)]),
        ("exec-heap", [("Loop.cpp", 7)]),
        ("stack-recursion", [("Loop.cpp", 4), ("Loop.cpp", 5)]),
    ],
)
def test_each_fault_is_found_at_its_line(
    found: list[tuple[str, str, int, str]], check: str, places: list[tuple[str, int]]
) -> None:
    assert [(file, line) for name, file, line, _ in found if name == check] == places


def test_the_message_states_both_numbers(found: list[tuple[str, str, int, str]]) -> None:
    texts = [text for check, _, _, text in found if check == "doc-frame"]
    assert texts == [
        "Second has the number 16 in Kind, not 15",
        "the frame Welcome has the type 0x81 in FrameType, not 0x91",
    ]


@pytest.mark.parametrize(
    ("right", "wrong", "stated"),
    [
        ("hello", "confirm", "confirm"),
        ("order 258", "order 259", "order 259"),
        ("12.50 degrees to the right", "12.50 degrees to the left", "steering 12.50"),
        ("150.0 rpm", "15.0 rpm", "at 15.0 rpm"),
        ("current -2.5 A", "current 2.5 A", "current 2.5 A"),
        ("firmware 1.0.0", "firmware 1.0.1", "firmware 1.0.1"),
        ("0x00004a6e", "0x00004a6f", "at 0x00004a6f"),
        ("trip of wheel 2", "trip of wheel 4", "wheel 4"),
    ],
)
def test_the_text_of_an_example_is_compared_with_its_body(
    right: str, wrong: str, stated: str
) -> None:
    text, _, body, *_ = next(example for example in examples() if right in example[0])
    assert list(not_in_body(bytes.fromhex(body), text, BY_KIND)) == []
    (found,) = not_in_body(bytes.fromhex(body), text.replace(right, wrong), BY_KIND)
    assert found.startswith(stated)
