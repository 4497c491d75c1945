"""Reads the headings and the text of pages for the search index."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from lxml.html import HtmlElement, fromstring

HEADS = {"h1", "h2"}
APART = {"nav", "svg", "script", "select", "summary"}  # HTML elements whose text is not read
MOST = 4000  # greatest number of letters of a section in the index


@dataclass
class Part:
    """A section of a page. The text before the first section is a part with an empty anchor."""

    anchor: str
    title: str = ""
    words: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())[:MOST]

    def add(self, text: str | None, *, heading: bool) -> None:
        if not text or text.isspace():
            return
        if heading and not self.title:
            self.title = text.strip()
        else:
            self.words.append(text)


def parts_of(body: str) -> Iterator[Part]:
    """Returns the sections of a page that have a heading."""
    parts = [Part("")]
    _read(fromstring(f"<main>{body}</main>"), parts, parts[0], heading=False)
    return (part for part in parts if part.title)


def _read(element: HtmlElement, parts: list[Part], part: Part, *, heading: bool) -> None:
    if element.tag in APART or not isinstance(element.tag, str):  # a comment has no tag
        return
    if element.tag == "section" and (anchor := element.get("id")):
        part = Part(anchor)
        parts.append(part)
    heading = heading or element.tag in HEADS
    part.add(element.text, heading=heading)
    for child in element:
        _read(child, parts, part, heading=heading)
        part.add(child.tail, heading=heading)
