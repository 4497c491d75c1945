"""Dead links of a site."""

from __future__ import annotations

from pathlib import Path

import pytest

from traceability.checks.links import dead_links


@pytest.fixture
def site(tmp_path: Path) -> Path:
    (tmp_path / "modules").mkdir()
    (tmp_path / "index.html").write_text(
        '<a href="modules/RC.html#secret">RC</a> <a href="https://example.org/">out</a>'
        '<svg><a xlink:href="modules/RC.html"><text>RC</text></a></svg>'
    )
    (tmp_path / "modules" / "RC.html").write_text(
        '<h1 id="secret">Secret</h1><a href="../index.html">back</a><a href="#top">top</a>'
    )
    return tmp_path


def reasons(site: Path) -> list[tuple[str, str]]:
    return [(path.name, link) for path, _, link, _ in dead_links(site)]


def test_sound_site_has_no_dead_link(site: Path) -> None:
    assert dead_links(site) == []


def test_missing_anchor(site: Path) -> None:
    page = site / "modules" / "RC.html"
    page.write_text(page.read_text().replace('id="secret"', 'id="other"'))
    assert reasons(site) == [("index.html", "modules/RC.html#secret")]


def test_missing_page_is_found_in_diagrams_too(site: Path) -> None:
    (site / "modules" / "RC.html").unlink()
    assert reasons(site) == [
        ("index.html", "modules/RC.html#secret"),
        ("index.html", "modules/RC.html"),
    ]


def test_link_out_of_the_site(site: Path) -> None:
    (site / "a.html").write_text('<img src="../outside.png">')
    assert reasons(site) == [("a.html", "../outside.png")]


def test_code_that_shows_a_link_is_no_link(site: Path) -> None:
    (site / "code.html").write_text(
        "<pre>&lt;a href=\"nowhere.html\"&gt;</pre><a title='a>b'>x</a>"
    )
    assert dead_links(site) == []
