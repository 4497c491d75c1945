"""Constants of the code for pages: the value with its unit, and a link to the declaration."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from pathlib import Path

from portal.links import Links
from traceability.model.design_model import Model
from traceability.reading.constant_texts import ROLE, Constants, constant_text, formula_text
from traceability.reading.plain_constants import plain_constants
from traceability.schema import Constant


def constant_links(model: Model, links: Links, root: Path) -> dict[str, str]:
    """Returns the HTML text of each constant, and of each formula on a page in ``docs``.

    The module ``formulas`` describes the parts of a formula."""
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
            if formula not in constants and (text := formula_text(formula, constants)):
                yield formula, f'<span title="{html.escape(formula)}">{in_html(text)}</span>'


def in_html(text: str) -> str:
    text = html.escape(text.replace(" ", "\N{NO-BREAK SPACE}"))
    return re.sub(r"\^(\d)", r"<sup>\1</sup>", text)
