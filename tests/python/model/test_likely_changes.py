"""What a likely change takes, read off a small tree."""

from __future__ import annotations

import pytest

from tests.python.model.small_tree import write_tree
from traceability.model.build import build
from traceability.model.design_model import Model
from traceability.model.likely_changes import changes_of
from traceability.reading.change_texts import ChangeTexts, Recipe

CHANGES = """\
[[recipe]]
pattern = "State"
alters = ["Concrete State"]
adds = "Concrete State"
derives = "State"
steps = ["Derive a class from {derives}."]

[[application]]
id = "reading-modes"
examples = ["PC"]
steps = ["Number it."]
"""
BUILDER = """\
#pragma once

#include "main_control/operation_modes/RC.hpp"

namespace wr {

/// @brief Makes the modes.
///
/// @function Makes a mode.
///
/// @secret Which modes there are.
class Builder {
 private:
  RC rc_;
};

}  // namespace wr
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Model:
    root = write_tree(tmp_path_factory.mktemp("changes"))
    (root / "design").mkdir(exist_ok=True)
    (root / "design" / "changes.toml").write_text(CHANGES)
    (root / "src" / "main_control" / "Builder.hpp").write_text(BUILDER)
    return build(root).model


def test_a_likely_change_lists_what_is_added_edited_and_looked_at_again(built: Model) -> None:
    change = built.changes["reading-modes"]
    assert (change.hidden_by, change.role, change.derives) == ("Mode", "Concrete State", ["Mode"])
    assert change.logic == "main_control/operation_modes"
    assert change.altered == ["PC", "RC"]
    assert change.edits == ["Builder"]
    assert "MainController" in change.untouched
    assert "Builder" not in change.untouched
    assert change.steps == ["Derive a class from {derives}.", "Number it."]
    assert change.examples == ["PC"]
    assert (change.requirements, change.tests) == (["FR-15"], ["Working.WaitsWithoutMessage"])


def test_a_change_that_adds_nothing_edits_what_it_alters(built: Model) -> None:
    application = built.patterns["reading-modes"]
    recipe = Recipe(["State"], steps=["Edit it."])
    texts = ChangeTexts({application.pattern: recipe})
    change = changes_of(built, texts)["reading-modes"]
    assert (change.derives, change.edits) == ([], ["Mode"])
    assert "RC" in change.untouched


def test_without_texts_there_are_no_changes(built: Model) -> None:
    assert changes_of(built, ChangeTexts()) == {}
