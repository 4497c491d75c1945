"""The tests: what each verifies, what it gave on each binding, and which modules it executed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from traceability.model.results import (
    Result,
    bindings_of,
    read_driver_faults,
    read_results,
    read_results_hash,
)
from traceability.model.schema import BINDINGS, HOST, BindingResult, Model, Test
from traceability.model.traces import Traces

if TYPE_CHECKING:
    from traceability.model.facts import Facts

BOARD_TESTS = "tests/sim/k64/"
TEST_MACRO = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)")


def add_tests(model: Model, facts: Facts) -> None:
    """Each test with its results. A binding that has tests is to have results of these sources."""
    results = {binding: read_results(facts.root, binding) for binding in BINDINGS}
    tested = {
        binding for member in facts.annotations.tests for binding in bindings_of(member.place.file)
    }
    for binding in BINDINGS:
        if binding in tested or binding == HOST:
            model.results_hashes[binding] = read_results_hash(facts.root, binding)
    lines: dict[str, list[str]] = {}
    for member in facts.annotations.tests:
        file = member.place.file
        if not bindings_of(file):
            continue
        if file not in lines:
            lines[file] = (facts.root / file).read_text(encoding="utf-8").splitlines()
        macro = _test_name(lines[file], member.place.line)
        if macro is None:
            continue
        suite, case = macro
        model.tests[f"{suite}.{case}"] = Test(
            id=f"{suite}.{case}",
            suite=suite,
            name=case,
            brief=member.text.brief,
            place=member.place,
            verifies=member.verifies,
            results={
                binding: _result_of(results[binding].get(f"{suite}.{case}"), model, binding)
                for binding in bindings_of(file)
            },
        )
    for test in model.tests.values():
        for name in test.verifies:
            if name in model.requirements:
                model.requirements[name].verified_by.append(test.id)


def _result_of(found: Result | None, model: Model, binding: str) -> BindingResult:
    stale = model.stale_on(binding)
    if found is None:
        return BindingResult(stale=stale)
    milliseconds = round(found.milliseconds, 3)
    return BindingResult(
        found.result,
        milliseconds,
        found.message,
        stale,
        found.recordings,
        found.measured,
        found.instances,
    )


def _test_name(lines: list[str], line: int) -> tuple[str, str] | None:
    match = TEST_MACRO.match(" ".join(lines[line - 1 : line + 2]))
    return (match[1], match[2]) if match else None


def add_board_findings(model: Model, facts: Facts) -> None:
    """A test of the virtual board makes a finding when its text names the id."""
    model.board_findings = facts.declared.board_findings
    model.beliefs = facts.declared.beliefs
    model.belief_sources = facts.declared.belief_sources
    model.driver_faults = read_driver_faults(facts.root, model.sources_hash)
    lines: dict[str, list[str]] = {}
    tests = [test for test in model.tests.values() if test.place.file.startswith(BOARD_TESTS)]
    for test in tests:
        file = test.place.file
        if file not in lines:
            lines[file] = (facts.root / file).read_text(encoding="utf-8").splitlines()
        starts = [other.place.line for other in tests if other.place.file == file]
        end = min((line for line in starts if line > test.place.line), default=None)
        body = "\n".join(lines[file][test.place.line - 1 : end and end - 1])
        for finding in model.board_findings.values():
            if f'"{finding.id}"' in body:
                finding.tests.append(test.id)


def add_executed_modules(model: Model, recordings: dict[str, Traces]) -> None:
    for test in model.tests.values():
        classes = {Path(test.place.file).stem.removesuffix("Test")}
        for binding, result in test.results.items():
            for name in recordings[binding].tests.intersection(result.recordings):
                called = recordings[binding].methods(name)
                classes |= {method.split("::")[0] for method in called}
        test.modules = sorted(
            name for name in classes if name in model.modules and not model.modules[name].datatype
        )
        for name in test.modules:
            model.modules[name].tests.append(test.id)
