"""Constants on hand-written pages. A reader sees the value and the unit."""

from __future__ import annotations

import pytest

from portal.constant_texts import constant_text
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
    ],
)
def test_a_constant_is_shown_in_the_unit_of_a_reader(number: int, unit: str, text: str) -> None:
    assert constant_text(Constant(number, unit, Place("src/Limits.hpp", 7))) == text
