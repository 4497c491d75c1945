"""In a browser, the pages of a small project have no error. Their search, theme, cards and diagrams
work."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from portal import site_build
from tests.python.portal.fixture import MODES, REPORT, make_project
from tests.python.site.browser import look, needs_browser
from traceability.checks.registry import Check

PAGES = [
    "index", "structure", "guide", "interfaces", "datatypes", "machines", "uses", "trees", "tests",
    "architecture", "modules/RC", "modules/MainController", "patterns/index",
    "patterns/reading-modes", "requirements/index", "requirements/FR-15", "checks/index",
    "checks/tree-static", "changes", "changes/reading-modes", "secrets", "inheritances",
    "concordance", "virtual_k64", "beliefs", "closed_loop", "products", "source/index",
    f"source/src/{MODES}/RC.cpp", "docs/tour", "run", "plot",
]  # fmt: skip

pytestmark = [pytest.mark.browser, needs_browser]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("project")
    checks = [Check("tree-static", "Calls are possible", "Each edge is one.", "runs.", "call it.")]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(site_build, "CHECKS", checks)
        site_build.build_site(root, make_project(root), REPORT)
    return root / "build" / "site"


def test_pages_open_without_an_error(site: Path) -> None:
    seen, errors = look(site, PAGES, "return [doc.title, doc.querySelectorAll('h1').length];")
    assert errors == []
    assert seen.keys() == set(PAGES)
    assert {name: heads for name, (_, heads) in seen.items() if heads != 1} == {}
    assert all(title.endswith("Weeding robot") for title, _ in seen.values())


# A page and the words that are typed into its search -> address of the first hit. The words are in
# any order, and some have typing errors.
SEARCHES = {
    "modules/RC?q=FR-15": "../requirements/FR-15.html",
    "index?q=mode": "modules/Mode.html",
    "index?q=fr15": "requirements/FR-15.html",
    "index?q=fr 15": "requirements/FR-15.html",
    "index?q=controller main": "modules/MainController.html",
    "index?q=maincontroller": "modules/MainController.html",
    "index?q=mian controler": "modules/MainController.html",
    "index?q=read rc": "modules/RC.html#m-read",
}


def test_the_search_takes_words_in_any_order_and_with_typing_errors(
    site: Path,
) -> None:
    probe = "return doc.querySelector('.hits a').getAttribute('href');"
    assert look(site, list(SEARCHES), probe) == (SEARCHES, [])


def test_the_search_is_used_from_the_keyboard(site: Path) -> None:
    probe = (
        "const field = doc.querySelector('#q'), hits = doc.querySelector('#hits'), found = [];"
        "const press = (target, key, more) => target.dispatchEvent(new view.KeyboardEvent("
        "'keydown', {key, bubbles: true, cancelable: true, ...more}));"
        "const inField = () => doc.activeElement === field;"
        "press(doc.body, '/'); found.push(inField());"
        "press(doc.body, 'k', {ctrlKey: true}); found.push(inField());"
        "const chosen = () => doc.querySelector('.hits [aria-selected=true]').id;"
        "found.push(chosen()); press(field, 'ArrowDown'); found.push(chosen());"
        "found.push(doc.querySelector('.preview .t').textContent !== '');"
        "press(field, 'Escape'); found.push(inField(), hits.hidden);"
        "field.dispatchEvent(new view.Event('input')); hits.hidden = false; field.blur();"
        "found.push(hits.hidden); return found;"
    )
    seen, _ = look(site, ["modules/RC?q=read"], probe)
    assert seen["modules/RC?q=read"] == [True, True, "hit0", "hit1", True, True, True, True]


def test_the_theme_button_changes_the_colours(site: Path) -> None:
    probe = (
        "const ground = () => view.getComputedStyle(doc.body).backgroundColor, found = [];"
        "const button = doc.querySelector('.theme');"
        "for (let i = 0; i < 3; i += 1) { button.click();"
        " found.push([doc.documentElement.dataset.theme || 'auto', ground()]); }"
        "return found;"
    )
    seen, _ = look(site, ["index"], probe)
    grounds = dict(seen["index"])
    assert grounds.keys() == {"auto", "light", "dark"}
    assert grounds["light"] != grounds["dark"]


def test_a_letter_on_a_name_opens_that_view(site: Path) -> None:
    probe = (
        "const name = doc.querySelector('a.mod[data-m=RC]'); name.focus();"
        "const key = (k) => name.dispatchEvent("
        "new view.KeyboardEvent('keydown', {key: k, bubbles: true, cancelable: true}));"
        "return [key('t'), key('x')];"
    )
    seen, _ = look(site, ["patterns/reading-modes"], probe)
    assert seen["patterns/reading-modes"] == [False, True]


def test_a_card_shows_the_secret(site: Path) -> None:
    probe = (
        "const name = doc.querySelector('a.mod[data-m=RC]');"
        "name.matches = () => true; name.focus();"
        "name.dispatchEvent(new view.FocusEvent('focusin', {bubbles: true}));"
        "const card = doc.querySelector('.card'); return card && card.textContent;"
    )
    seen, _ = look(site, ["patterns/reading-modes"], probe)
    assert "The secret of RC" in (seen["patterns/reading-modes"] or "")


def test_pages_ask_no_other_server(site: Path) -> None:
    outside = re.compile(r'(?:src|href)="(?:https?:)?//')
    found = [
        path.name
        for path in site.rglob("*.html")
        if outside.search(path.read_text(encoding="utf-8"))
    ]
    assert found == []


def test_a_wide_diagram_fits_a_narrow_window_and_is_enlarged_in_a_window(
    site: Path,
) -> None:
    probe = (
        "const place = await until(() => doc.querySelector('.scroll.wide'));"
        "const svg = place.querySelector('svg');"
        "const width = () => svg.getBoundingClientRect().width, found = [];"
        "found.push(width() <= place.clientWidth);"
        "const button = place.nextElementSibling; button.click();"
        "const dialog = doc.querySelector('dialog.zoom');"
        "const larger = dialog.querySelectorAll('button')[1];"
        "const before = width(); larger.click();"
        "found.push(dialog.contains(svg), before > place.clientWidth, width() > before);"
        "const closed = new Promise((done) => dialog.addEventListener('close', done));"
        "dialog.close(); await closed;"
        "found.push(place.contains(svg), width() <= place.clientWidth);"
        "found.push(doc.activeElement === button);"
        "return found;"
    )
    seen, errors = look(site, ["architecture"], probe, width=640)
    assert (seen["architecture"], errors) == ([True] * 7, [])


def test_the_architecture_is_drawn_from_top_to_bottom_on_a_phone(
    site: Path,
) -> None:
    probe = (
        "const shown = [...doc.querySelectorAll('svg.arch-fig')].filter((svg) =>"
        " svg.getBoundingClientRect().width);"
        "return shown.map((svg) => [svg.viewBox.baseVal.width < svg.viewBox.baseVal.height,"
        " svg.querySelectorAll('a').length]);"
    )
    narrow, _ = look(site, ["index"], probe, width=390)
    wide, _ = look(site, ["index"], probe, width=1200)
    ((is_tall, links),), ((is_wide_tall, wide_links),) = narrow["index"], wide["index"]
    assert (is_tall, is_wide_tall, links) == (True, False, wide_links)
    assert links


def test_a_box_of_a_diagram_has_a_card_and_is_highlighted_with_its_rows(
    site: Path,
) -> None:
    probe = (
        "const box = doc.querySelector('svg a[data-m=RC]');"
        "const over = (node) => node.dispatchEvent(new view.PointerEvent('pointerover',"
        " {bubbles: true, pointerType: 'mouse'}));"
        "over(box); await until(() => doc.querySelector('.card') && doc.querySelector('.joint'));"
        "const marked = () => [...doc.querySelectorAll('.joint')].map((part) => part.localName);"
        "const found = [doc.querySelector('.card').dataset.m, marked()];"
        "over(doc.querySelector('h1')); found.push(marked());"
        "over(doc.querySelector('.where a.mod[data-m=RC]')); found.push(marked().includes('a'));"
        "return found;"
    )
    seen, errors = look(site, ["patterns/reading-modes"], probe)
    card, marked, after, back = seen["patterns/reading-modes"]
    assert (card, after, back, errors) == ("RC", [], True, [])
    assert {"a", "li", "tr"} <= set(marked)


def test_a_label_of_a_diagram_has_the_width_that_was_measured(site: Path) -> None:
    probe = (
        "await doc.fonts.ready;"
        "return [...doc.querySelectorAll('svg.plant text[textLength]')].map((text) => {"
        " const measured = Number(text.getAttribute('textLength'));"
        " text.removeAttribute('textLength');"
        " return [text.textContent, measured, text.getComputedTextLength()]; });"
    )
    seen, _ = look(site, ["patterns/reading-modes"], probe)
    labels = seen["patterns/reading-modes"]
    assert {"MainController", "read()"} <= {label for label, *_ in labels}
    # Java, which measured the labels, rounds the width of each letter. The width in the browser can
    # differ from the sum of these widths by up to a tenth.
    assert [one for one in labels if abs(one[1] - one[2]) > 2 + 0.1 * one[2]] == []


def test_columns_of_numbers_are_aligned_at_their_right_end(site: Path) -> None:
    probe = (
        "const cells = [...doc.querySelectorAll('main table:not(.umx) tbody td')].filter((cell) =>"
        " /^\\d+$/.test(cell.textContent.trim()));"
        "return cells.map((cell) => view.getComputedStyle(cell).textAlign);"
    )
    seen, _ = look(site, ["uses", "modules/MainController"], probe)
    assert seen["uses"] and {*seen["uses"], *seen["modules/MainController"]} == {"right"}


def test_an_address_of_a_folded_element_opens_its_list(site: Path) -> None:
    probe = (
        "const section = doc.querySelector('main section[id]');"
        "const fold = doc.createElement('details'); section.before(fold); fold.append(section);"
        "const shown = () => section.checkVisibility();"
        "const found = [shown()]; view.location.hash = '#' + section.id;"
        "await until(shown); found.push(shown()); return found;"
    )
    seen, _ = look(site, ["modules/MainController"], probe)
    assert seen["modules/MainController"] == [False, True]


def test_a_fold_of_the_first_page_shows_its_links_only_when_it_is_open(
    site: Path,
) -> None:
    probe = (
        "const fold = doc.querySelector('.others'), link = fold.querySelector('a');"
        "const found = [link.checkVisibility()]; fold.querySelector('summary').click();"
        "found.push(link.checkVisibility()); return found;"
    )
    seen, _ = look(site, ["index"], probe)
    assert seen["index"] == [False, True]
