"""Damaged files of the design never crash a tool. The reader returns the content or problems. Each
problem contains a file and a line."""

from __future__ import annotations

import shutil
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.python.random_edits import edited, randomised
from traceability.reading.comments import read_comments
from traceability.reading.declared import Declared, read_declared
from traceability.schema import TreeNode

pytestmark = pytest.mark.reads("design", "requirements", "src")

ROOT = Path(__file__).parents[3]
DESIGN = sorted((ROOT / "design").rglob("*.toml"))
TREES = sorted((ROOT / "design" / "trees").glob("*.tree"))
HEADERS = sorted((ROOT / "src").rglob("*.hpp")) + sorted((ROOT / "requirements").glob("*.dox"))


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("copy")
    shutil.copytree(ROOT / "design", root / "design")
    shutil.copytree(ROOT / "requirements", root / "requirements")
    return root


def read_with(copy: Path, path: Path, text: str) -> Declared:
    """Reads the design with a different text in one file."""
    changed = copy / path.relative_to(ROOT)
    changed.write_text(text, encoding="utf-8")
    try:
        return read_declared(copy)
    finally:
        shutil.copy(path, changed)


def is_toml(text: str) -> bool:
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return False
    return True


@given(data=st.data())
@randomised(12)
def test_a_damaged_toml_file_gives_problems_at_lines_that_it_has(
    copy: Path, data: st.DataObject
) -> None:
    path = data.draw(st.sampled_from(DESIGN))
    text = data.draw(edited(path.read_text(encoding="utf-8")))
    problems = read_with(copy, path, text).entries.problems
    name = str(path.relative_to(ROOT))
    if not is_toml(text):
        assert name in {problem.place.file for problem in problems}
    lines = len(text.splitlines())
    assert all(
        1 <= problem.place.line <= max(lines, 1)
        for problem in problems
        if problem.place.file == name
    )


def size_of(node: TreeNode | None) -> int:
    return 0 if node is None else 1 + sum(size_of(child) for child in node.children)


@given(data=st.data())
@randomised(10)
def test_each_line_of_a_damaged_tree_is_a_node_or_an_error(copy: Path, data: st.DataObject) -> None:
    path = data.draw(st.sampled_from(TREES))
    text = data.draw(edited(path.read_text(encoding="utf-8")))
    declared = read_with(copy, path, text)
    name = str(path.relative_to(ROOT))
    lines = [
        number for number, line in enumerate(text.splitlines(), 1) if line.split("#")[0].strip()
    ]
    heads = {place.line for place, _ in declared.trees.values() if place.file == name}
    wrong = {place.line for place, _, _ in declared.tree_errors if place.file == name}
    nodes = sum(size_of(tree) for place, tree in declared.trees.values() if place.file == name)
    assert heads | wrong <= set(lines)
    assert nodes + len(heads | wrong) >= len(lines) - below_doubled(text, name, declared)


def below_doubled(text: str, name: str, declared: Declared) -> int:
    """Returns the greatest number of lines of ``text`` that may be missing in the trees. If a
    requirement has two trees, the reader keeps only one of them. Any number of lines may then be
    missing. Otherwise, no line may be missing."""
    doubled = any(
        "already" in said for place, said, _ in declared.tree_errors if place.file == name
    )
    return len(text.splitlines()) if doubled else 0


@given(data=st.data())
@randomised(10)
def test_comments_of_a_damaged_file_have_lines_that_it_has(data: st.DataObject) -> None:
    path = data.draw(st.sampled_from(HEADERS))
    text = data.draw(edited(path.read_text(encoding="utf-8")))
    lines = text.count("\n") + 1
    for comment in read_comments("damaged.hpp", text):
        assert all(1 <= tag.place.line <= lines for tag in comment.tags)
