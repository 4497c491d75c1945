"""Selected pages of the built site are accessible and do not scroll sideways. In a window with a
width of 1024 pixels, such a page is at most twice as tall as in a window with a width of 1440
pixels."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest

from tests.python.site.browser import AXE, BROWSER, look, needs_browser
from tests.python.site.content import SITE
from traceability.whole_file import write_whole

# At least one page of each kind.
PAGES = [
    "index", "answers/index", "answers/is-rc-a-state-or-a-decorator",
    "answers/how-do-i-write-a-test-and-link-it-to-a-requirement", "architecture", "structure",
    "patterns/index", "patterns/reading-modes", "machines", "changes", "changes/reading-modes",
    "secrets", "guide", "interfaces", "inheritances", "products", "datatypes", "uses",
    "concordance", "usual_design", "execution", "requirements/index", "requirements/FR-15",
    "safety/index", "safety/SG-2", "safety/hazards", "safety/cost", "trees", "tests", "mutation",
    "robustness",
    "reverse", "closed_loop", "bench", "virtual_k64", "beliefs", "evidence", "checks/index",
    "checks/drift", "checks/uses-allowed", "docs/quick_start", "docs/protocol", "docs/bring_up",
    "docs/glossary", "source/index", "source/src/main_control/operation_modes/RC.cpp", "exports",
    "modules/RC", "modules/MainController", "plot",
]  # fmt: skip
# The pages that axe checks. Together they contain all kinds of elements.
LOOKED_AT = [
    "index", "answers/index", "answers/is-rc-a-state-or-a-decorator", "architecture", "structure",
    "patterns/index", "patterns/reading-modes", "machines", "changes/reading-modes", "products",
    "execution", "requirements/FR-15", "requirements/FR-37", "safety/SG-2", "closed_loop", "bench",
    "checks/uses-allowed", "docs/quick_start", "docs/bring_up", "modules/RC", "uses", "trees",
    "plot", "usual_design", "mutation", "secrets",
]  # fmt: skip
WIDTHS = (320, 390, 600, 768, 821, 900, 1024, 1280, 1920)
ROWS = 12
AXE_WIDTHS = (390, 768, 1024)  # At a width of 1440, all rules are checked.
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
# Some rules depend on the width, and some on the theme. The other rules are checked only once.
BY_WIDTH = ["target-size", "scrollable-region-focusable"]
BY_THEME = ["color-contrast", "link-in-text-block"]
THEME = Path(__file__).parents[3] / "site" / "theme"

MEASURE = """
const found = {};
for (const width of %WIDTHS%) {
  frame.style.width = `${width}px`;
  found[width] = [doc.documentElement.scrollWidth, doc.documentElement.scrollHeight];
}
return found;
"""
RUN_AXE = """
const script = doc.createElement("script");
script.src = "/axe.js";
await new Promise((done) => { script.onload = done; doc.head.append(script); });
const found = [];
// The rows of a table or list have the same kinds of elements. axe checks the first rows.
for (const list of doc.querySelectorAll("tbody, ul, ol, dl, details, .boxes, svg g"))
  for (const one of [...list.children].slice(%ROWS%)) one.remove();
