"""A requirement is verified only if its tests passed and executed the code of the requirement."""

from __future__ import annotations

import json
import shutil
import struct
from pathlib import Path

import jsonschema
import pytest

from tests.python.model.small_tree import write_tree
from tests.python.project_files import replace_in, write_files
from tests.python.reading.task_records import record_task
from traceability.checks import run_checks
from traceability.exports.verification_table import junit, schema_text, table
from traceability.model.build import build
from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.model.reviews import LinkTexts, write_baseline
from traceability.reading.result_cache import cached_result, code_of
from traceability.reading.results import RESULTS, TOTALS
from traceability.reading.task_record import IMAGES, TESTS_TRACE
from traceability.reading.traces import EXIT, SOURCES
from traceability.schema import HOST

CALLS = [
    "MainController::read",
    "OperationState::read",
    "Working::actionNoMsg",
    "MainController::changeOpState",
]
TEST = "Working.WaitsWithoutMessage"
STATES = "src/main_control/operation_states"


def write_results(root: Path, result: str = "COMPLETED") -> None:
    """Writes the results of a run of the test with the present sources."""
    suite, case = TEST.split(".")
    record = {"name": case, "status": "RUN", "result": result, "time": "0.002s"}
    suites = {"testsuites": [{"name": suite, "testsuite": [record]}]}
    write_files(root, {f"{RESULTS}/trace.json": json.dumps(suites)})
    record_task(root, TESTS_TRACE, "src", "tests")


def write_trace(root: Path, calls: list[str]) -> None:
    """Writes a recording in which each method of ``calls`` calls the next method."""
    executable = SOURCES[HOST].executable
    write_files(root, {executable: "is no program"})
    state = (root / executable).stat()
    parts = [state.st_mtime_ns, state.st_size, *code_of("reading/traces")]
    cached_result(root / "build/model/symbols-nm.pickle", parts, lambda: dict(enumerate(CALLS)))
    numbers = [CALLS.index(name) for name in calls]
    events = [*numbers, *(number | EXIT for number in reversed(numbers))]
    folder = root / SOURCES[HOST].folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{TEST}.bin").write_bytes(struct.pack(f"<{len(events)}Q", *events))


def record_baseline(root: Path) -> None:
    built = build(root)
    texts = LinkTexts(built.model, built.facts).of(built.model.requirements["FR-15"])
    write_baseline(root, {"FR-15": texts}, ["FR-15"])


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = write_tree(tmp_path_factory.mktemp("verified"))
    write_results(root)
    write_trace(root, CALLS)
    record_baseline(root)
    return root


@pytest.fixture
def tree(sound: Path, tmp_path: Path) -> Path:
    root = Path(shutil.copytree(sound, tmp_path / "tree"))
    write_trace(root, CALLS)
    return root


def checked(root: Path) -> tuple[str, set[str], Model, Report]:
    """Returns the state of the requirement, and the checks that have a finding about it."""
    model, facts = build(root)
    report = run_checks(model, facts)
    checks = {
        one.check for one in report.findings if one.check.startswith(("req-", "tree-", "suspect-"))
    }
    return report.requirements["FR-15"].state, checks, model, report


def test_what_passed_and_executed_its_tree_is_verified(sound: Path) -> None:
    state, _, model, _ = checked(sound)
    assert state == "verified"
    run = model.requirements["FR-15"].runs[HOST]
    assert [(call.depth, call.module, call.declared_by) for call in run.folded] == [
        (0, "MainController", []),
        (1, "OperationState", ["FR-15"]),
        (2, "Working", ["FR-15"]),
        (3, "MainController", ["FR-15"]),
    ]


def test_a_skipped_test_is_not_a_passed_one(tree: Path) -> None:
    write_results(tree, "SKIPPED")
    state, checks, _, _ = checked(tree)
    assert state == "unverified"
    assert "req-passed" in checks


def test_a_test_that_does_not_make_the_calls_does_not_verify(tree: Path) -> None:
    write_trace(tree, CALLS[:2])
    state, checks, _, _ = checked(tree)
    assert state == "unverified"
    assert "tree-dynamic" in checks


def test_a_finding_about_old_results_is_at_a_source(tree: Path) -> None:
    write_results(tree)
    replace_in(tree / "src/main_control/MainController.cpp", "\n", "\n\n")
    built = build(tree)
    findings = run_checks(built.model, built.facts).findings
    places = [one.place for one in findings if one.check == "req-stale"]
    assert [place.file for place in places] == ["requirements/reading.dox"]
    assert "FR-15" in (tree / places[0].file).read_text().splitlines()[places[0].line - 1]


def test_a_test_of_another_requirement_does_not_verify(tree: Path) -> None:
    replace_in(tree / "tests/main_control/WorkingTest.cpp", "@verifies FR-15", "@verifies FR-16")
    write_results(tree)
    state, checks, _, _ = checked(tree)
    assert state == "unverified"
    assert {"req-verified", "req-unknown", "suspect-test"} <= checks


def test_a_changed_text_is_suspect_in_the_exports_too(tree: Path) -> None:
    replace_in(tree / "requirements/reading.dox", "any source", "the PC")
    state, checks, model, report = checked(tree)
    assert state == "suspect"
    assert "suspect-requirement" in checks
    exported = json.loads(json.dumps(table(model, report)))
    jsonschema.Draft202012Validator(json.loads(schema_text())).validate(exported)
    row = exported["requirements"][0]
    assert (row["id"], row["state"]) == ("FR-15", "suspect")
    assert row["reviews"] == []
    assert row["tests"] == {TEST: {HOST: "passed"}}
    top = junit(model, report)
    assert (top.get("tests"), top.get("failures")) == ("1", "1")


def test_a_changed_justification_of_lines_makes_the_requirement_suspect(tree: Path) -> None:
    path = tree / "design" / "justified.toml"
    path.parent.mkdir(exist_ok=True)
    entry = '[[line]]\nnames = ["Working::actionNoMsg"]\nwhy = "No test needs the last line."\n'
    before = path.read_text() if path.exists() else ""
    path.write_text(before + entry)
    record_baseline(tree)
    assert "suspect-test" not in checked(tree)[1]
    replace_in(tree / "design/justified.toml", "the last line", "any line")
    state, checks, _, _ = checked(tree)
    assert state == "suspect"
    assert "suspect-test" in checks


def test_an_image_that_is_older_than_the_sources_is_a_finding(tree: Path) -> None:
    record = tree / TOTALS
    record.write_text('{"flash": 1000, "ram": 500}')
    record_task(tree, IMAGES, "src")

    def says() -> list[str]:
        findings = run_checks(*build(tree)).findings
        texts = [one.text for one in findings if one.check == "req-stale"]
        return [text for text in texts if "image" in text]

    assert says() == []
    source = next((tree / STATES).glob("*.cpp"))
    source.write_text(source.read_text() + "\n// Changed.\n")
    assert says() == [
        "the firmware image is older than the sources, so no check compares its size and stack"
    ]
