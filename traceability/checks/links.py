"""link-site: the built site has no dead link."""

from __future__ import annotations

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from traceability.model.schema import Finding, Model, Place

ATTRIBUTES = {"href", "src", "xlink:href", "data", "poster"}


class _Page(HTMLParser):
    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.anchors: set[str] = {"", "top"}
        self.links: list[tuple[str, int]] = []
        self.base = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if value is None:
                continue
            if name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)
            elif name in ATTRIBUTES and value != "":
                self.links.append((value, self.getpos()[0]))

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)


def dead_links(site: Path) -> list[tuple[Path, int, str, str]]:
    """Page, line, link and reason of each dead link."""
    pages: dict[Path, _Page] = {}
    for path in sorted([*site.rglob("*.html"), *site.rglob("*.svg")]):
        page = _Page()
        page.feed(path.read_text(encoding="utf-8", errors="replace"))
        pages[path.resolve()] = page
    found: list[tuple[Path, int, str, str]] = []
    for path, page in pages.items():
        for link, line in dict(page.links).items():
            reason = _dead(path, link, pages, site.resolve())
            if reason:
                found.append((path, line, link, reason))
    return found


def _dead(path: Path, link: str, pages: dict[Path, _Page], site: Path) -> str:
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return ""
    target = path
    if parts.path:
        start = site if parts.path.startswith("/") else path.parent
        target = (start / unquote(parts.path).lstrip("/")).resolve()
        if target.is_dir():
            target /= "index.html"
    if not target.is_relative_to(site):
        return "it leads out of the site"
    if not target.is_file():
        return "there is no such file"
    fragment = unquote(parts.fragment)
    if target in pages and fragment not in pages[target].anchors:
        return f"the page has no anchor '{fragment}'"
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
