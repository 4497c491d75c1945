"""The book. It contains all pages in their order, and its links lead only to pages of the book. Two
books of the same pages have the same bytes."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from lxml.html import fromstring

from tools import book
from tools.book import PAGES, book_text, print_book, with_date, with_own_numbers
from tools.browser import find_browser
from tools.steps import MissingError

LINKS = (
    '<a href="docs/protocol.html#frames">frames</a> <a href="modules/PiRegulator.html">module</a> '
    '<a href="#own">own</a> <img src="diagrams/one.svg"> <details><summary>all</summary></details>'
    '<button type="button">Copy</button>'
)
pytestmark = pytest.mark.reads("site/templates/book.html", "site/templates/book.css")
needs_browser = pytest.mark.skipif(find_browser() is None, reason="there is no browser")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Returns a project whose portal has all pages of the book. Each page has a title."""
    site = tmp_path / "build/site"
    for page in [*PAGES, "index"]:
        path = site / f"{page}.html"
        path.parent.mkdir(parents=True, exist_ok=True)
        text = LINKS if page == "architecture" else "<p>text</p>"
        path.write_text(f'<main id="main"><h1>About {page}</h1><p id="own">{text}</p></main>')
    return tmp_path


def test_a_page_of_the_book_is_open_and_leads_nowhere_else(project: Path) -> None:
    book = fromstring(book_text(project / "build/site", "0123456789abcdef", 0))
    assert "1970-01-01, commit 0123456789" in {text.strip() for text in book.itertext()}
    (page,) = (p for p in book.iter("p") if p.find("details") is not None)
    links = [(link.get("href"), link.text_content()) for link in page.iter("a")]
    assert links == [
        ("#docs-protocol--frames", "frames"),
        (None, "module"),
        ("#architecture--own", "own"),
    ]
    assert [image.get("src") for image in page.iter("img")] == ["../site/diagrams/one.svg"]
    assert ["open" in details.attrib for details in page.iter("details")] == [True]
    assert not list(book.iter("button"))
    titles = [title.text_content() for title in book.iter("h1")]
    assert [title.removeprefix("About ") for title in titles if title.startswith("About")] == PAGES


def test_each_link_of_the_book_has_its_target(project: Path) -> None:
    book = fromstring(book_text(project / "build/site", "", 0))
    targets = {f"#{name}" for name in book.xpath("//@id")}
    wanted = set(book.xpath("//a/@href")) - {"#docs-protocol--frames"}
    assert wanted <= targets


def test_a_missing_page_is_named(project: Path) -> None:
    (project / "build/site/proofs.html").unlink()
    with pytest.raises(MissingError, match="the page proofs is missing; build the portal first"):
        print_book(project, project / "book.pdf")


def test_without_a_browser_the_message_names_the_package(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(book, "find_browser", lambda: None)
    with pytest.raises(MissingError, match="package is chromium"):
        print_book(project, project / "book.pdf")


def test_the_time_of_printing_is_replaced_in_its_place() -> None:
    text = with_date(b"/CreationDate (D:20260102030405+00'00') /Other (D:x)", 0)
    assert text == b"/CreationDate (D:19700101000000+00'00') /Other (D:x)"


@needs_browser
def test_two_books_of_the_same_pages_are_equal(project: Path) -> None:
    subprocess.run(["git", "init", "-q", project], check=True)
    first = print_book(project, project / "first.pdf").read_bytes()
    second = print_book(project, project / "second.pdf").read_bytes()
    assert first.startswith(b"%PDF")
    assert first == second


def test_the_numbers_of_the_browser_do_not_matter() -> None:
    one = with_own_numbers(b"/ID (node00000243) /Headers [(node00000250) (node00000243)]")
    assert one == with_own_numbers(b"/ID (node00000244) /Headers [(node00000251) (node00000244)]")
    assert one == b"/ID (node00000000) /Headers [(node00000001) (node00000000)]"
