"""Constants on hand-written pages: value and unit for a reader, and an unknown one is an error."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from portal import sphinx_extension
from portal.constant_texts import constant_links, constant_text
from portal.sphinx_extension import NameRole
from traceability.schema import Constant, Place

HERE = Place("src/Limits.hpp", 7)


@pytest.mark.parametrize(
    ("number", "unit", "text"),
    [
        (100, "ms", "100 ms"),
        (1000, "ms", "1 s"),
        (1500, "ms", "1500 ms"),
        (2_000_000, "us", "2 s"),
        (0, "ms", "0 ms"),
        (60_000_000, "Hz", "60 MHz"),
        (5, "0.01 degree", "0.05 degree"),
        (3200, "0.01 degree", "32 degrees"),
        (6000, "0.1 rpm", "600 rpm"),
        (24000, "mV", "24 V"),
        (4650, "uV per unit of the error", "4.65 mV"),
        (637, "1/1000", "0.637"),
        (60, "", "60"),
    ],
)
def test_a_constant_is_shown_in_the_unit_of_a_reader(number: int, unit: str, text: str) -> None:
    assert constant_text(Constant(number, unit, HERE)) == text


def test_a_constant_leads_to_its_declaration() -> None:
    model: Any = SimpleNamespace(constants={"kMost": Constant(5, "steps/s^2", HERE)})
    links: Any = SimpleNamespace(source=lambda place: f"@/source/{place.file}.html#L{place.line}")
    found = constant_links(model, links)["kMost"]
    address = "@/source/src/Limits.hpp.html#L7"
    assert found == f'<a href="{address}" title="kMost">5\N{NO-BREAK SPACE}steps/s<sup>2</sup></a>'


def test_an_unknown_constant_is_a_warning_with_its_place(monkeypatch: pytest.MonkeyPatch) -> None:
    warnings: list[tuple[str, str]] = []
    logger = SimpleNamespace(warning=lambda text, location: warnings.append((text, location)))
    monkeypatch.setattr(sphinx_extension, "LOGGER", logger)
    role: Any = NameRole({"kMost": "5"})
    role.name, role.text, role.rawtext = "constant", "kLeast", ":constant:`kLeast`"
    role.get_location = lambda: "docs/page.rst:3"
    role.run()
    assert warnings == [("unknown target: there is no constant 'kLeast'", "docs/page.rst:3")]
