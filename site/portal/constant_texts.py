"""Constants of the code for pages: the value with its unit, and a link to the declaration."""

from __future__ import annotations

import html

from portal.links import Links
from traceability.model.design_model import Model
from traceability.schema import Constant

# Unit in the code -> (number, unit on a page): one unit on a page is this number of units in the
# code.
SHOWN = {
    "0.01 degree": (100, "degree"),
    "0.1 rpm": (10, "rpm"),
    "0.01 %": (100, "%"),
    "mV": (1000, "V"),
    "uV": (1000, "mV"),
    "mA": (1000, "A"),
    "mOhm": (1000, "ohm"),
    "1/1000": (1000, ""),
}
# Unit -> (number, larger unit): one larger unit is this number of units. A text shows the larger
# unit when the value is a whole number of larger units.
LONGER = {"us": (1000, "ms"), "ms": (1000, "s"), "Hz": (1_000_000, "MHz")}


def constant_text(constant: Constant) -> str:
    """Returns the value and the unit, as in ``100 ms``."""
    number, unit = float(constant.number), constant.unit.partition(" per ")[0]
    steps, unit = SHOWN.get(unit, (1, unit))
    number /= steps
    while unit in LONGER and number and number % LONGER[unit][0] == 0:
        steps, unit = LONGER[unit]
        number /= steps
    if unit == "degree" and abs(number) > 1:
        unit = "degrees"
    return f"{number:.15g} {unit}".strip()


def constant_links(model: Model, links: Links) -> dict[str, str]:
    """Returns for each constant its text in HTML."""
    texts = {}
    for name, constant in model.constants.items():
        text = html.escape(constant_text(constant).replace(" ", "\N{NO-BREAK SPACE}"))
        text = text.replace("^2", "<sup>2</sup>")
        address = links.source(constant.place)
        texts[name] = f'<a href="{address}" title="{name}">{text}</a>' if address else text
    return texts
