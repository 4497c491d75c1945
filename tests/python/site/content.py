"""Reads the pages of the built site like a reader who follows only the links of the content."""

from __future__ import annotations

import json
import posixpath
import re
from dataclasses import dataclass, field
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

SITE = Path(__file__).parents[3] / "build" / "site"
FIRST = "index.html"
VOID = {
    "area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track",
    "wbr", "path", "rect", "circle", "line",
}  # fmt: skip
LISTING = re.compile(r"source/.+\.\w+\.html")  # pages of code
# Classes of elements for navigation: the side navigation, the way back, the search.
NAVIGATION = re.compile(r"\b(search|crumbs|side|skip)\b")


@dataclass
class Code:
    """A text set as code, and whether it is in a link or in a listing."""

    text: str
    linked: bool
    listing: bool


@dataclass
class Content:
    """The links, the ids and the text of the content of a page."""

    links: list[str] = field(default_factory=list)
    ids: dict[str, tuple[int, int]] = field(default_factory=dict)  # id -> part of the text
    codes: list[Code] = field(default_factory=list)
    text: str = ""


class Reader(HTMLParser):
    def __init__(self, page: str) -> None:
        super().__init__()
        self.page = page
        self.found = Content()
        self.open: list[tuple[str, bool, str, int]] = []  # tag, is navigation, id, start
        self.parts: list[str] = []
        self.size = 0
        self.code: list[str] | None = None

    @property
    def inside(self) -> bool:
        tags = [tag for tag, *_ in self.open]
        return "main" in tags and not any(passed for _, passed, *_ in self.open)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        skipped = tag == "nav" or bool(NAVIGATION.search(values.get("class", "")))
        if tag not in VOID:
            self.open.append((tag, skipped, values.get("id", ""), self.size))
        if not self.inside:
            return
        if "id" in values:
            self.found.ids.setdefault(values["id"], (self.size, self.size))
        if tag == "a" and values.get("href"):
            self.found.links.append(resolved(self.page, values["href"]))
        if tag == "code":
            self.code = []

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.handle_endtag(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag == "code" and self.code is not None:
            tags = {name for name, *_ in self.open}
            text = "".join(self.code)
            self.found.codes.append(Code(text, bool(tags & {"a", "summary"}), "pre" in tags))
            self.code = None
        while tag in [name for name, *_ in self.open]:
            name, _, identifier, start = self.open.pop()
            if identifier in self.found.ids and self.found.ids[identifier][0] == start:
                self.found.ids[identifier] = (start, self.size)
            if name == tag:
                break

    def handle_data(self, data: str) -> None:
        if self.inside:
            self.parts.append(data)
            self.size += len(data)
            if self.code is not None:
                self.code.append(data)


def resolved(page: str, link: str) -> str:
    """The address of a link, from the root of the site."""
    path, mark, part = link.partition("#")
    if not path:
        return f"{page}{mark}{part}"
    return f"{posixpath.normpath(posixpath.join(posixpath.dirname(page), path))}{mark}{part}"


@cache
def content(page: str) -> Content:
    reader = Reader(page)
    reader.feed((SITE / page).read_text(encoding="utf-8"))
    reader.close()
    reader.found.text = "".join(reader.parts)
    return reader.found


def words(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def section(address: str) -> str:
    """The text of the element that an address names; without an element, the text of the whole
    page."""
    page, _, part = address.partition("#")
    found = content(page)
    start, end = found.ids[part] if part else (0, len(found.text))
    return words(found.text[start:end])


def searched() -> list[list[str]]:
    """Returns the entries of the search: group, key, title, text, address and more words."""
    script = (SITE / "_static" / "search_index.js").read_text(encoding="utf-8")
    entries: list[list[str]] = json.loads(script.partition("=")[2].rstrip().rstrip(";"))["entries"]
    return entries


@cache
def clicks() -> dict[str, int]:
    """Address -> number of clicks from the first page. A page contributes all its ids.

    A way through a listing of code does not count.
    """
    found = {FIRST: 0}
    read = {FIRST}
    pending = [FIRST]
    while pending:
        page = pending.pop(0)
        for link in content(page).links:
            target = link.partition("#")[0]
            if link not in found:
                found[link] = found[page] + 1
            if target.endswith(".html") and target not in read and (SITE / target).exists():
                found.setdefault(target, found[page] + 1)
                read.add(target)
                if not LISTING.fullmatch(target):
                    pending.append(target)
    return found
