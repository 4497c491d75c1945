"""Reads the headings and the text of pages for the search index."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from lxml.html import HtmlElement, fromstring

HEADS = {"h1", "h2", "h3"}
APART = {"nav", "svg", "script", "select", "summary"}  # HTML elements whose text is not read
INLINE = {"a", "b", "code", "em", "strong", "sub", "wbr"}  # these elements do not separate words
# CSS classes of elements that do not separate words: a number has no class, "mm" is the class of a
# method name, and "dc" is the class of its colons.
INLINE_SPANS = (None, "mm", "dc")


@dataclass
class Part:
    """A section of a page. The text before the first section is a part with an empty anchor."""

    anchor: str
    heading: list[str] = field(default_factory=list)
    words: list[str] = field(default_factory=list)

    @property
    def title(self) -> str:
        return joined(self.heading)

    @property
    def text(self) -> str:
        return joined(self.words)


def parts_of(page: str) -> Iterator[Part]:
    """Returns the sections of a page, if they have a heading. The page is a body without the
    layout, or a finished page. If the page is finished, only its element ``main`` is read."""
    root = fromstring(page if "<main" in page else f"<main>{page}</main>")
    parts = [Part("")]
    for main in root.iter("main"):
        _read(main, parts, parts[0], parts[0].words)
    return (part for part in parts if part.title)


def _read(element: HtmlElement, parts: list[Part], part: Part, texts: list[str]) -> None:
    """Adds the text of an element to ``texts``, and its sections to ``parts``. ``texts`` is the
    heading or the words of ``part``."""
    if is_apart(element):
        return
    if element.tag == "section" and (anchor := element.get("id")):
        part = Part(anchor)
        parts.append(part)
        texts = part.words
    if element.tag in HEADS and not part.heading:
        texts = part.heading
    elif element.tag == "span" and not is_inline(element):
        texts = part.words  # a note in a heading is no part of the title
    space = "" if is_inline(element) else " "
    texts += [space, element.text or ""]
    for child in element:
        _read(child, parts, part, texts)
        texts.append(child.tail or "")
    texts.append(space)


def is_apart(element: HtmlElement) -> bool:
    """Returns true if the text of an element is skipped, such as a comment, a picture, a
    decoration, or the link of a heading to itself."""
    return (
        not isinstance(element.tag, str)
        or element.tag in APART
        or element.get("aria-hidden") == "true"
        or element.get("class") == "headerlink"
    )


def is_inline(element: HtmlElement) -> bool:
    """Returns true if an element does not separate words. Such an element is a number, or it is a
    part of a name, a link or a listing."""
    if element.tag == "span":
        above = element.getparent().tag
        return element.get("class") in INLINE_SPANS or above in INLINE or above == "pre"
    return element.tag in INLINE


def joined(texts: list[str]) -> str:
    return " ".join("".join(texts).split())
