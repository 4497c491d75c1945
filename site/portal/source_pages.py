"""The source pages. Each page shows a source file."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup

from portal.module_page import line_kind
from portal.portal import Page, Portal
from traceability.grouping import grouped
from traceability.reading.products import RECORDED
from traceability.sources import DESIGN


def folders(portal: Portal) -> dict[str, list[str]]:
    return grouped(portal.model.files, lambda path: path.rpartition("/")[0])


@dataclass
class Line:
    html: Markup
    marks: list[str]


def source_page(portal: Portal, path: str) -> Page:
    marks, hits = portal.marks.get(path, {}), portal.hits.get(path, {})
    lines = [
        Line(line_html(number, code, hits.get(number)), marks.get(number, []))
        for number, code in enumerate(portal.code.lines(path), 1)
    ]
    modules = [m.name for m in portal.model.modules.values() if path in (m.header, m.source)]
    return portal.page(
        f"source/{path}", path, "source", "source_file", path=path, lines=lines, modules=modules,
        measured=bool(hits), designed=path.startswith(DESIGN),
        recorded=RECORDED if path in (portal.model.board_lines or {}) else "",
    )  # fmt: skip


def line_html(number: int, code: str, hit: bool | None) -> Markup:
    """Returns a source line as HTML, with its line number and a link to itself."""
    anchor = f'<a class="ln" href="#L{number}">{number}</a>'
    return Markup(f'<span class="cl {line_kind(hit)}" id="L{number}">{anchor}{code}</span>\n')
