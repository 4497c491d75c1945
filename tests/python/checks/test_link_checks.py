"""Dead links of a site."""

from __future__ import annotations

from pathlib import Path

import pytest

from traceability.checks.link_checks import check, dead_links, missing_paths
from traceability.model.design_model import Model


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


def test_a_link_of_a_template_is_one_finding_at_its_line(tmp_path: Path) -> None:
    site = tmp_path / "build" / "site"
    site.mkdir(parents=True)
    for page in ("a", "b", "c"):
        (site / f"{page}.html").write_text('<p>\n<a href="gone.html">x</a>')
    (tmp_path / "site").mkdir()
    (tmp_path / "site" / "page.html").write_text('<h1>Title</h1>\n<a href="@/gone.html">x</a>\n')
    (found,) = check(Model("", "", "", {}), site)
    assert (found.place.file, found.place.line) == ("site/page.html", 2)
    assert found.text == "dead link 'gone.html' in a.html and 2 more: there is no such file"


def test_a_link_of_a_hand_written_page_is_found_where_it_is_written(tmp_path: Path) -> None:
    site = tmp_path / "build" / "site" / "docs"
    site.mkdir(parents=True)
    (site / "robot.html").write_text('<a href="../gone.html#here">x</a>')
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "robot.rst").write_text("Robot\n=====\n\n`There <../gone.html#here>`__.\n")
    (found,) = check(Model("", "", "", {}), site.parent)
    assert (found.place.file, found.place.line) == ("docs/robot.rst", 4)


def test_a_link_that_is_put_together_lies_in_the_page(tmp_path: Path) -> None:
    site = tmp_path / "build" / "site"
    site.mkdir(parents=True)
    (site / "a.html").write_text('<a href="gone.html">x</a>')
    (found,) = check(Model("", "", "", {}), site)
    assert (found.place.file, found.place.line) == ("build/site/a.html", 1)


def test_paths_of_the_project_that_pages_name_exist(tmp_path: Path) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "there.hpp").write_text("")
    (tmp_path / "README.md").write_text(
        "Read `src/there.hpp` and `docs/`.\n\nThen `doc/gone.rst`.\n"
    )
    (tmp_path / "docs" / "page.rst").write_text(
        "See ``src/gone.hpp``, `build/made.txt` and :source:`src/other.hpp`, or 1/2, `and/or`.\n"
    )
    found = [(one.place.file, one.place.line, one.text) for one in missing_paths(tmp_path)]
    assert found == [
        ("README.md", 3, "there is no doc/gone.rst"),
        ("docs/page.rst", 1, "there is no src/gone.hpp"),
    ]


def test_sheet_of_styles_names_files_that_exist(site: Path) -> None:
    (site / "look.css").write_text(".a { background: url('none.svg'); }")
    assert reasons(site) == [("look.css", "none.svg")]


def test_link_of_the_readme_names_a_file_that_exists(tmp_path: Path) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "README.md").write_text("Read [it](docs/none.rst#part).\n")
    assert [finding.text for finding in missing_paths(tmp_path)] == ["there is no docs/none.rst"]
