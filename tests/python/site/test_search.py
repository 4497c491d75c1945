"""The search of the built site: each page is found, and the first hit is the expected one."""

from __future__ import annotations

import html
import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from tests.python.site.content import SITE, content, searched

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), ""
)
SEARCHES: dict[str, str] = tomllib.loads(
    Path(__file__).with_name("searches.toml").read_text(encoding="utf-8")
)
LEAST = 0.85  # share of the searches whose first hit is the expected one
# Opened without a server, as a reader opens the portal from a folder.
PROBE = """<!doctype html><meta charset="utf-8"><pre id="out"></pre>
%SCRIPTS%
<script>
const first = (text) => [...PortalSearch.grouped(text).values()].flat().slice(0, 1);
const found = %SEARCHES%.map((text) => first(text).map((hit) => PORTAL.entries[hit.id][4])[0]);
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
    assert pages - found - {"probe.html"} == set()


def test_words_of_hand_written_pages_and_of_the_paper_are_found() -> None:
    written = [entry for entry in searched() if entry[0] == "Explanations"]
    assert ["Debug", "Flash and wire the board"] in [entry[2:4] for entry in written]
    assert any("baud rate of the far end" in entry[5] for entry in written)
    assert {"Figure 6", "WaitingMAX"} <= {e[2] for e in searched() if e[0] == "Paper"}


def test_each_expected_hit_is_a_place() -> None:
    assert [address for address in SEARCHES.values() if not exists(address)] == []


@pytest.mark.browser
@pytest.mark.skipif(not BROWSER, reason="there is no browser on this machine")
def test_the_first_hit_is_the_expected_one(tmp_path: Path) -> None:
    names = ("portal", "minisearch", "search")
    scripts = "".join(
        f'<script src="{SITE.as_uri()}/_static/{name}.js"></script>' for name in names
    )
    probe = tmp_path / "probe.html"
    asked = PROBE.replace("%SEARCHES%", json.dumps(list(SEARCHES))).replace("%SCRIPTS%", scripts)
    probe.write_text(asked, encoding="utf-8")
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"]
    command = [BROWSER, *options, "--virtual-time-budget=60000", probe.as_uri()]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    match = re.search(r'<pre id="out">(.+?)</pre>', run.stdout, re.DOTALL)
    assert match, f"the probe did not end: {run.stderr[-2000:]}"
    found = json.loads(html.unescape(match[1]))
    missed = [one for one in zip(SEARCHES.items(), found, strict=True) if one[0][1] != one[1]]
    share = 1 - len(missed) / len(SEARCHES)
    print(f"first hit as expected: {share:.0%} of {len(SEARCHES)} searches; others: {missed}")
    assert share >= LEAST, missed
