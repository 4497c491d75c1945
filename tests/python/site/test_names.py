"""On selected pages, each name of a module, method or requirement in code font is a link. Listings
are left out."""

from __future__ import annotations

import re
from typing import Any

import pytest

from tests.python.site.content import content

# The data dictionary is left out, because some of its enumerators have the name of their module.
SAMPLE = [
    "index", "structure", "guide", "interfaces", "inheritances", "secrets", "changes",
    "concordance", "architecture", "machines", "uses", "trees", "products",
    "execution", "patterns/index",
    "requirements/index", "checks/index", "patterns/reading-modes", "patterns/serializer",
    "changes/reading-modes", "changes/cycle-timer-interrupt", "requirements/FR-15",
    "requirements/FR-17", "modules/MainController", "modules/RC", "modules/Pipe",
    "modules/K64Uart", "checks/uses-allowed", "virtual_k64", "docs/execution_model",
]  # fmt: skip


def linkable(model: dict[str, Any]) -> set[str]:
    """Returns the names that must be links: modules, requirements, and public methods in the form
    Class::method."""
    modules = model["modules"]
    methods = {
        method["id"]
        for module in modules.values()
        if not module["datatype"]
        for method in module["methods"]
        if method["access"] == "public"
    }
    return {*modules, *model["requirements"], *methods, *(f"{name}()" for name in methods)}


@pytest.mark.parametrize("page", SAMPLE)
def test_a_name_set_as_code_is_a_link(page: str, model: dict[str, Any]) -> None:
    known = linkable(model)
    loose = [
        code.text
        for code in content(f"{page}.html").codes
        if code.text in known and not code.linked and not code.listing
    ]
    assert loose == []


def test_types_in_a_signature_are_links() -> None:
    links = content("modules/Wheel.html").links
    # two links to the type Tension: in the interface, and in the module guide
    assert links.count("datatypes.html#Tension") == 2


def test_a_call_of_a_function_outside_classes_has_its_name_alone() -> None:
    assert not re.search(r"\w::\s", content("execution.html").text)
