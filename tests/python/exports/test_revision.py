"""The differences between two revisions, and the form in which they are shown."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.python.portal.fixture import REPORT, make_model
from traceability.exports.revision import (
    Difference,
    Revision,
    changed_words,
    differences,
    read_revision,
    revision_of,
    write_revision,
)
from traceability.model.design_model import Model
from traceability.model.report import Verdict
from traceability.schema import Finding, Place, ProductImage, Review


@pytest.fixture
def model() -> Model:
    image = ProductImage(50_000, 9000, 700, [], [])
    return replace(make_model(), products={"weeding_robot": image})


@pytest.fixture
def first(model: Model) -> Revision:
    return revision_of(model, "a" * 40, REPORT, {"tests.total": 700, "live.bytes": None})


def test_equal_models_have_no_differences(model: Model, first: Revision) -> None:
    same = revision_of(model, "b" * 40, REPORT, {"tests.total": 700, "live.bytes": None})
    assert differences(first, same) == []


def test_a_revision_is_read_back(first: Revision, tmp_path: Path) -> None:
    write_revision(tmp_path, first)
    assert read_revision(tmp_path, first.commit) == first
    assert read_revision(tmp_path, "c" * 40) is None


def test_changes_of_a_requirement_are_shown(model: Model, first: Revision) -> None:
    old = model.requirements["FR-15"]
    review = Review("FR-15", "A. Person", "", "2026-01-02", "", "", "", {}, Place("a", 1))
    new = replace(
        old, text=f"{old.text} At once.", verified_by=["T.B"], tree=None, reviews=[review]
    )
    later = replace(model, requirements={**model.requirements, "FR-15": new})
    report = replace(REPORT, requirements={**REPORT.requirements, "FR-15": Verdict("stale")})
    found = differences(first, revision_of(later, "b" * 40, report, {}))
    assert Difference("verdicts", "FR-15", "verified -> stale") in found
    assert Difference("tests of requirements", "FR-15", "+ T.B") in found
    assert Difference("tests of requirements", "FR-15", "- RcTest.Reads") in found
    assert Difference("reviews of requirements", "FR-15", "+ A. Person, 2026-01-02") in found
    assert any(one.section == "tree of requirements" and one.text[0] == "-" for one in found)
    (text,) = (one.text for one in found if one.section == "text of requirements")
    assert text.endswith("{+At once.+}")


def test_names_sizes_findings_and_metrics_are_compared(model: Model, first: Revision) -> None:
    modules = {name: one for name, one in model.modules.items() if name != "RC"}
    image = ProductImage(50_128, 9000, 700, [], [])
    later = replace(model, modules=modules, products={"weeding_robot": image})
    report = replace(REPORT, findings=[Finding(Place("a", 1), "tree-static", "no call", "fix")])
    found = differences(first, revision_of(later, "b" * 40, report, {"tests.total": 710}))
    assert found == [
        Difference("modules", "RC", "removed"),
        Difference("sizes", "weeding_robot", "flash: 50000 -> 50128 (+128) bytes"),
        Difference("findings", "tree-static", "0 -> 1 (+1)"),
        Difference("metrics", "tests.total", "700 -> 710 (+10)"),
    ]


def test_without_results_there_are_no_verdicts_and_no_findings(
    model: Model, first: Revision
) -> None:
    sources = revision_of(replace(model, products=None), "b" * 40, None, {})
    assert sources.findings is None
    assert differences(first, sources) == differences(sources, first) == []


def test_only_the_words_around_a_change_are_shown() -> None:
    old = " ".join(f"w{number}" for number in range(60))
    assert changed_words(old, old.replace("w30", "new")) == (
        "w0 w1 w2 w3 w4 w5 w6 w7 ... w22 w23 w24 w25 w26 w27 w28 w29 [-w30-] {+new+} "
        "w31 w32 w33 w34 w35 w36 w37 w38 ... w52 w53 w54 w55 w56 w57 w58 w59"
    )
