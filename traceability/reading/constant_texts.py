"""Texts of constants: the value with its unit. Texts of the design insert them with the role
``:constant:``."""

from __future__ import annotations

import re
from collections.abc import Mapping

from traceability.reading.formulas import UNIT, value_of
from traceability.schema import Constant

# Unit in the code -> (number, unit on a page): one unit on a page is this number of units in the
# code.
SHOWN: dict[str, tuple[float, str]] = {
    "0.01 degree": (100, "degree"),
    "0.1 rpm": (10, "rpm"),
    "0.01 %": (100, "%"),
    "mV": (1000, "V"),
    "uV": (1000, "mV"),
    "mA": (1000, "A"),
    "mOhm": (1000, "ohm"),
    "1/1000": (1000, ""),
    "fraction": (0.01, "%"),
}
# Unit -> (number, larger unit): one larger unit is this number of units. A text shows the larger
# unit when the value is a whole number of larger units.
LONGER = {
    "ns": (1000, "us"),
    "us": (1000, "ms"),
    "ms": (1000, "s"),
    "Hz": (1_000_000, "MHz"),
}
HEXADECIMAL = "address"  # unit of a number that is shown in hexadecimal digits
PLURALS = ("degree", "byte", "step", "cycle")
ROLE = re.compile(r":constant:`([^`]+)`")
Constants = Mapping[str, Constant]


def inserted(text: str, constants: Constants) -> str:
    """Returns a text in which the value of a constant or formula replaces each role ``:constant:``.
    A role with an unknown name remains."""
    return ROLE.sub(lambda role: formula_text(role[1], constants) or role[0], text)


def formula_text(formula: str, constants: Constants) -> str | None:
    """Returns the value of a constant or of a formula. Returns None if it has no value.

    The module ``formulas`` describes the parts of a formula."""
    if formula in constants:
        return constant_text(constants[formula])
    number, unit = value_of(formula, constants), UNIT.search(formula)
    return None if number is None else number_text(number, unit[1] if unit else "")


def constant_text(constant: Constant) -> str:
    """Returns the value and the unit, as in ``100 ms``."""
    return number_text(float(constant.number), constant.unit)


def number_text(number: float, unit: str) -> str:
    unit = unit.partition(" per ")[0]
    if unit == HEXADECIMAL:
        return f"0x{int(number):X}"
    steps, unit = SHOWN.get(unit, (1, unit))
    number /= steps
    while unit in LONGER and number and number % LONGER[unit][0] == 0:
        steps, unit = LONGER[unit]
        number /= steps
    if unit in PLURALS and abs(number) > 1:
        unit += "s"
    return f"{number:.12g} {unit}".strip()
