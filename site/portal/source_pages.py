"""The source, a page for each file."""

from __future__ import annotations

from dataclasses import dataclass

from portal.module_page import line_kind
from portal.portal import Page, Portal


def folders(portal: Portal) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for path in portal.model.files:
        found.setdefault(path.rpartition("/")[0], []).append(path)
    return found


@dataclass
class Line:
    number: int
    code: str
    hits: int | None
    marks: list[str]


def source_page(portal: Portal, path: str) -> Page:
    marks, hits = portal.marks.get(path, {}), portal.hits.get(path, {})
    lines = [
        Line(number, code, hits.get(number), marks.get(number, []))
        for number, code in enumerate(portal.code.lines(path), 1)
    ]
    modules = [m.name for m in portal.model.modules.values() if path in (m.header, m.source)]
    return portal.page(
        f"source/{path}", path, "source", "source_file", path=path, lines=lines, modules=modules,
        measured=bool(hits), on_board=path in (portal.model.board_lines or {}),
        line_kind=line_kind,
    )  # fmt: skip
