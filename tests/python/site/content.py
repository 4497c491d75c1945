"""Reads the pages of the built site in the same way as a reader who follows only the links of the
content."""

from __future__ import annotations

import json
import posixpath
import re
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from lxml.html import HtmlElement, HTMLParser, fromstring

SITE = Path(__file__).parents[3] / "build" / "site"
FIRST = "index.html"
LISTING = re.compile(r"source/.+\.\w+\.html")  # pages of source files
# Classes of elements for navigation: the side navigation, the path to the page, and the search.
NAVIGATION = re.compile(r"\b(search|crumbs|side|skip)\b")


@dataclass
class Code:
    """The text of an element ``code``. The element can be in a link or in a listing."""

    text: str
    linked: bool
    listing: bool


@dataclass
class Content:
    """The links, the ids and the text of the content of a page."""

    links: list[str] = field(default_factory=list)
    # id -> begin and end of the text of the element with this id
    ids: dict[str, tuple[int, int]] = field(default_factory=dict)
    codes: list[Code] = field(default_factory=list)
    text: str = ""


class Reader:
    """A reader of the element ``main`` of a page. The reader leaves out the navigation."""

    def __init__(self, page: str) -> None:
        self.page = page
        self.found = Content()
        self.parts: list[str] = []
        self.size = 0

    def read(self, element: HtmlElement, linked: bool = False, listing: bool = False) -> None:
        """Reads an element. ``linked`` and ``listing`` state whether the element is in a link or in
        a listing."""
        tag = element.tag
        if tag == "nav" or NAVIGATION.search(element.get("class", "")):
            return
        identifier = element.get("id")
        start, first = self.size, len(self.parts)
        new = identifier is not None and identifier not in self.found.ids
        if tag == "a" and (address := element.get("href")):
            self.found.links.append(resolved(self.page, address))
        self.add(element.text)
        inner = (linked or tag in ("a", "summary"), listing or tag == "pre")
        if new:
            self.found.ids[identifier] = (start, start)
        for child in element:
            if isinstance(child.tag, str):
                self.read(child, *inner)
            self.add(child.tail)
        if new:
            self.found.ids[identifier] = (start, self.size)
        if tag == "code":
            self.found.codes.append(Code("".join(self.parts[first:]), *inner))

    def add(self, text: str | None) -> None:
        if text:
            self.parts.append(text)
            self.size += len(text)


def resolved(page: str, link: str) -> str:
    """Returns the address of a link. The address is relative to the root of the site."""
    path, mark, part = link.partition("#")
    if not path:
        return f"{page}{mark}{part}"
    return f"{posixpath.normpath(posixpath.join(posixpath.dirname(page), path))}{mark}{part}"


@cache
def content(page: str) -> Content:
    reader = Reader(page)
    document = fromstring((SITE / page).read_bytes(), parser=HTMLParser(encoding="utf-8"))
    for main in document.iter("main"):
        reader.read(main)
    reader.found.text = "".join(reader.parts)
    return reader.found


def words(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def section(address: str) -> str:
    """Returns the text of the element to which an address leads. If the address leads only to a
    page, returns the text of the page."""
    page, _, part = address.partition("#")
    found = content(page)
    start, end = found.ids[part] if part else (0, len(found.text))
    return words(found.text[start:end])


def searched() -> list[list[str]]:
    """Returns the entries of the search. Each entry has a group, a key, a title, a text, an address
    and further words."""
    script = (SITE / "_static" / "search_index.js").read_text(encoding="utf-8")
    entries: list[list[str]] = json.loads(script.partition("=")[2].rstrip().rstrip(";"))["entries"]
    return entries


@cache
def clicks() -> dict[str, int]:
    """Returns the number of clicks from the first page to each page, and to the address of each
    link. Leaves out the links on the pages of source code.
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
