"""The data of pages, and the contents of the pages of a small model."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from lxml.html import fromstring

from portal import diagrams, search
from portal.dossier import dossier_page
from portal.highlight import highlighted_lines
from portal.links import Links, slug
from portal.measured_pages import driver_coverage, missed_lines
from portal.names import VERDICTS, unbroken_options
from portal.navigation import DOCS
from portal.pages import all_pages, trees, uses
from portal.paper_views import (
    COMMON_CHECKS,
    MACHINE_CHECKS,
    ROLE_CHECKS,
    compared,
    families,
    hidden_names,
)
from portal.portal import Portal
from portal.requirement_pages import Row, aligned, outside_tree, requirement_page, shortened
from portal.tuned_values import chosen_values, other_lines
from portal.tuning_page import control_values
from portal.verification_views import (
    CoverageRow,
    Share,
    coverage_of,
    coverage_rows,
    facets,
    facets_of_test,
    measured_lines,
    options,
)
from tests.python.portal.fixture import MODES, REPORT, make_model, make_project
from tests.python.portal.page_reader import Shown, read_page
from traceability.checks.registry import CHECKS as CHECKS_OF_PROJECT
from traceability.checks.registry import Check
from traceability.model.design_model import Model
from traceability.reading.comparison_record import Comparison, Difference
from traceability.reading.published import OUTCOMES, Published
from traceability.reading.seeded_faults import Fault, Outcome
from traceability.schema import (
    HOST,
    VIRTUAL_K64,
    BindingResult,
    BuildEvidence,
    Call,
    Constant,
    Counts,
    Function,
    LastRecord,
    LintRun,
    MethodCoverage,
    Place,
    ProofProperty,
    ProofResult,
    Proofs,
    SourceReference,
    TreeNode,
    Tuned,
)

pytestmark = pytest.mark.reads("site", "sim/faults", "sim/plant")

ROOT = Path(__file__).parents[3]
CHECKS = [
    Check("tree-static", "Possible", "Each edge is one.", "runs.", "call it."),
    Check("link-site", "Links", "Each has one.", "others.", "fix it."),
]
OUTCOME = Outcome("a-1", "tree-static", "Says.", "src/a.cpp", 1, True, True, ["found"])


def shown(root: Path, model: Model) -> dict[str, Shown]:
    portal = Portal(root, model, REPORT, CHECKS)
    return {page.name: read_page(page.body) for page in all_pages(portal)}


@pytest.fixture(scope="module")
def portal(tmp_path_factory: pytest.TempPathFactory) -> Portal:
    root = tmp_path_factory.mktemp("project")
    return Portal(root, make_project(root), REPORT, CHECKS)


@pytest.fixture(scope="module")
def pages(portal: Portal) -> dict[str, Shown]:
    return {page.name: read_page(page.body) for page in all_pages(portal)}


# ---- data of pages ------------------------------------------------------------


def test_a_derived_class_overrides_operations_of_its_base(portal: Portal) -> None:
    family = families(portal)[0]
    seen = [(one.module.name, one.depth, len(one.own), len(one.overridden)) for one in family]
    assert seen == [("Mode", 0, 1, 0), ("RC", 1, 0, 1)]


def test_the_checks_of_a_change_exist() -> None:
    known = {check.id for check in CHECKS_OF_PROJECT}
    assert {*COMMON_CHECKS, *MACHINE_CHECKS, *ROLE_CHECKS} <= known


def test_hidden_names_have_their_kind(portal: Portal) -> None:
    hides = ["RC::kPause", "remote/Pulse.hpp", "Pulse"]
    rc = replace(portal.model.modules["RC"], registers=["uart"], hides=hides)
    assert hidden_names(rc) == {
        "registers": ["uart"],
        "constants": ["RC::kPause"],
        "headers": ["remote/Pulse.hpp"],
        "types": ["Pulse"],
    }


@pytest.mark.parametrize(
    ("place", "expected"),
    [
        (2, [("MainController::read",) * 2, ("", "Pipe::read"), ("RC::read", "RC::read")]),
        (
            None,
            [("MainController::read",) * 2, ("RC::read", ""), ("", "Pipe::read"), ("", "RC::read")],
        ),
    ],
)
def test_a_node_is_on_the_row_of_the_call_that_it_matches(
    portal: Portal, place: int | None, expected: list[tuple[str, str]]
) -> None:
    requirement = make_model().requirements["FR-15"]
    requirement.runs[HOST].places[1] = place
    rows = aligned(portal, requirement, requirement.runs[HOST])
    assert [(row.node.label if row.node else "", row.call) for row in rows] == expected


def test_a_module_has_first_its_own_tests_then_those_of_its_requirements(portal: Portal) -> None:
    model = make_model()
    test = model.tests["RcTest.Reads"]
    own = Place(f"tests/{MODES}/RCTest.cpp", 3)
    model.tests["Robot.Drives"] = replace(test, id="Robot.Drives", verifies=[])
    model.tests["RCTest.Own"] = replace(test, id="RCTest.Own", verifies=[], place=own)
    rc = replace(model.modules["RC"], tests=["Robot.Drives", "RcTest.Reads", "RCTest.Own"])
    found = Portal(portal.root, model, REPORT, CHECKS).own_tests(rc)
    assert [one.id for one in found] == ["RCTest.Own", "RcTest.Reads"]


def test_missed_lines_of_drivers_are_joined(portal: Portal) -> None:
    assert driver_coverage(portal) is None
    lines = {"a.cpp": {1: True, 3: False, 5: False, 6: True, 7: False}}
    model = replace(portal.model, board_lines=lines)
    covered = driver_coverage(Portal(portal.root, model, REPORT, CHECKS))
    assert covered
    (file,) = covered
    assert (file.executed, file.lines) == (2, 5)
    assert [missed.place for missed in file.missed] == [Place("a.cpp", 3, 5), Place("a.cpp", 7, 7)]


def test_missed_lines_show_their_functions_and_requirements(portal: Portal) -> None:
    model = portal.model
    body = Place("src/k64/a.cpp", 2, 4)
    rc = model.modules["RC"]
    read = replace(rc.methods[0], body=body, satisfies=["FR-15"])
    call = Call(read.id, False, Place("src/k64/a.cpp", 8), [read.id])
    model = replace(
        model,
        modules={**model.modules, "RC": replace(rc, methods=[read])},
        functions={"start": Function("start", Place("src/k64/a.cpp", 7, 9), [call])},
    )
    in_method = missed_lines(model, Place("src/k64/a.cpp", 4, 5))
    assert (in_method.functions, in_method.requirements) == ([read.id], ["FR-15"])
    in_function = missed_lines(model, Place("src/k64/a.cpp", 8, 8))
    assert (in_function.functions, in_function.requirements) == (["start"], ["FR-15"])
    assert missed_lines(model, Place("src/k64/a.cpp", 5, 6)).functions == []


def test_a_check_leads_to_the_values_that_it_examines(portal: Portal) -> None:
    check = replace(CHECKS[0], result="execution.html#stack")
    found = Portal(portal.root, portal.model, REPORT, [check, CHECKS[1]])
    (page,) = (page for page in all_pages(found) if page.name == f"checks/{check.id}")
    assert read_page(page.body).links["@/execution.html#stack"] == "Execution: stack"


def test_the_methods_outside_of_a_tree(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    requirement = replace(
        model.requirements["FR-15"], satisfied_by=["RC::read", "RC::tick", "Other::read"]
    )
    assert outside_tree(model, requirement) == ["RC::tick", "Other::read"]
    requirements = {**model.requirements, "FR-15": requirement}
    portal = Portal(tmp_path, replace(model, requirements=requirements), REPORT, [])
    sheet = read_page(dossier_page(portal, requirement).body).text
    assert "RC::tick (not in the tree)" in sheet
    assert "RC::read (not in the tree)" not in sheet
    page = read_page(requirement_page(portal, requirement).body).text
    assert "A tree contains only calls that begin at its root." in page
    assert outside_tree(model, replace(requirement, tree=None)) == []
    abstract = TreeNode("Mode::read", "Mode", "read", None, "root", Place("a.tree", 1))
    assert "RC::read" not in outside_tree(model, replace(requirement, tree=abstract))


def test_a_sheet_shows_the_marks_of_its_tree_and_its_proofs(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    requirement = model.requirements["FR-15"]
    assert requirement.tree
    (read,) = requirement.tree.children
    read = replace(read, often="?", executed={}, outside=[HOST])
    requirement = replace(requirement, tree=replace(requirement.tree, children=[read]))
    proof = ProofProperty("a", "FR-15", "It always reads.", "[] a", Place("a.toml", 1))
    proofs = Proofs({"a": proof}, {"a": ProofResult("proven", 1, 1, 1.0)})
    model = replace(model, requirements={"FR-15": requirement}, proofs=proofs)
    sheet = read_page(dossier_page(Portal(tmp_path, model, REPORT, []), requirement).body).text
    assert "RC::read under a condition yes not on the host" in sheet
    assert "It always reads. a: proven" in sheet


def test_an_inherited_method_is_found_at_its_base() -> None:
    model = make_model()
    model.modules["RC"] = replace(model.modules["RC"], methods=[])
    assert Links(model, set()).method("RC::read") == "@/modules/Mode.html#m-read"


def test_texts_link_the_names_in_them(portal: Portal) -> None:
    text = read_page(portal.names.text("Calls `RC::read` of MainController, not of Nothing."))
    found = {address.removeprefix("@/modules/") for address in text.links}
    assert found == {"RC.html", "RC.html#m-read", "MainController.html"}


def test_a_diagram_that_cannot_be_drawn_is_an_error(tmp_path: Path) -> None:
    broken = diagrams.Diagram("broken", "Broken", "@startuml\nclass {{{ \n@enduml")
    with pytest.raises(diagrams.DiagramError):
        diagrams.draw([broken], tmp_path)


def test_highlighted_lines_keep_the_text() -> None:
    text = '/* two\nlines */ const char* a = "<b>";\n'
    lines = highlighted_lines("a.cpp", text)
    assert ["".join(read_page(line).parts) for line in lines] == text.splitlines()


def test_the_search_has_every_kind(portal: Portal) -> None:
    groups = {entry[0] for entry in search.entries(portal)}
    assert {"Modules", "Methods", "Requirements", "Tests", "Checks", "Source", "Pages"} <= groups


def test_a_check_that_needs_fresh_results_does_not_hold_without_them(portal: Portal) -> None:
    assert [check for check in portal.checks if portal.is_later(check)] == ["link-site"]
    assert "holds" in portal.verdict_of("tree-dynamic")
    stale = Portal(portal.root, replace(portal.model, results_hashes={HOST: None}), REPORT, CHECKS)
    assert "no fresh results" in stale.verdict_of("tree-dynamic")


# ---- contents of pages --------------------------------------------------------


@pytest.mark.parametrize(
    ("page", "headings", "texts", "links"),
    [
        (
            "modules/RC",
            ["RC"],
            ["The secret of RC", "Concrete State", "The name is RC"],
            ["requirements/FR-15.html", "patterns/reading-modes.html", "modules/Mode.html"],
        ),
        (
            "changes/reading-modes",
            [],
            ["Derive from Mode", "Construct it in a composition.", "3 modules that are"],
            ["requirements/FR-15.html"],
        ),
        ("requirements/FR-15", [], ["The system shall wait.", "Why."], ["modules/RC.html#m-read"]),
        ("concordance", [], ["CR"], ["modules/RC.html", "machines.html#reading-modes"]),
        ("products", [], ["reads the enable switch", "can pass ./wr bring-up", "yes", "no"], []),
        ("checks/tree-static", [], ["Each edge is one.", "holds"], []),
        ("checks/link-site", [], ["This check runs after the pages are written"], []),
    ],
)
def test_a_page_leads_on(
    pages: dict[str, Shown], page: str, headings: list[str], texts: list[str], links: list[str]
) -> None:
    found = pages[page]
    assert set(headings) <= set(found.headings)
    assert [text for text in texts if text not in found.text] == []
    assert [link for link in links if f"@/{link}" not in found.links] == []


@pytest.mark.parametrize("page", ["mutation", "requirements/FR-15", "products"])
def test_a_page_says_what_was_not_measured(pages: dict[str, Shown], page: str) -> None:
    assert "these sources" in pages[page].text


def test_each_target_has_a_result_of_its_own(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    first = model.tests["RcTest.Reads"]
    results = first.results | {VIRTUAL_K64: BindingResult("failed", 30.0, "expected 1")}
    model.tests["Robot.Drives"] = replace(first, id="Robot.Drives", results=results)
    model.requirements["FR-15"].verified_by.append("Robot.Drives")
    found = shown(tmp_path, model)
    assert "2 of 3 runs passed" in found["tests"].text
    assert "expected 1" in found["tests"].text
    (row,) = [row for row in found["requirements/index"].rows if row and "FR-15" in row[0]]
    assert [cell for cell in row if "/" in cell] == ["2/2", "0/1"]


def test_the_last_change_is_the_newest_commit_of_a_day(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    changes = {"new.cpp": "2026-01-02 1aa", "old.cpp": "2026-01-02 9bb"}
    monkeypatch.setattr("portal.portal.last_changes", lambda _root: changes)
    portal = Portal(tmp_path, make_project(tmp_path), REPORT, [])
    assert portal.last_change(["old.cpp", "new.cpp"]) == "2026-01-02 1aa"
    assert portal.last_change(["old.cpp"]) == "2026-01-02 9bb"
    assert portal.last_change(["none.cpp"]) == ""


def test_stale_results_are_not_shown(tmp_path: Path) -> None:
    stale = replace(make_project(tmp_path), results_hashes={HOST: "older"})
    text = shown(tmp_path, stale)["tests"].text
    assert "older than the sources" in text
    assert "runs passed" not in text


def test_lines_that_only_the_virtual_k64_executed_are_shown_with_their_target(
    tmp_path: Path,
) -> None:
    model = make_project(tmp_path)
    rows = [
        MethodCoverage("RC::read", Place("src/RC.cpp", 3, 5), {3: True, 4: True}, None),
        MethodCoverage("Mode::read", Place("src/Mode.cpp", 3, 5), {3: True, 4: False}, None),
    ]
    requirement = replace(model.requirements["FR-15"], coverage={HOST: [], VIRTUAL_K64: rows})
    model.requirements["FR-15"] = requirement
    assert measured_lines(requirement) == (VIRTUAL_K64, Share(3, 4))
    found = shown(tmp_path, model)
    assert "lines executed 3/4" in found["requirements/FR-15"].text
    assert "by these tests on the virtual K64" in found["requirements/FR-15"].text
    (row,) = [row for row in found["requirements/index"].rows if row and "FR-15" in row[0]]
    assert "3/4 virtual K64" in row
    on_both = replace(requirement, coverage={HOST: rows[:1], VIRTUAL_K64: rows})
    assert measured_lines(on_both) == (HOST, Share(2, 2))


def test_the_coverage_lists_modules_and_other_files_with_their_total(tmp_path: Path) -> None:
    model, file = make_project(tmp_path), "src/services/assertion.hpp"
    assert coverage_rows(model) == [
        CoverageRow("RC", Share(1, 2), Share(1, 2), [Place(str(model.modules["RC"].source), 3)]),
        CoverageRow(file, Share(2, 2), Share(0, 0), []),
    ]
    assert coverage_of(model, "Mode", ["src/Mode.hpp"]) is None
    uncounted = {file: replace(model.host_files[file], branches=None)}
    assert coverage_of(replace(model, host_files=uncounted), file, [file]) == CoverageRow(
        file, Share(2, 2), None, []
    )
    rows = shown(tmp_path, model)["requirements/index"].rows
    assert ["RC", "1/2 lines", "1/2 branches", "RC.cpp:3"] in rows
    assert ["assertion.hpp", "2/2 lines", "no branches", "\N{EN DASH}"] in rows
    total = "all files: 75.0 % of the lines, 50.0 % of the branches"
    assert [total, "3/4 lines", "1/2 branches", "\N{EN DASH}"] in rows


def test_a_source_page_states_that_no_line_is_measured(pages: dict[str, Shown]) -> None:
    missing = "No executed line of this file is measured."
    folder = "source/src/main_control/operation_modes"
    assert missing in pages[f"{folder}/RC.hpp"].text
    assert missing not in pages[f"{folder}/RC.cpp"].text


def test_the_evidence_shows_the_static_analysis_only_for_the_present_files(tmp_path: Path) -> None:
    build = BuildEvidence("c0ffee", [], "Linux", 4, {}, {}, [])
    model = replace(make_project(tmp_path), build=build)
    title = "static analysis (./wr lint)"
    assert f"{title} not run in this build" in shown(tmp_path, model)["evidence"].text
    run = LintRun("c0ffee", {"ruff": "passed", "clang-tidy": "not run", "mypy": "passed"})
    text = shown(tmp_path, replace(model, build=replace(build, lint=run)))["evidence"].text
    lint = "clang-tidy passed: ruff, mypy on the present files, at commit c0ffee"
    assert f"{title} not run: {lint}" in text


def test_the_evidence_shows_the_tests_of_the_tools_that_ran(tmp_path: Path) -> None:
    results = {"model": Counts(7, 1), "reading": None, "tools": None}
    build = BuildEvidence("c0ffee", [], "Linux", 4, {}, {}, [], tool_tests=results)
    text = shown(tmp_path, replace(make_project(tmp_path), build=build))["evidence"].text
    assert "model: 7 passed, 1 failed not run on these sources: reading, tools" in text
    assert "No test was repeated." in text
    build = replace(build, repeated=["test_a.py::test_b"], long_tests={"test_c.py": 2})
    text = shown(tmp_path, replace(make_project(tmp_path), build=build))["evidence"].text
    assert "Only the second result of each test counts: test_a.py::test_b." in text
    assert "The long tests are 2 test functions in these files: test_c.py." in text


def test_an_image_for_recordings_is_explained_where_it_is_shown(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    explained = "weeding_robot_paper_calls: a firmware image for recordings"
    before = shown(tmp_path, model)
    assert [name for name, page in before.items() if explained in page.text] == []
    run = BindingResult("passed", 1.0, images=["weeding_robot_paper", "weeding_robot_paper_calls"])
    model.tests["RcTest.Reads"] = replace(model.tests["RcTest.Reads"], results={VIRTUAL_K64: run})
    after = shown(tmp_path, model)
    assert {"tests", "requirements/FR-15", "modules/RC"} <= {
        name for name, page in after.items() if explained in page.text
    }


def test_the_list_of_checks_counts_those_that_run_after_the_pages(pages: dict[str, Shown]) -> None:
    assert "This run: without findings: 1, after the pages: 1." in pages["checks/index"].text
    assert "run after the pages are written" in pages["checks/index"].text


@pytest.mark.parametrize(
    ("recorded", "sentence"),
    [
        (LastRecord("check --drift", "c0ffee", 1, 1, False, "2026-11-25"), "At least 2 of the 3"),
        (LastRecord("check --drift", "c0ffee", 3, 3, False, "2026-11-25"), ""),
        (OUTCOME, "2 of the 3"),
        (None, ""),
    ],
)
def test_listed_faults_that_are_not_in_the_record_are_counted(
    tmp_path: Path, recorded: LastRecord | Outcome | None, sentence: str
) -> None:
    model = make_project(tmp_path)
    faults = [Fault(f"a-{number}", "tree-static", "Says.") for number in range(3)]
    model = replace(
        model,
        faults=faults,
        outcomes=[recorded] if isinstance(recorded, Outcome) else None,
        last={"drift": recorded} if isinstance(recorded, LastRecord) else {},
    )
    text = shown(tmp_path, model)["checks/drift"].text
    assert ("listed faults are not in this record" in text) == bool(sentence)
    assert sentence in text
    assert ("At least" in text) == sentence.startswith("At least")


def test_explanations_have_a_group_of_their_own(tmp_path: Path) -> None:
    model = make_project(tmp_path)
    (tmp_path / "docs" / "glossary.rst").write_text("Glossary\n========\n")
    (tmp_path / "docs" / "quick_start.rst").write_text("Quick start\n===========\n")
    navigation = Portal(tmp_path, model, REPORT, CHECKS).navigation
    groups = {group.id: [entry.title for entry in group.entries] for group in navigation.groups}
    assert groups["explain"] == ["Glossary"]
    assert groups["build"].index("Quick start") < groups["build"].index("Tour"), "not in DOCS"


def test_each_hand_written_page_of_the_navigation_exists() -> None:
    names = {name for group in DOCS.values() for name in group}
    assert names <= {page.stem for page in (ROOT / "docs").glob("*.rst")}


def test_many_calls_between_two_nodes_are_one_row() -> None:
    node = TreeNode("RC::read", "RC", "read", None, "root", Place("a.tree", 1))
    rows = [Row(node=node), *(Row(call=f"RC::step{n}") for n in range(9)), Row(node=node)]
    assert [row.call for row in shortened(rows)] == ["", "9 calls", ""]
    assert len(shortened(rows[:5])) == 5


# ---- two commits ------------------------------------------------------------------


def test_the_differences_of_two_commits_have_a_page(tmp_path: Path) -> None:
    words = Difference("text of requirements", "FR-15", "shall [-wait-] {+stop <b>+}")
    project = make_project(tmp_path)
    portal = Portal(tmp_path, project, REPORT, CHECKS)
    (none,) = (page.body for page in all_pages(portal) if page.name == "differences")
    assert "no comparison" in none
    compared = Comparison("a" * 40, "b" * 40, [words], ["a" * 40])
    portal = Portal(tmp_path, replace(project, comparison=compared), REPORT, CHECKS)
    (body,) = (page.body for page in all_pages(portal) if page.name == "differences")
    edits = [(edit.tag, edit.text_content()) for edit in fromstring(body).iter("del", "ins")]
    assert edits == [("del", "wait"), ("ins", "stop <b>")]
    page = read_page(body)
    assert page.links["@/requirements/FR-15.html"] == "FR-15"
    assert "not compared" in page.text


def test_the_tests_are_filtered_by_their_values(portal: Portal) -> None:
    test = portal.model.tests["RcTest.Reads"]
    facets = facets_of_test(test, portal.model, ["RC"])
    assert facets["requirement"] == ["FR-15"]
    assert (facets["module"], facets["level"]) == (["RC"], ["high"])
    assert facets["target"] == list(test.results)
    assert facets["folder"] == ["/".join(test.place.file.split("/")[1:-1])]
    found = options([{"requirement": ["FR-10", "SR-1"]}, {"requirement": ["FR-2"]}])
    assert found == {"requirement": ["FR-2", "FR-10", "SR-1"]}


def test_the_filter_of_the_requirements_offers_each_state_with_its_number(portal: Portal) -> None:
    (body,) = (page.body for page in all_pages(portal) if page.name == "requirements/index")
    counts = {
        state: int(number)
        for state, number in re.findall(r'<option value="(\w+)">[a-z ]+: (\d+)</option>', body)
    }
    states = [verdict.state for verdict in REPORT.requirements.values()]
    assert counts == {state: states.count(state) for state in VERDICTS}
    assert 0 in counts.values()


def test_the_filter_of_the_requirements_finds_those_whose_tests_pass_on_one_target(
    tmp_path: Path,
) -> None:
    model = make_project(tmp_path)
    requirement, test = model.requirements["FR-15"], model.tests["RcTest.Reads"]
    assert facets(model, REPORT, requirement)["binding"] == [HOST, "only host"]
    address = "@/requirements/index.html?binding=only+host"
    assert address in shown(tmp_path, model)["index"].links
    passed = BindingResult("passed", 1.0)
    model.tests["RcTest.Reads"] = replace(test, results={HOST: passed, VIRTUAL_K64: passed})
    assert facets(model, REPORT, requirement)["binding"] == [HOST, VIRTUAL_K64]
    assert address not in shown(tmp_path, model)["index"].links
    model.tests["RcTest.Reads"] = replace(test, results={VIRTUAL_K64: passed})
    assert facets(model, REPORT, requirement)["binding"] == [VIRTUAL_K64, "only virtual K64"]


def test_the_filter_of_the_requirements_finds_those_with_only_one_kind_of_source() -> None:
    model = make_model()
    requirement = model.requirements["FR-15"]
    decision, goal = SourceReference("decision", "so"), SourceReference("goal", "SG-1")
    derived = replace(requirement, sources=[decision, decision])
    assert facets(model, REPORT, derived)["source"] == ["decision", "only decision"]
    both = replace(requirement, sources=[decision, goal])
    assert facets(model, REPORT, both)["source"] == ["decision", "goal"]


def test_the_values_to_tune_have_their_lines_and_what_they_were_chosen_for() -> None:
    place = Place("src/wheel_control/A.cpp", 7)
    constants = {
        "A::kGains.integral": Constant(2094, "", place),
        "A::kCount": Constant(3, "", place),
        "A::kLimit": Constant(9, "mA", place),
        "B::kBaud": Constant(115200, "baud", Place("src/k64/B.cpp", 1)),
    }
    tuned = [Tuned("SystemConstants::winding", "It is.", ["A::kGains"], place)]
    found = control_values(replace(make_model(), constants=constants, tuned=tuned))
    assert [(name, chosen_for) for name, _, chosen_for in found["A"]] == [
        ("A::kGains.integral", ["SystemConstants::winding"]),
        ("A::kLimit", []),
    ]
    assert list(found) == ["A"]


def test_the_values_to_choose_again_are_listed_by_module_with_their_numbers(tmp_path: Path) -> None:
    folder = tmp_path / "client"
    folder.mkdir()
    (folder / "orders.py").write_text("import time\n\nEVERY_S = 0.1  # period\n")
    place = Place("src/wheel_control/A.cpp", 7)
    model = replace(
        make_model(),
        constants={
            "A::kGains.integral": Constant(2094, "uV per 0.1 rpm", place),
            "A::kTrack": Constant(1.582, "m", place),
            "B::kMost": Constant(176, "0.1 rpm", place),
        },
    )
    constants = ["A::kGains", "B::kMost", "A::kTrack", "C::kUnknown"]
    lines = ["client/orders.py: EVERY_S", "client/orders.py: EVERY"]
    tuned = Tuned("SystemConstants::winding", "It is.", constants, place, lines)
    found = chosen_values(tmp_path, model, tuned)
    assert {module: [one[:2] for one in ones] for module, ones in found.items()} == {
        "A": [("kGains", "integral 2094 uV per 0.1 rpm"), ("kTrack", "1.582 m")],
        "B": [("kMost", "17.6 rpm")],
        "C": [("kUnknown", "")],
    }
    assert other_lines(tmp_path, tuned) == [
        (Place("client/orders.py", 3), "EVERY_S = 0.1  # period")
    ]


def test_a_cell_of_the_matrix_of_uses_leads_to_the_row_with_its_reason(
    portal: Portal, pages: dict[str, Shown]
) -> None:
    found = uses(portal)
    assert list(found["labels"]) == ["main_control", MODES]
    assert list(found["cells"]) == [("main_control", MODES)]
    row = f"#use-{slug(f'main_control--{MODES}')}"
    assert pages["uses"].links[row] == "1"  # number of source lines with this use
    assert pages["uses"].rows[-1][2] == "it reads"


def test_the_event_of_a_transition_leads_to_the_operation_of_the_state(
    pages: dict[str, Shown],
) -> None:
    shown = pages["machines"]
    assert shown.links["@/modules/RC.html#m-read"] == "noMessage"
    assert "The state machine begins in RC. A guard uses old values." in shown.text


def test_the_index_of_the_trees_leads_to_each_tree(portal: Portal, pages: dict[str, Shown]) -> None:
    declared = [one for one in portal.model.requirements.values() if one.tree]
    assert declared
    for requirement in declared:
        assert pages["trees"].links[f"#tree-{requirement.id}"] == requirement.id
    assert "Reading 1 tree" in pages["trees"].headings  # the heading of a section with one tree


def test_a_tree_has_the_modules_of_its_nodes_as_filter(portal: Portal) -> None:
    facets = trees(portal)["facets"]
    nodes = portal.flat(portal.model.requirements["FR-15"].tree)  # type: ignore[arg-type]  # it has a tree
    assert set(facets["FR-15"]["module"]) <= {node.module for _, node in nodes}
    assert facets["FR-15"]["module"]


def test_each_module_leads_to_its_neighbours(portal: Portal, pages: dict[str, Shown]) -> None:
    names = [module.name for module in portal.designs]
    for before, name in pairwise(names):
        assert pages[f"modules/{name}"].links[portal.links.module(before) or ""] == before
        assert pages[f"modules/{before}"].links[portal.links.module(name) or ""] == name


@pytest.mark.parametrize(
    ("inputs", "text"),
    [
        ({"link": 20, "robot": 3}, "20 long random inputs for the PC link and 3"),
        ({"frames": 100, "link": 20, "robot": 3}, "100 short random inputs, each for the PC link"),
    ],
)
def test_the_page_of_robustness_shows_the_inputs_of_each_fuzzer_of_a_record(
    tmp_path: Path, inputs: dict[str, int], text: str
) -> None:
    outcomes = {"inputs": sum(inputs.values()), "failures": 0}
    result = {"identity": "1", "outcomes": outcomes, "inputs": inputs, "failures": []}
    fuzz = Published("./wr campaign fuzz", "abc", "2026-01-01", result)
    model = replace(make_project(tmp_path), campaigns={"fuzz": fuzz})
    assert text in " ".join(shown(tmp_path, model)["robustness"].text.split())


def test_the_tiles_of_the_page_of_robustness_add_up_to_the_number_of_faults(tmp_path: Path) -> None:
    counts = dict(zip(OUTCOMES, (50107, 40847, 8000, 460, 3, 583), strict=True))
    faults: dict[str, Any] = {"identity": "1", "cases": 100000, "outcomes": counts, "silent": []}
    faults |= {"kinds": {"ram": counts}, "modules": {"RC": counts}, "safe_after": None}
    record = Published("./wr campaign faults", "abc", "2026-01-01", faults)
    model = replace(make_project(tmp_path), campaigns={"faults": record})
    page = shown(tmp_path, model)["robustness"]
    tiles = page.text.partition("Recorded by")[0]
    for number in (faults["cases"], *counts.values()):
        assert tiles.split().count(f"{number:,}") == 1
    assert f"all kinds {faults['cases']:,} " in " ".join(page.text.split())


def test_the_page_of_robustness_explains_the_kinds_and_the_limits(tmp_path: Path) -> None:
    counts = dict(zip(OUTCOMES, (3962, 9, 1464, 2, 3, 4), strict=True))
    faults: dict[str, Any] = {"identity": "1", "cases": 5444, "outcomes": counts, "silent": []}
    faults |= {"kinds": {"flash": counts, "sensor": counts}, "modules": {}, "safe_after": None}
    record = Published("./wr campaign faults", "abc", "2026-01-01", faults)
    model = replace(make_project(tmp_path), campaigns={"faults": record})
    faults_of_campaign = ("faults/InjectedFault.hpp", "faults/InjectedFault.cpp")
    for file in (*faults_of_campaign, "faults/Verdict.hpp", "plant/Robot.hpp"):
        copied = tmp_path / "sim" / file
        copied.parent.mkdir(parents=True, exist_ok=True)
        copied.write_text((ROOT / "sim" / file).read_text(encoding="utf-8"), encoding="utf-8")
    text = " ".join(shown(tmp_path, model)["robustness"].text.split())
    assert "flash a changed bit of the firmware image in flash" in text
    assert "noise on the serial line" not in text, "the record has no fault of this kind"
    assert "The 3,962 harmless faults of the flash have no effect until the next reset." in text
    assert "1,464 of the 5,444 faults of sensors were detected late." in text
    assert "edges of a wheel are lost (1 to 60, in edges per second)" in text
    assert "The limits are 5 % of the supply voltage for the voltage of a wheel" in text
    assert "wrong for more than 300 ms before the detection" in text


def test_a_change_that_an_extension_makes_names_two_products(portal: Portal) -> None:
    change = next(iter(portal.model.changes.values()))
    bluetooth = replace(portal.model.modules["RC"], name="Bluetooth", logic="extensions/bluetooth")
    portal.model.modules["Bluetooth"] = bluetooth  # type: ignore[index]  # frozen
    try:
        found = compared(portal, replace(change, examples=["Bluetooth"], made=None))
    finally:
        del portal.model.modules["Bluetooth"]  # type: ignore[attr-defined]  # frozen
    assert found
    assert (found.before, found.after) == ("weeding_robot_pc", "weeding_robot_pc_bluetooth")
    assert compared(portal, replace(change, examples=[], made=None)) is None


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("void read(int order) override", "read(int order)"),
        ("virtual bool read() const = 0", "read() const → bool"),
        ("static Mode& read()", "static read() → Mode&"),
        ("explicit read(int order)", "read(int order)"),
    ],
)
def test_the_name_of_a_method_comes_first_in_its_signature(
    portal: Portal, written: str, read: str
) -> None:
    method = replace(portal.model.modules["RC"].methods[0], name="read", signature=written)
    shown = fromstring(f"<p>{portal.names.signature(method)}</p>")
    assert shown.text_content() == read
    assert [bold.text_content() for bold in shown.iter("b")] == ["read"]


def test_each_option_in_code_is_marked_as_one_word() -> None:
    shown = fromstring(unbroken_options("<p><code>./wr drive --link -v a-b</code> but-not --this"))
    assert [word.text_content() for word in shown.iter("span")] == ["--link", "-v"]