async function run(width, theme, runOnly) {
  frame.style.width = `${width}px`;
  doc.documentElement.dataset.theme = theme;
  // A browser without a visible window does not send this event.
  view.dispatchEvent(new view.Event("resize"));
  const result = await view.axe.run(doc, { runOnly, resultTypes: ["violations"] });
  for (const { id, nodes } of result.violations)
    found.push(`${width} ${theme} ${id}: ${nodes.length} x ${nodes[0].target.join(" ")}`);
}
for (const width of %WIDTHS%) await run(width, "light", { type: "rule", values: %BY_WIDTH% });
await run(1440, "light", { type: "tag", values: %TAGS% });
await run(1440, "dark", { type: "rule", values: %BY_THEME% });
return found;
"""

KEYBOARD = """
const name = doc.querySelector("a.mod[data-m=RC]"), found = [];
name.matches = () => true;
name.focus();
name.dispatchEvent(new view.FocusEvent("focusin", { bubbles: true }));
const key = doc.querySelector(".card a");
found.push(Boolean(key));
key.focus();
found.push(doc.activeElement === key);
key.dispatchEvent(new view.KeyboardEvent("keydown", { key: "Escape", bubbles: true }));
found.push(doc.activeElement === name, !doc.querySelector(".card"));
doc.querySelector(".skip").click();
await until(() => doc.activeElement.id);
found.push(doc.activeElement.id);
return found;
"""

pytestmark = [pytest.mark.browser, needs_browser]


class Looked:
    """The results of probes on pages, from this run and from the previous run.

    A page is opened only if its file, the theme, the probe, axe or the browser has changed.
    """

    def __init__(self) -> None:
        self._file = SITE.with_name("looked.json")
        self._before = json.loads(self._file.read_text()) if self._file.exists() else {}
        self._now: dict[str, Any] = {}
        version = subprocess.run([BROWSER, "--version"], capture_output=True, check=True).stdout
        parts = [version, *(file.read_bytes() for file in (AXE, *files_in(THEME)))]
        self._common = sha256(b"".join(parts)).hexdigest()

    def look(self, pages: list[str], probe: str, browsers: int = 1) -> dict[str, Any]:
        """Returns the result of the probe for each page."""
        keys = {page: self._key(page, probe) for page in pages}
        known = {page: self._before[key] for page, key in keys.items() if key in self._before}
        changed = [page for page in pages if page not in known]
        with ThreadPoolExecutor(browsers) as pool:
            parts = [
                pool.submit(look, SITE, share, probe)
                for number in range(browsers)
                if (share := changed[number::browsers])
            ]
        found = known | {page: one for part in parts for page, one in part.result()[0].items()}
        self._now |= {keys[page]: one for page, one in found.items()}
        return found

    def write(self) -> None:
        write_whole(self._file, json.dumps(self._now))

    def _key(self, page: str, probe: str) -> str:
        content = (SITE / f"{page}.html").read_bytes()
        return sha256(b"".join([self._common.encode(), probe.encode(), content])).hexdigest()


def files_in(folder: Path) -> list[Path]:
    return sorted(file for file in folder.rglob("*") if file.is_file())


@pytest.fixture(scope="module")
def looked() -> Iterator[Looked]:
    looked = Looked()
    yield looked
    looked.write()


@pytest.fixture(scope="module")
def sizes(looked: Looked) -> dict[str, dict[str, list[int]]]:
    """Returns the width and the height of each page, for each width of the window."""
    return looked.look(PAGES, MEASURE.replace("%WIDTHS%", json.dumps([*WIDTHS, 1440])))


def test_no_page_scrolls_sideways(sizes: dict[str, dict[str, list[int]]]) -> None:
    wide = {
        f"{page} at {width}": found[str(width)][0] - width
        for page, found in sizes.items()
        for width in WIDTHS
        if found[str(width)][0] > width
    }
    assert wide == {}


def test_no_page_is_twice_as_tall_in_a_narrower_window(
    sizes: dict[str, dict[str, list[int]]],
) -> None:
    tall = {
        page: (found["1024"][1], found["1440"][1])
        for page, found in sizes.items()
        if found["1024"][1] > 2 * found["1440"][1]
    }
    assert tall == {}


@pytest.fixture(scope="module")
def violations(looked: Looked) -> dict[str, list[str]]:
    """Returns the findings of axe for each page."""
    values = {
        "ROWS": ROWS,
        "WIDTHS": AXE_WIDTHS,
        "TAGS": TAGS,
        "BY_WIDTH": BY_WIDTH,
        "BY_THEME": BY_THEME,
    }
    probe = RUN_AXE
    for name, value in values.items():
        probe = probe.replace(f"%{name}%", json.dumps(value))
    return looked.look(LOOKED_AT, probe, browsers=2)


def test_pages_are_accessible(
    violations: dict[str, list[str]], record_property: Callable[[str, object], None]
) -> None:
    record_property("portal.axe_violations", sum(map(len, violations.values())))
    assert {page: found for page, found in violations.items() if found} == {}


def test_escape_gives_the_focus_back_and_every_stop_is_seen() -> None:
    """The focus moves from the name of a module into the card of this module, and back. The skip
    link leads into the content."""
    seen, errors = look(SITE, ["patterns/reading-modes"], KEYBOARD)
    assert seen["patterns/reading-modes"] == [True, True, True, True, "main"]
    assert errors == []


def test_a_filter_is_kept_in_the_address_and_read_from_it() -> None:
    probe = (
        "const count = () => doc.querySelector('.tools .count').textContent;"
        "const field = doc.querySelector('[data-facet=level]'), first = count();"
        "field.value = 'system'; field.dispatchEvent(new view.Event('input'));"
        "return [first, count(), view.location.search];"
    )
    seen, errors = look(SITE, ["tests?module=RC"], probe)
    by_module, by_both, address = seen["tests?module=RC"]
    assert int(by_module.split()[0]) > int(by_both.split()[0]) > 0
    assert (address, errors) == ("?module=RC&level=system", [])


def test_a_tour_is_kept_from_page_to_page() -> None:
    probe = (
        "const start = doc.querySelector('[data-tour]');"
        "if (start) { start.addEventListener('click', (event) => event.preventDefault());"
        " start.click(); return view.localStorage.tour; }"
        "const found = doc.querySelector('.touring').textContent;"
        "doc.querySelector('.touring button').click();"
        "return [found.includes('1 of 7'), 'tour' in view.localStorage];"
    )
    seen, errors = look(SITE, ["tours/understand", "architecture"], probe)
    assert seen["tours/understand"] == '{"id":"understand","at":0}'
    assert (seen["architecture"], errors) == ([True, False], [])
