"""The tables on the page of the likely changes: the costs of the changes, and the source lines of
both designs.
"""

from __future__ import annotations

import html
import re
from typing import Any

import pytest

from tests.python.site.content import SITE

TAG = re.compile(r"<[^>]+>")
ROW = re.compile(r"<tr>(.*?)</tr>", re.DOTALL)
CELL = re.compile(r'<td class="num"[^>]*>(\d+)</td>')


@pytest.fixture(scope="module")
def page() -> str:
    return (SITE / "changes.html").read_text(encoding="utf-8")


def rows(part: str) -> list[str]:
    return [" ".join(html.unescape(TAG.sub(" ", row)).split()) for row in ROW.findall(part)]


def test_a_row_with_the_cost_of_a_whole_extension_says_so(page: str, model: dict[str, Any]) -> None:
    made = [change["made"] for change in model["changes"].values() if change["made"]]
    table = rows(page.partition('id="made"')[2].partition("</table>")[0])
    for one in made:
        (row,) = [row for row in table if row.startswith(f"{one['application']} ")]
        shared = sum(other["extension"] == one["extension"] for other in made)
        words = f"The example is {one['extension']} , which makes {shared} of these changes"
        assert (words in row) == bool(one["extension"])


def test_the_lines_of_both_designs_have_their_sums(page: str) -> None:
    table = page.partition('id="both"')[2].partition("</table>")[0]
    counts = [[int(cell) for cell in CELL.findall(row)] for row in ROW.findall(table)]
    counts = [row for row in counts if row]
    assert len(counts) > 2
    assert counts[-1] == [sum(column) for column in zip(*counts[:-1], strict=True)]
