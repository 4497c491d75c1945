"""The model that is built from a small folder of sources."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from tests.python.project_files import write_files
from tests.python.reading.task_records import record_task
from traceability.model.build import build, host_files_of, source_files
from traceability.model.design_model import Model
from traceability.reading.coverage import Coverage
from traceability.reading.gcov_arcs import Covered
from traceability.reading.task_record import TESTS_TRACE
from traceability.schema import HOST, BindingResult, FileCoverage


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_tree(tmp_path_factory.mktemp("small"))


@pytest.fixture(scope="module")
def model(tree: Path) -> Model:
    return build(tree).model


def test_texts_come_from_the_comment_above_the_class(model: Model) -> None:
    rc = model.modules["RC"]
    assert rc.brief == "Orders from the RC."
    assert rc.function == "Reads orders from the RC."
    assert rc.secret == "The signal by which the RC shows a new order."
    assert rc.logic == "main_control/operation_modes"
    assert rc.source == "src/main_control/operation_modes/RC.cpp"


def test_bases_heirs_and_abstractness_come_from_the_code(model: Model) -> None:
    assert model.modules["RC"].bases == ["Mode"]
    assert model.modules["Mode"].subclasses == ["PC", "RC"]
    assert model.modules["Mode"].abstract
    assert not model.modules["RC"].abstract


def test_override_without_comment_inherits_the_specification(model: Model) -> None:
    method = next(m for m in model.modules["RC"].methods if m.name == "changeMode")
    assert method.kind == "override"
    assert method.inherited_from == "Mode::changeMode"
    assert [(p.name, p.type, p.text) for p in method.params] == [
        ("mCtrl", "MainController&", "the controller")
    ]
    assert method.satisfies == []


def test_calls_reach_all_overriders(model: Model) -> None:
    read = next(m for m in model.modules["OperationState"].methods if m.name == "read")
    call = next(c for c in read.calls if c.target == "Mode::newMessage")
    assert call.virtual
    assert call.targets == ["Mode::newMessage", "PC::newMessage", "RC::newMessage"]
    change = next(m for m in model.modules["MainController"].methods if m.name == "changeOpState")
    assert list(change.called_by) == ["Waiting::actionNoMsg", "Working::actionNoMsg"]


def test_roles_stand_at_their_lines(model: Model, tree: Path) -> None:
    binding = model.modules["RC"].roles[0]
    line = (tree / binding.place.file).read_text().splitlines()[binding.place.line - 1]
    assert line == "/// @role{reading-modes, Concrete State}"


def test_two_applications_above_one_class(model: Model) -> None:
    states, orders = model.patterns["operation-states"], model.patterns["read-orders"]
    assert states.pattern == "State"
    assert states.changes == "A new state."
    assert orders.pattern == "Template Method"
    assert orders.title == "Read orders in the operation states"
    assert {r.module for r in orders.roles} == {"OperationState", "Working", "Waiting"}


def test_requirement_with_section_method_and_test(model: Model) -> None:
    requirement = model.requirements["FR-15"]
    assert requirement.section == "Reading orders"
    assert requirement.text.endswith("can be read from any source.")
    assert requirement.rationale == "A lost message is not yet a lost link."
    assert requirement.satisfied_by == ["Mode::newMessage", "OperationState::read"]
    assert requirement.verified_by == ["Working.WaitsWithoutMessage"]
    assert model.tests["Working.WaitsWithoutMessage"].gave(None) == [HOST]
    assert model.results_stale


def test_heir_in_a_tree_resolves_to_the_inherited_method(model: Model) -> None:
    tree = model.requirements["FR-15"].tree
    assert tree is not None
    working = tree.children[0]
    assert (working.label, working.resolved) == ("Working::read", "OperationState::read")
    assert working.reachable
    assert working.children[0].reachable
    assert working.ran is None


def test_results_count_only_for_the_sources_they_were_made_from(tree: Path) -> None:
    results = tree / "build" / "results"
    results.mkdir(parents=True, exist_ok=True)
    record = {"name": "WaitsWithoutMessage", "status": "RUN", "result": "COMPLETED"}
    suite = {"name": "Working", "testsuite": [record | {"time": "0.002s"}]}
    (results / "trace.json").write_text(json.dumps({"testsuites": [suite]}))
    record_task(tree, TESTS_TRACE, "src", "tests")
    assert not build(tree).model.results_stale
    test = build(tree).model.tests["Working.WaitsWithoutMessage"]
    recordings = ["Working.WaitsWithoutMessage"]
    assert test.results == {HOST: BindingResult("passed", 2.0, recordings=recordings)}
    path = tree / "src/main_control/operation_modes/RC.cpp"
    path.write_text(path.read_text() + "\n// changed\n")
    assert build(tree).model.results_stale


def test_only_units_that_include_a_changed_header_are_read_again(tmp_path: Path) -> None:
    root = write_tree(tmp_path)
    build(root)
    cache = root / "build" / "model" / "cache"
    before = {path.name: path.stat().st_mtime_ns for path in cache.glob("*.facts")}
    header = root / "src/main_control/operation_modes/RC.hpp"
    header.write_text(header.read_text() + "\n")
    build(root)
    after = {path.name: path.stat().st_mtime_ns for path in cache.glob("*.facts")}
    changed = {name for name, time in after.items() if before[name] != time}
    assert changed == {"src__main_control__operation_modes__RC.cpp.facts"}


def test_callers_include_functions_outside_classes(tmp_path: Path) -> None:
    """Two files contain functions with the same name, and both functions are callers. If a file has
    the name of a class, a function in this file belongs to this class."""
    tree = write_tree(tmp_path)
    folder = tree / "src/main_control"
    calls = "namespace {\nvoid set(MainController& m, Mode& mode) { m.changeMode(mode); }\n}\n\n"
    for name in ("PC", "RC"):
        source = folder / f"operation_modes/{name}.cpp"
        text = source.read_text(encoding="utf-8").replace(
            "mCtrl.changeMode(other_)", "set(mCtrl, other_)"
        )
        source.write_text(text.replace("bool ", f"{calls}bool ", 1), encoding="utf-8")
    free = '#include "main_control/MainController.hpp"\n\nnamespace wr {\n\n'
    free += (
        "void start(MainController& m, Mode& mode) { m.changeMode(mode); }\n\n}  // namespace wr\n"
    )
    (folder / "starting.cpp").write_text(free, encoding="utf-8")
    model = build(tree).model
    change = next(m for m in model.modules["MainController"].methods if m.name == "changeMode")
    assert set(change.called_by) == {"PC::set", "RC::set", "start"}
    assert list(model.functions) == ["start"]


def test_the_coverage_of_a_file_lists_its_missed_lines_and_branches() -> None:
    whole = Covered({"src/a.hpp": {1, 2}}, {"src/a.hpp": {(1, 0), (1, 1), (2, 0)}})
    executed = Covered({"src/a.hpp": {1}}, {"src/a.hpp": {(1, 1), (2, 0)}})
    coverage = Coverage(whole, {"A.B": executed})
    assert host_files_of(coverage, {"src/a.hpp": (2, 4)}) == {
        "src/a.hpp": FileCoverage({1: True, 2: False}, [1], (2, 4))
    }


def test_a_scenario_is_a_source_file(tmp_path: Path) -> None:
    write_files(tmp_path, {"sim/scenario/a.scenario": "at 0 end\n", "sim/a.py": ""})
    assert source_files(tmp_path) == ["sim/scenario/a.scenario"]
