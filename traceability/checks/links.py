"""link-site: the built site has no dead link."""

from __future__ import annotations

import functools
import html
import posixpath
import re
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from urllib.parse import unquote

from traceability.model.schema import Finding, Model, Place

ATTRIBUTE = re.compile(r"""\s(id|name|href|src|xlink:href|data|poster)=("[^"]*"|'[^']*')""")


@dataclass
class _Page:
    anchors: set[str]
    links: dict[str, int]  # link -> place in the text


def _text(file: str) -> str:
    return Path(file).read_text(encoding="utf-8", errors="replace")


def _read(file: str) -> _Page:
    text, page = _text(file), _Page({"", "top"}, {})
    for attribute in ATTRIBUTE.finditer(text):
        start = text.rfind("<", 0, attribute.start())
        if start < text.rfind(">", 0, attribute.start()):
            continue  # words of the text, not of a tag
        name, value = attribute[1], html.unescape(attribute[2][1:-1])
        if name == "id" or (name == "name" and text.startswith("<a ", start)):
            page.anchors.add(value)
        elif name != "name" and value:
            page.links.setdefault(value, start)
    return page


class _Site:
    """The files below a folder, and what its pages hold."""

    def __init__(self, root: Path) -> None:
        self.root = str(root.resolve())
        self.files = {str(path) for path in Path(self.root).rglob("*") if path.is_file()}
        names = [file for file in sorted(self.files) if file.endswith((".html", ".svg"))]
        with get_context("fork").Pool() as pool:
            self.pages = dict(zip(names, pool.map(_read, names), strict=True))
        self.away = functools.cache(self._away)

    def reason(self, file: str, link: str) -> str:
        """Why a link is dead; empty for a live one."""
        if link.startswith(("#", "?")):
            return self._without(file, link.partition("#")[2])
        return self.away(posixpath.dirname(file), link)

    def _away(self, folder: str, link: str) -> str:
        """The same for each page of a folder: it is worked out once."""
        path, _, fragment = link.partition("#")
        path = path.partition("?")[0]
        if re.match(r"[a-z][a-z0-9+.-]*:|//", path, re.IGNORECASE):
            return ""
        start = self.root if path.startswith("/") else folder
        target = posixpath.normpath(f"{start}/{unquote(path)}")
        if not f"{target}/".startswith(f"{self.root}/"):
            return "it leads out of the site"
        if target not in self.files:
            target = f"{target}/index.html"
        if target not in self.files:
            return "there is no such file"
        return self._without(target, fragment)

    def _without(self, target: str, fragment: str) -> str:
        if target in self.pages and unquote(fragment) not in self.pages[target].anchors:
            return f"the page has no anchor '{unquote(fragment)}'"
        return ""


def dead_links(root: Path) -> list[tuple[Path, int, str, str]]:
    """Page, line, link and reason of each dead link."""
    site = _Site(root)
    found: list[tuple[Path, int, str, str]] = []
    for file, page in site.pages.items():
        for link, start in page.links.items():
            if reason := site.reason(file, link):
                line = _text(file).count("\n", 0, start) + 1
                found.append((Path(file), line, link, reason))
    return found


def check(model: Model, site: Path) -> list[Finding]:
    places = _sources(model)
    root = site.resolve()
    return [
        Finding(
            _place(path, line, root, places),
            "link-site",
            f"dead link '{link}' in {path.relative_to(root)}: {reason}",
            "correct the source of the page",
        )
        for path, line, link, reason in dead_links(site)
    ]


def _sources(model: Model) -> dict[str, Place]:
    """Page -> the place that it was generated from."""
    found = {f"modules/{module.name}.html": module.place for module in model.modules.values()}
    found |= {f"patterns/{item.id}.html": item.place for item in model.patterns.values()}
    found |= {f"requirements/{item.id}.html": item.place for item in model.requirements.values()}
    found |= {f"source/{file}.html": Place(file, 1) for file in model.files}
    return found


def _place(path: Path, line: int, site: Path, places: dict[str, Place]) -> Place:
    name = str(path.relative_to(site))
    if name in places:
        return places[name]
    page = site.parent.parent / "docs" / Path(name).with_suffix(".rst").name
    if page.is_file():
        return Place(f"docs/{page.name}", 1)
    return Place(f"build/site/{name}", line)
