"""A reader reaches each view with one click from the first page. Three clicks are enough for each
page of a module, requirement, pattern, check, change or source file. Links in the navigation do not
count."""

from __future__ import annotations

from typing import Any

import pytest

from tests.python.site.content import SITE, clicks, content, searched

NEAR = 3  # greatest number of clicks


def farther(addresses: list[str], most: int) -> dict[str, int | None]:
    """Returns the addresses that need more clicks than allowed, and the addresses to which no link
    leads."""
    found = clicks()
    return {name: found.get(name) for name in addresses if found.get(name, 99) > most}


def test_every_view_is_one_click_away() -> None:
    views = [entry[4] for entry in searched() if entry[0] == "Pages"]
    assert len(views) > 30
    assert farther(views, 1) == {}


@pytest.mark.parametrize("kind", ["modules", "requirements", "patterns", "checks", "changes"])
def test_every_page_of_a_kind_is_near(kind: str) -> None:
    pages = [str(path.relative_to(SITE)) for path in (SITE / kind).glob("*.html")]
    assert len(pages) > 25
    assert farther(pages, NEAR) == {}


def test_every_module_requirement_and_pattern_has_a_page(model: dict[str, Any]) -> None:
    named = {
        "modules": [name for name, one in model["modules"].items() if not one["datatype"]],
        "requirements": list(model["requirements"]),
        "patterns": list(model["patterns"]),
        "changes": list(model["patterns"]),
    }
    missing = [
        f"{kind}/{name}"
        for kind, names in named.items()
        for name in names
        if not (SITE / kind / f"{name}.html").exists()
    ]
    assert missing == []


def test_every_public_method_is_near(model: dict[str, Any]) -> None:
    found = clicks()
    methods = [
        (f"modules/{module['name']}.html", f"m-{method['name']}", method["id"])
        for module in model["modules"].values()
        if not module["datatype"]
        for method in module["methods"]
        if method["access"] == "public" and method["name"].isidentifier()
    ]
    assert len(methods) > 300
    far = [
        name
        for page, anchor, name in methods
        if found.get(page, 99) > NEAR or anchor not in content(page).ids
    ]
    assert far == []


def test_every_source_file_test_and_data_type_is_near(model: dict[str, Any]) -> None:
    sources = [f"source/{path}.html" for path in model["files"]]
    assert farther(sources, NEAR) == {}
    ids = content("tests.html").ids
    assert [name for name in model["tests"] if name.replace("/", "-2f") not in ids] == []
    types = [name for name, one in model["modules"].items() if one["datatype"]]
    assert [name for name in types if name not in content("datatypes.html").ids] == []
    assert farther(["tests.html", "datatypes.html"], 1) == {}


def test_no_page_needs_more_than_three_clicks() -> None:
    pages = [str(path.relative_to(SITE)) for path in SITE.rglob("*.html")]
    others = [page for page in pages if page != "index.html"]
    assert farther(others, NEAR) == {}
