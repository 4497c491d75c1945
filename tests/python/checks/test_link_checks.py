"""The check finds the dead links of a site, and the source line that contains each dead link."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.project_files import write_files
from traceability.checks.link_checks import check, dead_links
from traceability.checks.path_checks import missing_paths
from traceability.model.design_model import Model


@pytest.mark.parametrize(
    ("page", "dead"),
    [
        ('<a href="modules/RC.html#secret">RC</a> <a href="https://example.org/">out</a>', []),
        ('<a href="modules/RC.html#other">RC</a>', ["modules/RC.html#other"]),
        ('<svg><a xlink:href="modules/PC.html"><text>PC</text></a></svg>', ["modules/PC.html"]),
        ('<img src="../outside.png">', ["../outside.png"]),
        ('<a href="#top">top</a> <a href="#none">none</a>', ["#none"]),
        ("<pre>&lt;a href=\"nowhere.html\"&gt;</pre><a title='a>b'>x</a>", []),
    ],
)
def test_a_link_without_a_target_is_dead(tmp_path: Path, page: str, dead: list[str]) -> None:
    rc = '<h1 id="secret">Secret</h1><a href="../index.html">back</a>'
    write_files(tmp_path, {"index.html": page, "modules/RC.html": rc})
    assert [link for _, _, link, _ in dead_links(tmp_path)] == dead


def test_a_style_sheet_names_files_that_exist(tmp_path: Path) -> None:
    write_files(tmp_path, {"look.css": ".a { background: url('none.svg'); }"})
    assert [link for _, _, link, _ in dead_links(tmp_path)] == ["none.svg"]


def test_a_changed_page_is_read_again(tmp_path: Path) -> None:
    site = tmp_path / "site"
    write_files(
        site, {"index.html": '<a href="other.html#a">a</a>', "other.html": '<b id="a">A</b>'}
    )
    assert dead_links(site) == []
    write_files(site, {"other.html": '<b id="else">A</b>'})
    assert [link for _, _, link, _ in dead_links(site)] == ["other.html#a"]


@pytest.mark.parametrize(
    ("source", "text", "place"),
    [
        ("site/page.html", '<h1>T</h1>\n<a href="@/gone.html">x</a>', ("site/page.html", 2)),
        ("docs/a.rst", "A\n=\n\n`There <../gone.html>`__.\n", ("docs/a.rst", 4)),
        ("docs/other.rst", "Nothing of it.\n", ("build/site/docs/a.html", 1)),
    ],
)
def test_a_dead_link_is_one_finding_where_it_is_written(
    tmp_path: Path, source: str, text: str, place: tuple[str, int]
) -> None:
    page = '<a href="../gone.html">x</a>'
    site = tmp_path / "build" / "site"
    write_files(tmp_path, {source: text, "build/site/docs/a.html": page})
    if place[0].startswith("site"):
        write_files(tmp_path, {"build/site/docs/b.html": page})
    (found,) = check(Model("", "", "", {}), site)
    assert (found.place.file, found.place.line) == place
    assert "dead link 'gone.html'" in found.text


def test_paths_of_the_project_that_pages_name_exist(tmp_path: Path) -> None:
    write_files(
        tmp_path,
        {
            "src/there.hpp": "",
            "README.md": "`src/there.hpp`, `docs/`.\n\n`doc/gone.rst`, [it](docs/none.rst#p).\n",
            "docs/page.rst": "See ``src/gone.hpp``, `build/made.txt` and 1/2, `and/or`.\n",
        },
    )
    found = [(one.place.file, one.place.line, one.text) for one in missing_paths(tmp_path)]
    assert sorted(found) == [
        ("README.md", 3, "there is no doc/gone.rst"),
        ("README.md", 3, "there is no docs/none.rst"),
        ("docs/page.rst", 1, "there is no src/gone.hpp"),
    ]


def test_all_texts_name_paths_of_the_project_that_exist(tmp_path: Path) -> None:
    write_files(
        tmp_path,
        {
            "src/there.hpp": '#include "src/none.hpp"\n// See src/gone.hpp, src/there.hpp.\n',
            "requirements/a.dox": "@source decision: docs/gone.rst, and/or docs/*.rst.\n",
            "docs/page.rst": "``.github/workflows/ci.yml`` and ``build/made.txt``\n",
            ".github/workflows/check.yml": "",
            "tools/run.py": 'PAGE = "docs/page"  # docs/FILE.rst, /home/src/x.hpp\n',
            "ports/can/README.md": "`can.cpp`, `port/can.cpp`, `port/none.cpp`.\n",
            "ports/can/port/can.cpp": "",
        },
    )
    found = {(one.place.file, one.text) for one in missing_paths(tmp_path)}
    assert found == {
        ("docs/page.rst", "there is no .github/workflows/ci.yml"),
        ("ports/can/README.md", "there is no port/none.cpp"),
        ("requirements/a.dox", "there is no docs/gone.rst"),
        ("src/there.hpp", "there is no src/gone.hpp"),
    }
