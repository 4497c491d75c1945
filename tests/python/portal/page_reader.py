"""Reads the headings, the links, the cells of tables, and the text of a page."""

from __future__ import annotations

from dataclasses import dataclass, field
from html.parser import HTMLParser


@dataclass
class Shown:
    """The content of a page. Several white spaces count as one blank."""

    parts: list[str] = field(default_factory=list)
    headings: list[str] = field(default_factory=list)
    links: dict[str, str] = field(default_factory=dict)  # address -> text of the last link to it
    rows: list[list[str]] = field(default_factory=list)

    @property
    def text(self) -> str:
        return " ".join("".join(self.parts).split())


class Reader(HTMLParser):
    """A reader of a page. The text of a wanted element is stored when the element ends."""

    WANTED = ("h1", "h2", "h3", "a", "td")

    def __init__(self) -> None:
        super().__init__()
        self.shown = Shown()
        self.starts: dict[str, int] = {}
        self.address = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "tr":
            self.shown.rows.append([])
        if tag in self.WANTED:
            self.starts[tag] = len(self.shown.parts)
        if tag == "a":
            values = dict(attrs)
            self.address = values.get("href") or values.get("xlink:href") or ""

    def handle_endtag(self, tag: str) -> None:
        if tag not in self.WANTED or tag not in self.starts:
            return
        text = " ".join("".join(self.shown.parts[self.starts[tag] :]).split())
        if tag == "a":
            self.shown.links[self.address] = text
        elif tag == "td":
            self.shown.rows[-1].append(text)
        else:
            self.shown.headings.append(text)

    def handle_data(self, data: str) -> None:
        self.shown.parts.append(data)


def read_page(html: str) -> Shown:
    reader = Reader()
    reader.feed(html)
    reader.close()
    return reader.shown
