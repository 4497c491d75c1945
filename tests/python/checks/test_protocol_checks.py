"""The checks find wrong worked examples of the protocol, and forbidden code."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.client.examples import BY_KIND, examples
from tests.python.model.small_tree import write_tree
from traceability.checks import run_checks
from traceability.checks.protocol_checks import not_in_body
from traceability.model.build import build

FILES = {
    "design/frames.toml": """\
[[frame]]
name = "KeepAlive"
type = 0x03
sender = "PC"
use = "keeps the connection"
fields = []
""",
    "docs/protocol_examples.txt": """\
# name; from; body without crc; crc; bytes on the line
keep alive; pc; 020302; d7ed; 06020302edd700
keep alive 7; pc; 020302; d7ed; 06020302edd700
hello; pc; 020302; d7ed; 06020302edd700
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
    for name, text in FILES.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    findings = run_checks(*build(root)).findings
    return [(one.check, Path(one.place.file).name, one.place.line, one.text) for one in findings]


@pytest.mark.parametrize(
    ("check", "places"),
    [
        ("doc-example", [("protocol_examples.txt", 3), ("protocol_examples.txt", 4)]),
        ("exec-heap", [("Loop.cpp", 7)]),
        ("stack-recursion", [("Loop.cpp", 4), ("Loop.cpp", 5)]),
    ],
)
def test_each_fault_is_found_at_its_line(
    found: list[tuple[str, str, int, str]], check: str, places: list[tuple[str, int]]
) -> None:
    assert [(file, line) for name, file, line, _ in found if name == check] == places


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
