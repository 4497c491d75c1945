"""link-site: the built site has no dead link."""

from __future__ import annotations

import html
import posixpath
import re
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

from traceability.model.schema import Finding, Model, Place

ATTRIBUTE = re.compile(r"""\s(id|name|href|src|xlink:href|data|poster)=("[^"]*"|'[^']*')""")


@dataclass
class _Page:
    text: str
    anchors: set[str]
    links: dict[str, int]  # link -> place in the text


def _read(path: Path) -> _Page:
    page = _Page(path.read_text(encoding="utf-8", errors="replace"), {"", "top"}, {})
    for attribute in ATTRIBUTE.finditer(page.text):
        start = page.text.rfind("<", 0, attribute.start())
        if start < page.text.rfind(">", 0, attribute.start()):
            continue  # words of the text, not of a tag
        name, value = attribute[1], html.unescape(attribute[2][1:-1])
        if name == "id" or (name == "name" and page.text.startswith("<a ", start)):
            page.anchors.add(value)
        elif name != "name" and value:
            page.links.setdefault(value, start)
    return page


def dead_links(site: Path) -> list[tuple[Path, int, str, str]]:
    """Page, line, link and reason of each dead link."""
    root = str(site.resolve())
    files = {str(path) for path in Path(root).rglob("*") if path.is_file()}
    pages = {file: _read(Path(file)) for file in sorted(files) if file.endswith((".html", ".svg"))}
    found: list[tuple[Path, int, str, str]] = []
    for file, page in pages.items():
        for link, start in page.links.items():
            reason = _dead(file, link, pages, files, root)
            if reason:
                line = page.text.count("\n", 0, start) + 1
                found.append((Path(file), line, link, reason))
    return found


def _dead(file: str, link: str, pages: dict[str, _Page], files: set[str], root: str) -> str:
    path, _, fragment = link.partition("#")
    path = path.partition("?")[0]
    if re.match(r"[a-z][a-z0-9+.-]*:|//", path, re.IGNORECASE):
        return ""
    target = file
    if path:
        start = root if path.startswith("/") else posixpath.dirname(file)
        target = posixpath.normpath(f"{start}/{unquote(path)}")
    if not f"{target}/".startswith(f"{root}/"):
        return "it leads out of the site"
    if target not in files:
        target = f"{target}/index.html"
    if target not in files:
        return "there is no such file"
    if target in pages and unquote(fragment) not in pages[target].anchors:
        return f"the page has no anchor '{unquote(fragment)}'"
    return ""


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
