"""The tests in the model. For each test, the model contains the requirements that the test
verifies, the result on each target, and the modules that the test executed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.gtest_cases import Case, read_tests
from traceability.reading.results import (
    bindings_of,
    read_driver_faults,
    read_results,
    read_results_hash,
)
from traceability.reading.source_facts import Facts
from traceability.reading.traces import Traces
from traceability.schema import BINDINGS, HOST, BindingResult, Place, Test
from traceability.sources import files_below

BOARD_TESTS = "tests/sim/emulator/"


def with_tests(model: Model, facts: Facts) -> Model:
    """Returns the model with all tests and their results. For each target that has tests, the model
    also contains the hash of the sources to which the results belong."""
    results = {binding: read_results(facts.root, binding) for binding in BINDINGS}
    cases = written_tests(facts.root)
    tested = {binding for file in cases for binding in bindings_of(file)}
    hashes = {
        binding: read_results_hash(facts.root, binding)
        for binding in BINDINGS
        if binding in tested or binding == HOST
    }
    model = replace(model, results_hashes=hashes)
    tests: dict[str, Test] = {}
    verifying: dict[str, list[str]] = {}
    for file, written in cases.items():
        for case in written:
            comment = facts.comments.at(file, case.line - 1)
            tests[case.id] = Test(
                id=case.id,
                suite=case.suite,
                name=case.name,
                brief=comment.brief,
                place=Place(file, case.line),
                verifies=comment.words("verifies"),
                results={
                    binding: replace(
                        results[binding].get(case.id, BindingResult()),
                        stale=model.stale_on(binding),
                    )
                    for binding in bindings_of(file)
                },
            )
    for test in tests.values():
        for name in test.verifies:
            verifying.setdefault(name, []).append(test.id)
    requirements = {
        name: replace(identifier, verified_by=verifying.get(name, []))
        for name, identifier in model.requirements.items()
    }
    return replace(model, tests=tests, requirements=requirements)


def written_tests(root: Path) -> dict[str, list[Case]]:
    """Returns the tests in each test file that is built for at least one target."""
    files = {str(path.relative_to(root)): path for path in files_below(root, ("tests",), (".cpp",))}
    return {
        file: list(read_tests(path.read_text(encoding="utf-8")))
        for file, path in files.items()
        if bindings_of(file)
    }


def with_board_findings(model: Model, facts: Facts) -> Model:
    """Returns the model with the declared findings of the virtual board. A test belongs to a
    finding if the code of the test contains the id of the finding."""
    making: dict[str, list[str]] = {}
    lines: dict[str, list[str]] = {}
    tests = [test for test in model.tests.values() if test.place.file.startswith(BOARD_TESTS)]
    for test in tests:
        file = test.place.file
        if file not in lines:
            lines[file] = (facts.root / file).read_text(encoding="utf-8").splitlines()
        starts = [other.place.line for other in tests if other.place.file == file]
        end = min((line for line in starts if line > test.place.line), default=None)
        body = "\n".join(lines[file][test.place.line - 1 : end and end - 1])
        for name in facts.declared.board_findings:
            if f'"{name}"' in body:
                making.setdefault(name, []).append(test.id)
    return replace(
        model,
        board_findings={
            name: replace(finding, tests=making.get(name, []))
            for name, finding in facts.declared.board_findings.items()
        },
        beliefs=facts.declared.beliefs,
        belief_sources=facts.declared.belief_sources,
        driver_faults=read_driver_faults(facts.root, model.sources_hash),
    )


def with_executed_modules(model: Model, recordings: dict[str, Traces]) -> Model:
    tests: dict[str, Test] = {}
    executing: dict[str, list[str]] = {}
    for test in model.tests.values():
        classes = {Path(test.place.file).stem.removesuffix("Test")}
        for binding, result in test.results.items():
            for name in recordings[binding].tests.intersection(result.recordings):
                called = recordings[binding].methods(name)
                classes |= {method.split("::")[0] for method in called}
        names = sorted(
            name for name in classes if name in model.modules and not model.modules[name].datatype
        )
        tests[test.id] = replace(test, modules=names)
        for name in names:
            executing.setdefault(name, []).append(test.id)
    modules = {
        name: replace(module, tests=executing.get(name, []))
        for name, module in model.modules.items()
    }
    return replace(model, tests=tests, modules=modules)
