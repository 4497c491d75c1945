"""./wr book: writes one PDF with the pages that explain the system, for printing."""

from __future__ import annotations

import argparse
import html
import posixpath
import re
import subprocess
import time
from pathlib import Path

from markupsafe import Markup

from portal.templates import environment
from tools.browser import find_browser
from tools.steps import FailureError, MissingError
from traceability.reading.build_evidence import git

SITE = Path("build/site")
PAGE, PDF = Path("build/book/book.html"), Path("build/book/weeding_robot.pdf")
SECONDS = 300  # time limit of the browser
# The parts of the book, and their pages in the order of reading.
PARTS = {
    "Design": (
        *("architecture", "structure", "patterns/index", "machines", "guide", "products"),
        *("execution", "uses", "concordance"),
    ),
    "Behaviour": (
        *("docs/execution_model", "docs/wheel_control", "docs/steering_control", "docs/protocol"),
        *("docs/plant", "docs/product_line", "docs/bluetooth"),
    ),
    "Requirements and safety": (
        *("requirements/index", "safety/index", "docs/hazards", "safety/cost"),
    ),
    "Evidence": (
        *("evidence", "proofs", "robustness", "closed_loop", "bench", "virtual_k64", "beliefs"),
    ),
    "Build and use": (
        *("docs/quick_start", "docs/bring_up", "docs/client", "docs/emulator", "docs/scenarios"),
        *("docs/debugging", "docs/other_tools", "docs/release", "docs/add_extension"),
        *("docs/annotations", "docs/how_these_pages_are_made", "docs/host_target"),
        "docs/glossary",
    ),
}
PAGES = [page for pages in PARTS.values() for page in pages]
MAIN = re.compile(r"<main\b[^>]*>(.*)</main>", re.DOTALL)
HEADING = re.compile(r"<h1[^>]*>(.*?)</h1>", re.DOTALL)
TAG = re.compile(r"<[^>]+>")
SCREEN_ONLY = re.compile(
    r"<script\b.*?</script>|<a class=\"headerlink\".*?</a>|<button\b.*?</button>", re.DOTALL
)
PLACE = re.compile(r'\b(id|href|src|aria-labelledby|aria-describedby)="([^"]*)"')
DATE = re.compile(rb"\(D:\d{14}[^)]*\)")  # date in a PDF: YYYYMMDDhhmmss and the time zone
NODE = re.compile(rb"\(node(\d{8})\)")


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "book",
        description=f"Writes one PDF with the pages that explain the system: {PDF}. Uses the pages "
        "from the last run of ./wr test --all or ./wr portal. The command needs Chromium.",
    )
    parser.set_defaults(run=lambda root, _options: book(root))


def book(root: Path) -> int:
    print(print_book(root, root / PDF))
    return 0


def print_book(root: Path, pdf: Path) -> Path:
    """Prints the PDF. Its bytes depend only on the pages, the commit and the browser."""
    need_pages(root / SITE)
    browser = find_browser()
    if browser is None:
        raise MissingError(
            "the book needs Chromium; install it (on Debian, the package is chromium)"
        )
    page = root / PAGE
    page.parent.mkdir(parents=True, exist_ok=True)
    commit, when = commit_of(root)
    page.write_text(book_text(root / SITE, commit, when), encoding="utf-8")
    words = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer"]
    words += ["--virtual-time-budget=20000", f"--print-to-pdf={pdf}", page.as_uri()]
    pdf.unlink(missing_ok=True)
    try:
        said = subprocess.run(
            words, capture_output=True, text=True, timeout=SECONDS, check=False
        ).stderr
    except subprocess.TimeoutExpired as error:
        raise FailureError(f"{browser} did not print the book within {SECONDS} s") from error
    if not pdf.exists():
        raise FailureError(f"{browser} printed no book: {said[-500:]}")
    pdf.write_bytes(with_own_numbers(with_date(pdf.read_bytes(), when)))
    return pdf


def commit_of(root: Path) -> tuple[str, int]:
    """Returns the commit and its time [s since 1970]. Without git, returns the time of the
    pages."""
    commit = git(root, "rev-parse", "HEAD").strip()
    if commit:
        return commit, int(git(root, "log", "-1", "--format=%ct"))
    return "", int((root / SITE / "index.html").stat().st_mtime)


def with_date(pdf: bytes, when: int) -> bytes:
    """Sets the dates in a PDF to the time ``when``. The length of the PDF does not change."""
    text = time.strftime("(D:%Y%m%d%H%M%S", time.gmtime(when)).encode()
    return DATE.sub(lambda match: text + match[0][len(text) :], pdf)


def with_own_numbers(pdf: bytes) -> bytes:
    """Numbers the nodes of the PDF from 0, because the browser begins with a different number each
    time."""
    number = {name: at for at, name in enumerate(sorted(set(NODE.findall(pdf))))}
    return NODE.sub(lambda match: b"(node%08d)" % number[match[1]], pdf)


def need_pages(site: Path) -> None:
    missing = [page for page in PAGES if not (site / f"{page}.html").exists()]
    if missing:
        raise MissingError(
            f"the page {missing[0]} is missing; build the portal first with ./wr portal"
        )


def book_text(site: Path, commit: str, when: int) -> str:
    return (
        environment()
        .get_template("book.html")
        .render(
            day=time.strftime("%Y-%m-%d", time.gmtime(when)),
            commit=commit[:10],
            parts={part: [chapter_of(site, page) for page in PARTS[part]] for part in PARTS},
        )
    )


def chapter_of(site: Path, page: str) -> dict[str, str]:
    """Returns the anchor, the title and the content of a page."""
    match = MAIN.search((site / f"{page}.html").read_text(encoding="utf-8"))
    assert match, page
    text = SCREEN_ONLY.sub("", match[1])
    heading = HEADING.search(text)
    title = html.unescape(TAG.sub("", heading[1])).strip() if heading else "Untitled"
    return {"id": name_of(page), "title": title, "text": Markup(chapter(page, text))}


def name_of(page: str) -> str:
    return page.replace("/", "-")


def chapter(page: str, text: str) -> str:
    """Returns the content of a page for printing. Collapsed sections are expanded, and links lead
    to places in the book."""

    def place(match: re.Match[str]) -> str:
        kind, value = match[1], match[2]
        if kind == "id":
            return f'id="{name_of(page)}--{value}"'
        if kind == "src":
            return match[0] if value.startswith("data:") else f'src="{beside(page, value)}"'
        if kind == "href":
            target = inside(page, value)
            return f'href="{target}"' if target else ""
        names = " ".join(f"{name_of(page)}--{part}" for part in value.split())
        return f'{kind}="{names}"'

    return PLACE.sub(place, text.replace("<details", "<details open"))


def beside(page: str, address: str) -> str:
    """Returns the address of a file to which a page refers. The address is relative to the folder
    of the book."""
    return f"../site/{posixpath.normpath(posixpath.join(posixpath.dirname(page), address))}"


def inside(page: str, address: str) -> str:
    """Returns the address for a link of a page. A link to another website keeps its address. Any
    other link gets an address in the book. This address is empty if the book does not contain the
    target."""
    if address.startswith(("http:", "https:")):
        return address
    file, _, anchor = address.partition("#")
    target = page
    if file:
        joined = posixpath.normpath(posixpath.join(posixpath.dirname(page), file))
        target = joined.removesuffix(".html")
    if target not in PAGES:
        return ""
    return f"#{name_of(target)}--{anchor}" if anchor else f"#{name_of(target)}"
