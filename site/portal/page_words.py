"""Reads the headings and the text of the generated pages for the search index."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"area", "br", "col", "hr", "img", "input", "link", "meta", "source", "wbr"}
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
        return re.sub(r"\s+", " ", " ".join(self.words)).strip()[:MOST]


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.parts = [Part("")]
        self.open: list[tuple[str, bool]] = []  # (open tag, true if the tag begins a section)
        self.inside = [self.parts[0]]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag in VOID:
            return
        anchor = dict(attrs).get("id") if tag == "section" else None
        self.open.append((tag, bool(anchor)))
        if anchor:
            self.parts.append(Part(anchor))
            self.inside.append(self.parts[-1])

    def handle_endtag(self, tag: str) -> None:
        while tag in [name for name, _ in self.open]:
            name, part = self.open.pop()
            if part:
                self.inside.pop()
            if name == tag:
                return

    def handle_data(self, data: str) -> None:
        tags = {tag for tag, _ in self.open}
        if tags & APART or not data.strip():
            return
        part = self.inside[-1]
        if tags & HEADS and not part.title:
            part.title = data.strip()
        else:
            part.words.append(data)


def parts_of(body: str) -> Iterator[Part]:
    """Returns the sections of a page that have a heading."""
    reader = _Reader()
    reader.feed(body)
    reader.close()
    return (part for part in reader.parts if part.title)
