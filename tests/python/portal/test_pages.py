"""Pages made from a small model."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from sphinx.util.inventory import InventoryFile

from portal import diagrams, search
from portal.highlight import highlighted_lines
from portal.links import Links
from portal.names import Names
from portal.pages import all_pages
from portal.paper_views import families, hidden_names
from portal.portal import CheckText, Portal
from portal.requirement_pages import aligned
from portal.site_build import SiteResult, build_site
from tests.python.portal.fixture import ARCHITECTURE, MODES, REPORT, make_model, make_project
from tests.python.reading.task_records import record_task
from traceability.model.design_model import Model
from traceability.model.metrics import drift
from traceability.reading.products import DEFAULT, PRODUCTS, read_products
from traceability.reading.seeded_fault_record import Outcome, read_record, write_record
from traceability.reading.task_record import IMAGES, SEEDED_FAULTS
from traceability.schema import (
    HOST,
    VIRTUAL_K64,
    BindingResult,
    BoardFinding,
    Curve,
    DriverFault,
    Finding,
    LoopFigure,
    LoopPlot,
    LoopRun,
    LoopScenario,
    Place,
    TreeRun,
)

CHECKS = [
    CheckText("tree-static", "Possible", "It shows.", "Each edge is one.", "runs.", "call it.")
]


def bodies(root: Path, model: Model) -> dict[str, str]:
    portal = Portal(root, model, REPORT, CHECKS)
    return {page.name: page.body for page in all_pages(portal)}


@pytest.fixture(scope="module")
def portal(tmp_path_factory: pytest.TempPathFactory) -> Portal:
    root = tmp_path_factory.mktemp("project")
    return Portal(root, make_project(root), REPORT, CHECKS)


@pytest.fixture(scope="module")
def pages(portal: Portal) -> dict[str, str]:
    return {page.name: page.body for page in all_pages(portal)}


def test_every_element_has_a_page(pages: dict[str, str]) -> None:
    wanted = {
        "index", "structure", "modules/RC", "modules/Mode", "patterns/reading-modes",
        "requirements/FR-15", "checks/tree-static", f"source/src/{MODES}/RC.cpp", "tests",
        "machines", "uses", "trees", "architecture", "guide", "interfaces", "datatypes",
        "changes", "changes/reading-modes", "secrets", "inheritances", "concordance",
    }  # fmt: skip
    assert wanted <= pages.keys()


def test_a_module_page_has_its_secret_caller_role_requirement_and_test(
    pages: dict[str, str],
) -> None:
    page = pages["modules/RC"]
    for part in ("The secret of RC", "MainController</tspan>", "Concrete State", "FR-15", "Reads"):
        assert part in page


def test_the_page_of_a_change_has_steps_and_what_stays_untouched(pages: dict[str, str]) -> None:
    page = pages["changes/reading-modes"]
    assert 'Derive from <a class="mod a" data-m="Mode"' in page
    assert "Make it known in a composition." in page
    assert "All 3 modules that stay untouched" in page
    assert "requirements/FR-15.html" in page
    assert "Tests of these requirements: 1" in page
    assert "@/changes/reading-modes.html" in pages["patterns/reading-modes"]
    assert "@/changes/reading-modes.html" in pages["modules/Mode"]
    assert "@/changes/reading-modes.html" in pages["index"]


def test_an_heir_overrides_what_it_has_of_its_base(portal: Portal) -> None:
    family = families(portal)[0]
    seen = [(heir.module.name, heir.depth, len(heir.own), len(heir.overridden)) for heir in family]
    assert seen == [("Mode", 0, 1, 0), ("RC", 1, 0, 1)]


def test_what_a_secret_names_stands_beside_it(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    hides = ["RC::kPause", "remote/Pulse.hpp", "Pulse"]
    rc = replace(model.modules["RC"], registers=["uart"], hides=hides)
    model.modules["RC"] = rc
    assert hidden_names(rc) == {
        "registers": ["uart"],
        "constants": ["RC::kPause"],
        "headers": ["remote/Pulse.hpp"],
        "types": ["Pulse"],
    }
    page = bodies(tmp_path, model)["secrets"]
    assert "<code>remote/Pulse.hpp</code>" in page


def test_the_concordance_leads_both_ways(pages: dict[str, str]) -> None:
    page = pages["concordance"]
    there = page.partition('id="names"')[2]
    assert "CR</td>" in there and 'href="@/modules/RC.html"' in there
    assert 'href="#Figure-1"' in there
    assert 'href="@/machines.html#reading-modes"' in page and 'href="@/guide.html"' in page
    assert "The name is" in pages["modules/RC"] and "Figure 1" in pages["modules/RC"]
    assert "In the paper" not in pages["modules/MainController"]


def test_a_result_of_this_run_is_shown_and_a_stale_one_is_not(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    fresh = bodies(tmp_path, model)
    stale_model = replace(model, results_hashes={HOST: "older"})
    stale = bodies(tmp_path, stale_model)
    assert "1 of 1 runs passed" in fresh["tests"]
    assert "older than the sources" not in fresh["tests"]
    assert "1 of 1 runs passed" not in stale["tests"]
    assert "older than the sources" in stale["tests"]


def test_a_node_lies_on_the_row_of_the_call_that_it_matches(portal: Portal) -> None:
    requirement = portal.model.requirements["FR-15"]
    rows = aligned(portal, requirement, requirement.runs[HOST])
    found = [(row.node.label if row.node else "", row.call) for row in rows]
    assert found == [
        ("MainController::read", "MainController::read"),
        ("", "Pipe::read"),
        ("RC::read", "RC::read"),
    ]
    assert rows[1].trunks == [0]


def test_a_node_without_a_match_has_a_row_of_its_own(portal: Portal) -> None:
    requirement = make_model().requirements["FR-15"]
    assert requirement.tree is not None
    requirement.runs[HOST].places[1] = None
    rows = aligned(portal, requirement, requirement.runs[HOST])
    assert [(row.node.label if row.node else "", row.call) for row in rows][1] == ("RC::read", "")


def test_each_binding_has_a_result_of_its_own(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    first = model.tests["RcTest.Reads"]
    failed = BindingResult("failed", 30.0, "expected 1")
    model.tests["Robot.Drives"] = replace(
        first, id="Robot.Drives", name="Drives", results=first.results | {VIRTUAL_K64: failed}
    )
    requirement = model.requirements["FR-15"]
    requirement.verified_by.append("Robot.Drives")
    requirement.runs[VIRTUAL_K64] = TreeRun("Robot.Drives", requirement.runs[HOST].rows, 0, [0, 2])
    pages = bodies(tmp_path, model)
    assert "2 of 3 runs passed" in pages["tests"]
    assert "virtual K64: expected 1" in pages["tests"]
    assert "not built for it" in pages["tests"]
    assert '<td class="num" data-l="host">2/2</td>' in pages["requirements/index"]
    assert '<td class="num" data-l="virtual K64">0/1</td>' in pages["requirements/index"]
    assert "Calls recorded on the virtual K64" in pages["requirements/FR-15"]
    assert "host, virtual K64" in pages["trees"]


def test_a_module_shows_first_its_own_tests_then_those_of_its_requirements(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    first = model.tests["RcTest.Reads"]
    others = {
        "Robot.Drives": replace(first, id="Robot.Drives", verifies=[]),
        "RCTest.Own": replace(
            first, id="RCTest.Own", verifies=[], place=Place(f"tests/{MODES}/RCTest.cpp", 3)
        ),
    }
    model = replace(model, tests=model.tests | others)
    model.modules["RC"] = replace(
        model.modules["RC"], tests=["Robot.Drives", *model.modules["RC"].tests, "RCTest.Own"]
    )
    portal = Portal(tmp_path, model, REPORT, CHECKS)
    own = portal.own_tests(model.modules["RC"])
    assert [test.id for test in own] == ["RCTest.Own", "RcTest.Reads"]
    page = next(page.body for page in all_pages(portal) if page.name == "modules/RC")
    rest = page.partition("<summary>1 more test that executes RC</summary>")[2]
    assert "Robot.<wbr>Drives" in rest
    assert "&lt;1 ms<" in page


def test_names_are_written_as_in_the_paper(portal: Portal) -> None:
    names = portal.names
    assert 'class="mod a"' in names.mod("Mode")
    assert 'class="mod c"' in names.mod("RC")
    assert "<a" not in names.mod("Nothing")


def test_texts_link_the_names_in_them(portal: Portal) -> None:
    text = portal.names.text("Calls `RC::read` of MainController for FR-15.")
    for target in ("modules/RC.html#m-read", "modules/MainController.html", "requirements/FR-15"):
        assert target in text


def test_a_view_without_content_has_no_key(portal: Portal) -> None:
    keys = portal.names.keys("Mode")
    assert "#tests" not in keys
    assert "#patterns" in keys


def test_an_inherited_method_is_found_at_its_heir() -> None:
    model = make_model()
    model.modules["RC"] = replace(model.modules["RC"], methods=[])
    links = Links(model, set())
    assert links.method("RC::read") == "@/modules/Mode.html#m-read"
    assert Names(model, links).meth("RC::read").count("modules/Mode.html") == 1


def test_a_diagram_shows_roles_and_uses_only_variables_for_colours(portal: Portal) -> None:
    svg = portal.drawn["pattern-reading-modes"]
    assert "Concrete State" in svg
    assert 'href="@/modules/RC.html"' in svg
    assert "#FA" not in svg
    assert "var(--role-concrete)" in svg


def test_the_transitions_of_a_requirement_are_marked(pages: dict[str, str]) -> None:
    page = pages["requirements/FR-15"]
    assert "Where it is in the state machine" in page
    assert '<g class="edge lit" data-for="FR-15 FR-16">' in page
    assert '<g class="says lit" data-for="FR-15"><text' in page
    assert '<g class="says" data-for="FR-16"><text' in page
    assert page.count('<tr class="here">') == 1
    assert 'class="says"' in pages["machines"]
    assert " lit" not in pages["machines"]


def test_a_requirement_of_no_transition_has_no_state_machine(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    machine = model.machines["reading-modes"]
    steps = [replace(step, requirements=[]) for step in machine.transitions]
    model.machines["reading-modes"] = replace(machine, transitions=steps)
    found = bodies(tmp_path, model)
    assert "in the state machine" not in found["requirements/FR-15"]


def test_a_diagram_that_cannot_be_drawn_is_an_error(tmp_path: Path) -> None:
    broken = diagrams.Diagram("broken", "Broken", "@startuml\nclass {{{ \n@enduml")
    with pytest.raises(diagrams.DiagramError):
        diagrams.draw([broken], tmp_path)


def test_highlighted_lines_keep_the_text() -> None:
    text = '/* two\nlines */ const char* a = "<b>";\n'
    lines = highlighted_lines("a.cpp", text)
    assert len(lines) == 2
    assert all(line.count("<span") == line.count("</span>") for line in lines)
    assert "&lt;b&gt;" in lines[1]


def test_the_index_holds_every_kind(portal: Portal) -> None:
    groups = {entry[0] for entry in search.entries(portal)}
    assert {"Modules", "Methods", "Requirements", "Tests", "Checks", "Source", "Pages"} <= groups


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Model]:
    monkeypatch.setattr("portal.site_build.check_texts", lambda: CHECKS)
    return tmp_path, make_project(tmp_path)


def build(site: tuple[Path, Model], *findings: Finding) -> SiteResult:
    return build_site(site[0], site[1], replace(REPORT, findings=findings))


def test_the_site_is_built_without_warnings(site: tuple[Path, Model]) -> None:
    result = build(site)
    assert result.warnings == []
    assert (site[0] / "build/site/docs/tour.html").read_text().count("modules/RC.html") >= 2
    assert result.pages == len(list((site[0] / "build/site").rglob("*.html")))


def test_links_of_a_page_fit_its_depth(site: tuple[Path, Model]) -> None:
    build(site)
    text = (site[0] / f"build/site/source/src/{MODES}/RC.cpp.html").read_text()
    assert "@/" not in text.replace("@/**", "")
    assert '"../../../../modules/RC.html' in text


def test_the_inventory_has_the_elements_of_the_design(site: tuple[Path, Model]) -> None:
    build(site)
    data = (site[0] / "build/site/objects.inv").read_bytes()
    found = InventoryFile.loads(data, uri="").data
    addresses = {kind: found[f"design:{kind}"] for kind in ("module", "requirement", "check")}
    assert addresses["module"]["RC"].uri == "modules/RC.html"
    assert addresses["requirement"]["FR-15"].uri.startswith("requirements/FR-15.html")
    assert "tree-static" in addresses["check"]
    assert found["design:method"]["RC::read"].uri == "modules/RC.html#m-read"


def test_an_unknown_name_in_a_hand_written_page_is_found_in_each_run(
    site: tuple[Path, Model],
) -> None:
    page = site[0] / "docs" / "tour.rst"
    page.write_text(
        "Tour\n====\n\nText.\n\n"
        "See :module:`Nobody`, :requirement:`FR-99`, :test:`RcTest.Gone` and :ref:`nowhere`.\n"
    )
    for _ in range(2):
        warnings = build(site).warnings
        assert {(w.place.file, w.place.line, w.check) for w in warnings} == {
            ("docs/tour.rst", 6, "link-doc")
        }
        assert len(warnings) == 4


def test_a_label_that_another_page_lost_is_found(site: tuple[Path, Model]) -> None:
    docs = site[0] / "docs"
    (docs / "there.rst").write_text("There\n=====\n\n.. _place:\n\nHere\n----\n\nText.\n")
    (docs / "here.rst").write_text("Here\n====\n\nSee :ref:`place`.\n")
    assert build(site).warnings == []
    (docs / "there.rst").write_text("There\n=====\n\nText.\n")
    (found,) = build(site).warnings
    assert (found.place.file, found.check) == ("docs/here.rst", "link-doc")


def test_a_second_run_writes_nothing_and_a_change_only_its_pages(
    site: tuple[Path, Model],
) -> None:
    build(site)
    html = site[0] / "build" / "site"

    def state() -> dict[str, int]:
        return {str(p.relative_to(html)): p.stat().st_mtime_ns for p in html.rglob("*.html")}

    before = state()
    build(site)
    assert state() == before
    site[1].modules["RC"].methods[0] = replace(
        site[1].modules["RC"].methods[0], brief="Takes an order."
    )
    build(site)
    changed = {name for name, when in state().items() if before[name] != when}
    assert "modules/RC.html" in changed
    assert "modules/MainController.html" not in changed


def test_the_page_of_a_removed_module_is_removed(site: tuple[Path, Model]) -> None:
    build(site)
    docs = site[0] / "build/site/docs/tour.html"
    before = docs.read_text()
    module = site[1].modules.pop("RC")
    site[1].patterns["reading-modes"] = replace(site[1].patterns["reading-modes"], roles=[])
    site[1].machines.clear()
    site[1].changes.clear()
    build(site)
    assert not (site[0] / "build/site/modules" / f"{module.name}.html").exists()
    assert docs.read_text() != before, "the number of modules in the navigation"


def test_a_check_that_needs_fresh_results_does_not_hold_without_them(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    assert "holds" in Portal(tmp_path, model, REPORT, CHECKS).verdict_of("tree-dynamic")
    stale = replace(model, results_hashes={HOST: None})
    assert "no fresh results" in Portal(tmp_path, stale, REPORT, CHECKS).verdict_of("tree-dynamic")


def test_a_check_of_the_finished_site_claims_no_verdict(tmp_path: Path) -> None:
    later = CheckText("link-site", "Links", "To arrive.", "Each has one.", "others.", "fix it.")
    portal = Portal(tmp_path, make_project(tmp_path), REPORT, [*CHECKS, later])
    found = {page.name: page.body for page in all_pages(portal)}
    assert "Checked after the pages are written" in found["checks/link-site"]
    assert 'class="v' not in found["checks/link-site"]
    assert "holds</span>" in found["checks/tree-static"]
    assert portal.early == 1


def test_seeded_faults_are_a_figure_only_when_this_state_was_measured(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    found = Outcome("a-1", "tree-static", "One.", "src/a.hpp", 1, True, True, ["found"])
    missed = Outcome("a-2", "tree-static", "Two.", "src/a.hpp", 1, False, True, [])
    write_record(tmp_path, [found, missed], 0)
    record_task(tmp_path, SEEDED_FAULTS, "src")

    def home() -> str:
        measured = drift(replace(model, outcomes=read_record(tmp_path)))
        seeded = replace(model, measured=measured)
        return bodies(tmp_path, seeded)["index"]

    assert "1<small>/2</small>" in home()
    (tmp_path / "src" / MODES / "RC.hpp").write_text("// edited", encoding="utf-8")
    assert "faults caught" not in home()


def test_the_page_of_the_virtual_k64_shows_what_was_found(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    model = replace(model, driver_faults=None)
    place = Place("design/board_findings.toml", 4)
    model = replace(
        model,
        board_findings={
            "fpu-off": BoardFinding("fpu-off", "The unit was off.", place, ["RcTest.Reads"]),
            "lockup": BoardFinding("lockup", "It stops.", place),
        },
    )

    def shown() -> str:
        return bodies(tmp_path, model)["virtual_k64"]

    assert "not run on these sources" in shown()
    model = replace(
        model,
        driver_faults=[
            DriverFault(
                "FPU not enabled", f"src/{MODES}/RC.cpp", "fpu-off", True, "finding: fpu-off"
            ),
            DriverFault("Nothing", f"src/{MODES}/RC.cpp", "", False, "done"),
        ],
    )
    page = shown()
    assert page.count("no test</span>") == 2  # one finding, and no comparison with QEMU
    assert "1<small>/2</small>" in page
    assert "caught</span>" in page
    assert "missed</span>" in page


def test_the_architecture_says_what_is_not_in_this_source(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    at = ARCHITECTURE.index("wheel-control")

    def shown(*modules: str) -> str:
        model.architecture[at] = replace(model.architecture[at], modules=modules)
        return bodies(tmp_path, model)["architecture"]

    page = shown("RC", "WheelController")
    assert "not in this source: WheelController" in page
    assert page.count("not in this source") == 1
    assert 'class="m soft">not in this source<' in shown("WheelController")


def test_the_pages_that_explain_have_a_group_of_their_own(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    (tmp_path / "docs" / "glossary.rst").write_text("Glossary\n========\n")
    (tmp_path / "docs" / "quick_start.rst").write_text("Quick start\n===========\n")
    navigation = Portal(tmp_path, model, REPORT, CHECKS).navigation
    groups = {group.id: [entry.title for entry in group.entries] for group in navigation.groups}
    assert groups["explain"] == ["Glossary"]
    assert groups["build"] == ["Quick start", "Source", "Exports"]
    assert groups["understand"][:3] == ["Tour", "Architecture", "Module structure"]


def test_a_finding_is_shown_on_its_check(site: tuple[Path, Model]) -> None:
    finding = Finding(Place(f"src/{MODES}/RC.cpp", 4), "tree-static", "no call", "add the call")
    build(site, finding)
    page = (site[0] / "build/site/checks/tree-static.html").read_text()
    assert "no call" in page
    assert "RC.cpp.html#L4" in page


def test_lines_of_drivers_that_the_board_did_not_execute_are_listed(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    path = model.modules["RC"].source
    assert path

    def page(name: str) -> str:
        return bodies(tmp_path, model)[name]

    assert "not run on these sources" in page("virtual_k64").partition('id="drivers"')[2]
    model = replace(model, board_lines={path: {1: True, 3: False, 5: False, 6: True, 7: False}})
    table = page("virtual_k64").partition('id="drivers"')[2].partition("</section>")[0]
    assert "2 of 5 lines" in table
    for line, words in ((3, "3\N{EN DASH}5"), (7, "7")):
        assert f'<a href="@/source/{path}.html#L{line}">{words}</a>' in table
    assert "Coverage on the virtual K64" in page("modules/RC")
    assert "2 of 5" in page("modules/RC")
    assert "not executed by a test on the virtual K64" in page(f"source/{path}")


def test_the_closed_loop_shows_what_ran_and_what_did_not(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    curve = Curve("truth", HOST, [(0.0, 0.0), (1.0, 150.0)])
    good = LoopFigure("Settling time", 2000, "ms", "FR-15", {HOST: 1050.0})
    bad = LoopFigure("Overshoot", 10, "%", "", {HOST: 11.0})
    never = LoopFigure("Steady error", 1, "%", "", {HOST: None})
    model = replace(
        model,
        closed_loop=[
            LoopScenario(
                "step",
                "A step",
                "It steps.",
                "sim/scenario/examples/step.scenario",
                Place("design/closed_loop.toml", 1),
                [LoopPlot("Velocity", "rpm", [curve])],
                [good, bad, never],
                {HOST: LoopRun(False, "step.scenario:3: no")},
            )
        ],
    )
    page = bodies(tmp_path, model)["closed_loop"]
    assert "1050 ms</span>" in page
    assert '<span class="v bad">11 %</span>' in page
    assert '<span class="v bad">no value</span>' in page
    assert page.count("not run</span>") == 3
    assert "1<small>/3</small>" in page
    assert "step.scenario:3: no" in page
    assert 'requirements/FR-15.html"' in page
    assert page.count('<path class="truth host"') == 2  # the curve and its key


def test_products_are_compared_when_they_were_built(tmp_path: Path) -> None:
    model = make_project(tmp_path)

    def page() -> str:
        built = replace(model, products=read_products(tmp_path))
        return bodies(tmp_path, built)["products"]

    assert "not built from these sources" in page()
    results = tmp_path / "build" / "results"
    results.mkdir(parents=True)
    every = {
        "flash": 40000,
        "ram": 9000,
        "stack": 0,
        "modules": ["MainController"],
        "forbidden": [],
    }
    held = {name: dict(every) for name in PRODUCTS} | {
        DEFAULT: every | {"flash": 41234, "modules": ["MainController", "RC"]}
    }
    (results / "products.json").write_text(json.dumps(held))
    (results / "image_k64.json").write_text(json.dumps({"flash": 41234, "ram": 9000}))
    record_task(tmp_path, IMAGES, "src")
    shown = page()
    assert "41234 B" in shown
    differences = shown.partition('id="differences"')[2].partition("</section>")[0]
    assert ">RC</a>" in differences
    assert differences.count("held</span>") == 1
    assert ">MainController</a>" in shown.partition('id="common"')[2]
    (tmp_path / "src" / MODES / "RC.hpp").write_text("// edited")
    assert "not built from these sources" in page()


def test_the_structure_tells_what_of_the_design_is_missing(tmp_path: Path) -> None:
    model = make_project(tmp_path)

    def page(name: str) -> str:
        return bodies(tmp_path, model)[name]

    model = replace(model, designed_modules=["MainController", "Mode"])
    model = replace(model, designed_applications={"reading-modes": "State"})
    assert '<span class="v ok">2 of 2</span>' in page("structure")
    assert "1 more of extensions" in page("structure")
    assert '<span class="v ok">1 of 1</span>' in page("patterns/index")
    model.designed_modules.append("Wheel")
    model = replace(
        model, designed_applications=model.designed_applications | {"operation-states": "State"}
    )
    assert '<span class="v bad">2 of 3</span>' in page("structure")
    assert "Missing: Wheel." in page("structure")
    assert '<span class="v bad">1 of 2</span>' in page("patterns/index")
    assert "Missing: operation-states." in page("patterns/index")
    assert "1 of 2 applications" in page("patterns/index")


BY_DOXYGEN = """<doxygen version="1.9.8"><compounddef id="classwr_1_1RC" kind="class" prot="public">
<compoundname>wr::RC</compoundname><sectiondef kind="public-func">
<memberdef kind="function" id="classwr_1_1RC_1a0" prot="public" static="no" const="no"
 explicit="no" inline="no" virt="virtual">
