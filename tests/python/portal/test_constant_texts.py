"""Constants on hand-written pages. A reader sees the value and the unit."""

from __future__ import annotations

from pathlib import Path

import pytest

from portal.constant_texts import formulas
from traceability.reading.constant_texts import constant_text, inserted
from traceability.schema import Constant, Place


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
        (0x410, "address", "0x410"),
        (16, "byte", "16 bytes"),
    ],
)
def test_a_constant_is_shown_in_the_unit_of_a_reader(number: int, unit: str, text: str) -> None:
    assert constant_text(Constant(number, unit, Place("src/Limits.hpp", 7))) == text


CONSTANTS = {
    "Times::kCycle": Constant(100, "ms", Place("src/Times.hpp", 1)),
    "kMost": Constant(4, "", Place("src/Times.hpp", 2)),
    "SG-2.time": Constant(0.35, "s", Place("design/safety_case.toml", 3)),
}


@pytest.mark.parametrize(
    ("formula", "text"),
    [
        ("2 * Times::kCycle [ms]", "200 ms"),
        ("(kMost + 1) * Times::kCycle [ms]", "500 ms"),
        ("kMost * 5 *\n  Times::kCycle [ms]", "2 s"),
        ("Times::kCycle / kMost", "25"),
        ("kMost - 1", "3"),
        ("kMost ** 2", "16"),
        ("ceil(kMost / 3)", "2"),
        ("round(2 * pi / kMost, 2) [s]", "1.57 s"),
        ("round(Times::kCycle / kMost / 3)", "8"),
        ("1000 * SG-2.time [ms]", "350 ms"),
    ],
)
def test_a_formula_of_a_page_is_computed_from_constants(
    tmp_path: Path, formula: str, text: str
) -> None:
    ((name, shown),) = formulas_of(tmp_path, formula).items()
    assert name == " ".join(formula.split())
    assert f">{text}<" in shown.replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(
    "formula",
    [
        "kOther + 1",
        "kMost +",
        "kMost / 0",
        "kMost",
        "sin(kMost)",
        "round(kMost, 1, 2)",
        "round + 1",
    ],
)
def test_a_formula_with_an_unknown_name_or_operation_has_no_text(
    tmp_path: Path, formula: str
) -> None:
    assert formulas_of(tmp_path, formula) == {}


def test_a_text_of_the_design_inserts_constants() -> None:
    text = "It takes :constant:`kMost * Times::kCycle [ms]`, not :constant:`kOther`."
    assert inserted(text, CONSTANTS) == "It takes 400 ms, not :constant:`kOther`."


def formulas_of(root: Path, formula: str) -> dict[str, str]:
    (root / "docs").mkdir()
    (root / "docs" / "page.rst").write_text(f"It has :constant:`{formula}` here.\n")
    return dict(formulas(root, CONSTANTS))
