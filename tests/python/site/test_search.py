"""The search of the built site finds each page except the sheets of the dossier. For most of the
tested searches, the first hit is the expected page."""

from __future__ import annotations

import html
import json
import re
import subprocess
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from portal.search import listed
from tests.python.site.browser import BROWSER, needs_browser
from tests.python.site.content import SITE, content, searched


def searches(name: str) -> dict[str, list[str]]:
    """Returns the expected addresses of each query in a file."""
    text = Path(__file__).with_name(name).read_text(encoding="utf-8")
    return {
        query: [expected] if isinstance(expected, str) else expected
        for query, expected in tomllib.loads(text).items()
    }


SEARCHES = searches("searches.toml")
UNSEEN = searches("searches_unseen.toml")
LEAST = 0.9  # minimum share of searches whose first hit is the expected page
SCREEN = 12  # number of rows that the list shows without scrolling
SIZE = 5  # number of rows of a group that are shown at first
SCRIPTS = ("minisearch", "search_index", "search")
# The pages are opened without a server. A reader can open the portal from a folder in the same way.
PROBE = """<!doctype html><meta charset="utf-8"><pre id="out"></pre>
%SCRIPTS%
<script>
const groups = (text) => [...PortalSearch.grouped(text).values()];
const shown = (text) => groups(text).flatMap((hits) => hits.slice(0, %SIZE%));
const address = (hit) => PORTAL_SEARCH.entries[hit.id][4];
const found = %SEARCHES%.map((text) => shown(text).slice(0, %SCREEN%).map(address));
document.getElementById("out").textContent = JSON.stringify(found);
</script>"""


def exists(address: str) -> bool:
    page, _, part = address.partition("#")
    return (SITE / page).is_file() and (not part or part in content(page).ids)


def test_each_entry_leads_to_a_place() -> None:
    assert [entry[4] for entry in searched() if not exists(entry[4])] == []


def test_each_page_is_found() -> None:
    found = {entry[4].partition("#")[0] for entry in searched()}
    pages = {str(path.relative_to(SITE)) for path in SITE.rglob("*.html")}
    # A sheet of the dossier has the same content as the page of its requirement.
    apart = "dossier/"
    assert {page for page in pages - found if not page.startswith(apart)} == set()


def test_words_of_hand_written_pages_and_of_the_paper_are_found() -> None:
    written = [entry for entry in searched() if entry[0] == "Explanations"]
    assert ["Debug", "Flash and wire the board"] in [entry[2:4] for entry in written]
    assert any("baud rate of the connected device" in entry[5] for entry in written)
    assert {"Figure 6", "WaitingMAX"} <= {e[2] for e in searched() if e[0] == "Paper"}


def test_headings_of_generated_pages_are_found() -> None:
    sections = {tuple(entry[2:5]) for entry in searched() if entry[0] == "Sections"}
    assert ("Stack", "Execution", "execution.html#stack") in sections
    assert len(sections) > 60


def test_words_that_readers_type_belong_to_an_entry() -> None:
    addresses = {entry[4] for entry in searched()}
    words = listed("search_words.txt", " = ")
    assert words
    assert [address for address, _ in words if address not in addresses] == []
    assert len({address for address, _ in words}) == len(words)


def test_each_expected_hit_is_a_place() -> None:
    files = (SEARCHES, UNSEEN)
    expected = {address for file in files for addresses in file.values() for address in addresses}
    places = {address for address in expected if not address.endswith("*")}
    assert sorted(address for address in places if not exists(address)) == []


@pytest.mark.browser
@needs_browser
def test_each_search_shows_the_answer_on_the_first_screen(
    tmp_path: Path, record_property: Callable[[str, object], None]
) -> None:
    found = asked(tmp_path, list(SEARCHES))
    absent = {text: found[text][:3] for text in SEARCHES if not expects(text, found[text])}
    first = [text for text in SEARCHES if expects(text, found[text][:1])]
    share = len(first) / len(SEARCHES)
    others = {text: found[text][:1] for text in SEARCHES if text not in first}
    print(f"first hit as expected: {share:.0%} of {len(SEARCHES)} searches; others: {others}")
    record_property("portal.search_first_hit", round(share, 3))
    assert absent == {}
    assert share >= LEAST, others


@pytest.mark.browser
@needs_browser
def test_the_share_of_right_first_hits_of_unseen_searches_is_measured(
    tmp_path: Path, record_property: Callable[[str, object], None]
) -> None:
    found = asked(tmp_path, list(UNSEEN))
    first = [text for text in UNSEEN if expects(text, found[text][:1], UNSEEN)]
    record_property("portal.search_unseen_first_hit", round(len(first) / len(UNSEEN), 3))


def expects(text: str, addresses: list[str], file: dict[str, list[str]] = SEARCHES) -> bool:
    """Returns whether a query expects one of the addresses."""
    return any(
        address.startswith(expected[:-1]) if expected.endswith("*") else address == expected
        for expected in file[text]
        for address in addresses
    )


def asked(folder: Path, texts: list[str]) -> dict[str, list[str]]:
    """Returns the addresses of the hits on the first screen: text -> addresses."""
    scripts = (f'<script src="{SITE.as_uri()}/_static/{name}.js"></script>' for name in SCRIPTS)
    values = {"SCRIPTS": "".join(scripts), "SEARCHES": json.dumps(texts)}
    page = PROBE
    for name, value in (values | {"SIZE": str(SIZE), "SCREEN": str(SCREEN)}).items():
        page = page.replace(f"%{name}%", value)
    probe = folder / "probe.html"
    probe.write_text(page, encoding="utf-8")
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"]
    command = [BROWSER, *options, "--virtual-time-budget=60000", probe.as_uri()]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    match = re.search(r'<pre id="out">(.+?)</pre>', run.stdout, re.DOTALL)
    assert match, f"the probe did not end: {run.stderr[-2000:]}"
    return dict(zip(texts, json.loads(html.unescape(match[1])), strict=True))