<type>void</type><definition>void wr::RC::read</definition><argsstring>()</argsstring>
<name>read</name><briefdescription><para>Takes the pulse.</para></briefdescription>
<detaileddescription></detaileddescription><location file="RC.hpp" line="3"/></memberdef>
</sectiondef><briefdescription></briefdescription><detaileddescription></detaileddescription>
<location file="RC.hpp" line="1"/></compounddef></doxygen>"""


def test_the_page_of_a_module_has_the_members_that_doxygen_reads(
    site: tuple[Path, Model],
) -> None:
    file = site[0] / "build/model/xml/classwr_1_1RC.xml"
    file.parent.mkdir(parents=True)
    file.write_text(BY_DOXYGEN)
    site[1].modules["RC"] = replace(site[1].modules["RC"], qualified="wr::RC")
    assert build(site).warnings == []
    page = site[0] / "build/site/modules/RC.html"
    assert "Takes the pulse." in page.read_text()
    assert "The secret of RC" in page.read_text()
    file.write_text(BY_DOXYGEN.replace("Takes the pulse.", "Reads the pulse."))
    site[1].modules["RC"] = replace(site[1].modules["RC"], secret="Another secret")
    build(site)
    assert "Reads the pulse." in page.read_text()
    assert "Another secret" in page.read_text()
    site[1].modules["RC"] = replace(site[1].modules["RC"], secret="A third secret")
    build(site)
    assert "A third secret" in page.read_text()
    before = page.stat().st_mtime_ns
    build(site)
    assert page.stat().st_mtime_ns == before
    file.unlink()
    assert build(site).pages == len(list((site[0] / "build/site").rglob("*.html")))
    assert "Reads the pulse." not in page.read_text()
    assert "A third secret" in page.read_text()
