"""Constants of the code for pages: the value with its unit, and a link to the declaration."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from portal.links import Links
from traceability.model.design_model import Model
from traceability.reading.formulas import UNIT, value_of
from traceability.reading.plain_constants import plain_constants
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


def constant_links(model: Model, links: Links, root: Path) -> dict[str, str]:
    """Returns for each constant its text in HTML, and also for each formula on a page in ``docs``.

    The module ``formulas`` describes the parts of a formula.
    """
    constants: Constants = {**plain_constants(root), **model.constants, **goal_constants(model)}
    texts = {}
    for name, constant in constants.items():
        text = in_html(constant_text(constant))
        address = links.source(constant.place)
        texts[name] = f'<a href="{address}" title="{name}">{text}</a>' if address else text
    return texts | dict(formulas(root, constants))


def goal_constants(model: Model) -> dict[str, Constant]:
    """Returns the numbers of the safety goals, with names such as ``SG-2.time``."""
    return {
        f"{goal.id}.{name}": Constant(getattr(goal, name), unit, goal.place)
        for goal in model.safety.goals.values()
        for name, unit in (("time", "s"), ("reaction", "s"), ("velocity", "m/s"))
    }


def formulas(root: Path, constants: Constants) -> Iterator[tuple[str, str]]:
    for path in sorted((root / "docs").glob("*.rst")):
        for role in ROLE.findall(path.read_text(encoding="utf-8")):
            formula = " ".join(role.split())
            if formula not in constants and (number := value_of(formula, constants)) is not None:
                unit = UNIT.search(formula)
                text = in_html(number_text(number, unit[1] if unit else ""))
                yield formula, f'<span title="{html.escape(formula)}">{text}</span>'


def in_html(text: str) -> str:
    text = html.escape(text.replace(" ", "\N{NO-BREAK SPACE}"))
    return re.sub(r"\^(\d)", r"<sup>\1</sup>", text)
