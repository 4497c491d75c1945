"""The concordance: what is missing, stale or named otherwise is found at its line."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from traceability.checks import paper_checks
from traceability.model.build import Built, build
from traceability.reading.concordance import read_concordance
from traceability.reading.toml_reader import Entries

PAPER = """\
source = "A paper"

[[place]]
id = "Figure 1"
kind = "figure"
title = "A figure"
[place.names]
module = ["Mode", "CR"]
method = ["Mode::changeMode"]

[[place]]
id = "Table I"
kind = "table"
title = "A table"
[place.names]
module = ["Mode"]
"""
CONCORDANCE = """\
[same]
module = [
    "Mode",
]
method = [
    "Mode::changeMode",
]

[[entry]]
kind = "module"
name = "CR"
here = ["module:RC"]
alias = "Two spellings."

[[entry]]
kind = "figure"
name = "Figure 1"
here = ["view:index", "pattern:reading-modes", "requirement:FR-15"]

[[entry]]
kind = "table"
name = "Table I"
here = []
deviation = "Nothing like it."
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    return build(write_tree(tmp_path_factory.mktemp("small")))


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """The two files; the code stays as it was built."""
    (tmp_path / "design").mkdir()
    (tmp_path / "design" / "paper.toml").write_text(PAPER)
    (tmp_path / "design" / "concordance.toml").write_text(CONCORDANCE)
    return tmp_path


def read(built: Built, root: Path) -> Built:
    concordance = read_concordance(root, Entries(root))
    built.facts.declared.concordance = concordance
    built.facts.declared.entries = Entries(root)
    return built._replace(model=dataclasses.replace(built.model, paper=concordance.entries))


def found(built: Built, root: Path) -> list[tuple[str, str, int]]:
    return [
        (one.check, one.place.file.removeprefix("design/"), one.place.line)
        for one in paper_checks.check(*read(built, root))
    ]


def change(root: Path, file: str, old: str, new: str) -> None:
    path = root / "design" / file
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_a_complete_concordance_has_no_finding(built: Built, tree: Path) -> None:
    assert found(built, tree) == []


def test_an_element_knows_every_place_that_names_it(tree: Path) -> None:
    where = {
        element.name: element.where for element in read_concordance(tree, Entries(tree)).entries
    }
    assert where["Mode"] == ["Figure 1", "Table I"]
    assert where["Figure 1"] == []


@pytest.mark.parametrize(
    ("fault", "expected"),
    [
        (("paper.toml", '"Mode", "CR"', '"Mode", "PC", "CR"'), ("paper-complete", "paper.toml", 8)),
        (("paper.toml", '"Mode", "CR"', '"Mode"'), ("paper-complete", "concordance.toml", 9)),
        (("concordance.toml", 'deviation = "Nothing like it."\n', ""),
         ("paper-complete", "concordance.toml", 20)),
        (("concordance.toml", '    "Mode",\n', ""), ("paper-complete", "paper.toml", 8)),
        (("concordance.toml", 'name = "Figure 1"', 'name = "Figure 2"'),
         ("paper-complete", "concordance.toml", 15)),
        (("concordance.toml", "module:RC", "module:Remote"),
         ("paper-stale", "concordance.toml", 12)),
        (("concordance.toml", "FR-15", "FR-16"), ("paper-stale", "concordance.toml", 18)),
        (("concordance.toml", "reading-modes", "read-modes"),
         ("paper-stale", "concordance.toml", 18)),
        (("concordance.toml", 'alias = "Two spellings."\n', ""),
         ("paper-alias", "concordance.toml", 9)),
        (("concordance.toml", 'here = ["module:RC"]', 'here = ["module:CR", "module:RC"]'),
         ("paper-alias", "concordance.toml", 9)),
    ],
)  # fmt: skip
def test_a_fault_is_found_at_its_line(
    built: Built, tree: Path, fault: tuple[str, str, str], expected: tuple[str, str, int]
) -> None:
    change(tree, *fault)
    assert expected in found(built, tree)


def test_a_module_that_was_renamed_leaves_its_entry_stale(built: Built, tree: Path) -> None:
    modules = {name: module for name, module in built.model.modules.items() if name != "RC"}
    renamed = built._replace(model=dataclasses.replace(built.model, modules=modules))
    assert ("paper-stale", "concordance.toml", 12) in found(renamed, tree)


def test_a_page_that_the_site_does_not_have_is_found(
    built: Built, tree: Path, tmp_path: Path
) -> None:
    built = read(built, tree)
    assert [one.check for one in paper_checks.check_pages(*built, tmp_path)] == ["paper-stale"]
    (tmp_path / "index.html").write_text("")
    assert paper_checks.check_pages(*built, tmp_path) == []
