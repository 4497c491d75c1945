"""The diagram of the packages agrees with the rules for imports in pyproject.toml."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from portal.package_diagram import package_diagrams

pytestmark = pytest.mark.reads("pyproject.toml", "traceability", "client")


def test_an_arrow_leads_from_each_layer_to_the_one_below() -> None:
    (diagram,) = package_diagrams(Path(__file__).parents[3])
    layers = ("tools", "portal", "traceability", "weeding_robot_client")
    for arrow in map(" --> ".join, pairwise(layers)):
        assert arrow in diagram.text
    assert "traceability_checks --> traceability_model" in diagram.text
    assert "The commands of ./wr." in diagram.text


def test_a_project_without_contracts_has_no_diagram(tmp_path: Path) -> None:
    assert package_diagrams(tmp_path) == []
