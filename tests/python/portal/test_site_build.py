"""The site of a small model: its files, its warnings, and the files that a second build writes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from sphinx.util.inventory import InventoryFile

from portal.site_build import SiteResult, build_site
from tests.python.portal.fixture import MODES, REPORT, make_project
from tests.python.portal.page_reader import Shown, read_page
from traceability.checks.link_checks import dead_links
from traceability.checks.registry import Check
from traceability.model.design_model import Model
from traceability.schema import Finding, Place
from weeding_robot_client import exit_codes

pytestmark = pytest.mark.reads("site", "docutils.conf")

CHECKS = [Check("tree-static", "Possible", "Each edge is one.", "runs.", "call it.")]
BY_DOXYGEN = """<doxygen version="1.9.8"><compounddef id="classwr_1_1RC" kind="class" prot="public">
<compoundname>wr::RC</compoundname><sectiondef kind="public-func">
<memberdef kind="function" id="classwr_1_1RC_1a0" prot="public" static="no" const="no"
 explicit="no" inline="no" virt="virtual">
<type>void</type><definition>void wr::RC::read</definition><argsstring>()</argsstring>
<name>read</name><briefdescription><para>Takes the pulse.</para></briefdescription>
<detaileddescription></detaileddescription><location file="RC.hpp" line="3"/></memberdef>
</sectiondef><briefdescription></briefdescription><detaileddescription></detaileddescription>
<location file="RC.hpp" line="1"/></compounddef></doxygen>"""


class Site:
    """A project, its model, and the site that is built from both."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.model: Model = make_project(root)
        self.html = root / "build" / "site"

    def build(self, *findings: Finding) -> SiteResult:
        return build_site(self.root, self.model, replace(REPORT, findings=findings))

    def page(self, name: str) -> Shown:
        return read_page((self.html / f"{name}.html").read_text())

    def times(self) -> dict[str, int]:
        pages = self.html.rglob("*.html")
        return {str(path.relative_to(self.html)): path.stat().st_mtime_ns for path in pages}


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Site:
    monkeypatch.setattr("portal.site_build.CHECKS", CHECKS)
    return Site(tmp_path)


def test_a_site_is_whole_and_a_second_run_writes_only_what_changed(site: Site) -> None:
    result = site.build(Finding(Place(f"src/{MODES}/RC.cpp", 4), "tree-static", "no call", "fix"))
    assert result.warnings == []
    assert result.pages == len(site.times())
    assert "../modules/RC.html#m-read" in site.page("docs/tour").links
    found = site.page("checks/tree-static")
    assert "no call" in found.text
    assert f"../source/src/{MODES}/RC.cpp.html#L4" in found.links
    dead = {link for _, _, link, _ in dead_links(site.html)}
    assert not [link for link in dead if "#" not in link and "docs/" not in link]

    site.build()
    before = site.times()
    site.build()
    assert site.times() == before
    methods = site.model.modules["RC"].methods
    methods[0] = replace(methods[0], brief="Takes an order.")
    site.build()
    changed = {name for name, when in site.times().items() if before[name] != when}
    assert "modules/RC.html" in changed
    assert "modules/MainController.html" not in changed


def test_the_inventory_has_the_elements_of_the_design(site: Site) -> None:
    site.build()
    found = InventoryFile.loads((site.html / "objects.inv").read_bytes(), uri="").data
    assert found["design:module"]["RC"].uri == "modules/RC.html"
    assert found["design:requirement"]["FR-15"].uri.startswith("requirements/FR-15.html")
    assert found["design:method"]["RC::read"].uri == "modules/RC.html#m-read"
    assert "tree-static" in found["design:check"]


def test_an_unknown_name_in_a_hand_written_page_is_found_in_each_run(site: Site) -> None:
    (site.root / "docs" / "tour.rst").write_text(
        "Tour\n====\n\nText.\n\n"
        "See :module:`Nobody`, :requirement:`FR-99`, :test:`RcTest.Gone`, :constant:`kGone`,\n"
        ":exit:`LATE` and :ref:`nowhere`.\n"
    )
    for _ in range(2):
        warnings = site.build().warnings
        assert {(w.place.file, w.check) for w in warnings} == {("docs/tour.rst", "link-doc")}
        assert len(warnings) == 6


def test_an_exit_code_is_inserted(site: Site) -> None:
    page = site.root / "docs" / "tour.rst"
    page.write_text("Tour\n====\n\nThe exit code is :exit:`BUSY`.\n")
    assert site.build().warnings == []
    assert f"The exit code is {exit_codes.BUSY}." in (site.html / "docs/tour.html").read_text()


def test_a_label_that_another_page_lost_is_found(site: Site) -> None:
    docs = site.root / "docs"
    (docs / "there.rst").write_text("There\n=====\n\n.. _place:\n\nHere\n----\n\nText.\n")
    (docs / "here.rst").write_text("Here\n====\n\nSee :ref:`place`.\n")
    assert site.build().warnings == []
    (docs / "there.rst").write_text("There\n=====\n\nText.\n")
    (found,) = site.build().warnings
    assert (found.place.file, found.check) == ("docs/here.rst", "link-doc")


def test_the_page_of_a_removed_module_is_removed(site: Site) -> None:
    site.build()
    del site.model.modules["RC"]
    pattern = site.model.patterns["reading-modes"]
    site.model.patterns["reading-modes"] = replace(pattern, roles=[])
    site.model.machines.clear()
    site.model.changes.clear()
    site.build()
    assert not (site.html / "modules/RC.html").exists()


def test_the_page_of_a_module_has_the_members_that_doxygen_reads(site: Site) -> None:
    file = site.root / "build/model/xml/classwr_1_1RC.xml"
    file.parent.mkdir(parents=True)
    rc = replace(site.model.modules["RC"], qualified="wr::RC")
    for brief, secret in (("Takes the pulse.", "One secret"), ("Reads it.", "Another secret")):
        file.write_text(BY_DOXYGEN.replace("Takes the pulse.", brief))
        site.model.modules["RC"] = replace(rc, secret=secret)
        assert site.build().warnings == []
        text = site.page("modules/RC").text
        assert brief in text
        assert secret in text
    file.unlink()
    site.build()
    text = site.page("modules/RC").text
    assert "Reads it." not in text
    assert "Another secret" in text
