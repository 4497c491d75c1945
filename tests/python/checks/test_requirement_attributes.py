"""The checks req-attribute and req-source verify the level, the products, the verification method
and the source of each requirement."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.python.model.small_case import make_model, write_case
from tests.python.project_files import write_files
from traceability.checks.requirement_checks import _attributes, _sources
from traceability.model.design_model import Model
from traceability.model.evidence import read_evidence
from traceability.reading.comments import Comments
from traceability.reading.declared_safety import read_sources
from traceability.reading.products import PRODUCTS
from traceability.reading.source_lines import headings
from traceability.schema import PaperPlace, Place

WHERE = Place("design/paper.toml", 1)


def changed(root: Path, **changes: Any) -> Model:
    write_case(root)
    model = make_model(root)
    model.requirements["FR-1"] = replace(model.requirements["FR-1"], **changes)
    return model


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("level", "system", ""),
        ("level", "robot", "FR-1 has no valid @level (system, software, driver)"),
        ("level", "", "FR-1 has no valid @level (system, software, driver)"),
        ("products", ["weeding_robot", "weeding_robot_pc"], ""),
        ("products", [], "FR-1 has no @product (all, or names of products)"),
        ("products", ["mower"], "FR-1 has a @product mower, which does not exist"),
        ("method", "inspection", ""),
        ("method", "measurement", "FR-1 has the @method measurement, but no @evidence"),
        ("method", "belief", "FR-1 has no valid @method (test, analysis, measurement, inspection)"),
    ],
)
def test_an_attribute_has_a_known_value(
    tmp_path: Path, name: str, value: object, says: str
) -> None:
    model = changed(tmp_path, **{name: value})
    assert [one.text for one in _attributes(model)] == [says] * bool(says)


@pytest.mark.parametrize(
    ("methods", "products", "says"),
    [
        (["Wheel::set"], ["all"], []),
        (
            ["Wheel::set"],
            sorted(PRODUCTS.keys() - {"weeding_robot_pc"}),
            [
                "no @product weeding_robot_pc, but this product contains all modules that satisfy "
                "FR-1; add it to @product"
            ],
        ),
        (["RC::read"], ["weeding_robot", "weeding_robot_paper", "weeding_robot_warning"], []),
        (
            ["RC::read"],
            ["weeding_robot", "weeding_robot_paper"],
            [
                "no @product weeding_robot_warning, but this product contains all modules that "
                "satisfy FR-1; add it to @product"
            ],
        ),
        (
            ["EnableSwitch::read"],
            ["weeding_robot", "weeding_robot_pc"],
            [
                "the @product weeding_robot_pc, but this product contains no module that satisfies "
                "FR-1; remove it from @product"
            ],
        ),
        (["EnableSwitch::read", "RC::read", "Wheel::set"], ["weeding_robot"], []),
        ([], ["weeding_robot"], []),
    ],
)
def test_the_products_agree_with_the_modules_that_satisfy_a_requirement(
    tmp_path: Path, methods: list[str], products: list[str], says: list[str]
) -> None:
    model = changed(tmp_path, satisfied_by=methods, products=products)
    assert [one.text for one in _attributes(model)] == [f"FR-1 has {text}" for text in says]


@pytest.mark.parametrize(
    ("method", "evidence", "found"),
    [
        # With the method "test", evidence cannot replace a test.
        ("test", True, 1),
        ("analysis", False, 1),
        ("analysis", True, 0),
        ("measurement", False, 1),
        ("measurement", True, 0),
        ("inspection", False, 0),
    ],
)
def test_the_method_has_something_that_shows_it(
    tmp_path: Path, method: str, evidence: bool, found: int
) -> None:
    measured = [read_evidence("checks.uses-board exactly 0", WHERE)] * evidence
    model = changed(tmp_path, method=method, verified_by=[], evidence=measured)
    assert len(list(_attributes(model))) == found


@pytest.mark.parametrize(
    ("source", "says"),
    [
        ("goal: SG-1", []),
        ("paper: Section VII; decision: anything at all", []),
        ("protocol: Frames", []),
        ("data sheet: Part X", []),
        ("Safety", ["the source 'Safety' of FR-1 has no kind"]),
        ("paper: Section X", ["FR-1 has the source paper: Section X, which does not exist"]),
        ("goal: SG-5", ["FR-1 has the source goal: SG-5, which does not exist"]),
        ("protocol: Birds", ["FR-1 has the source protocol: Birds, which does not exist"]),
        ("data sheet: Part Y", ["FR-1 has the source data sheet: Part Y, which does not exist"]),
    ],
)
def test_a_source_refers_to_what_exists(tmp_path: Path, source: str, says: list[str]) -> None:
    model = changed(tmp_path, sources=read_sources(source))
    model = replace(model, paper_places=[PaperPlace("Section VII", "section", "Title", WHERE)])
    assert [one.text for one in _sources(model, facts_of(tmp_path))] == says


def test_a_goal_that_is_the_source_is_named_too(tmp_path: Path) -> None:
    model = changed(tmp_path, sources=read_sources("goal: SG-1"), goals=[])
    texts = [one.text for one in _sources(model, facts_of(tmp_path))]
    assert texts == ["FR-1 has the source SG-1, but no @goal SG-1"]


def facts_of(root: Path) -> Any:
    page = "PC protocol\n===========\n\nFrames\n------\n\nA text.\n\n---\n"
    write_files(root, {"docs/protocol.rst": page})
    assert list(headings(root / "docs/protocol.rst")) == ["PC protocol", "Frames"]
    return SimpleNamespace(root=root, comments=Comments(root))
