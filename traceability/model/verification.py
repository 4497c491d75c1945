"""Finds the executed source lines and branches in the methods of each requirement. Only the passing
tests of the same requirement are considered."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from traceability.model.design_model import Model
from traceability.model.trees import accepted
from traceability.reading.ast_facts import BodyFact
from traceability.reading.coverage import Coverage
from traceability.reading.gcov_arcs import Covered
from traceability.reading.graphs import reached_from
from traceability.reading.source_facts import Facts
from traceability.reading.traces import nodes_of
from traceability.reading.translation_units import is_board
from traceability.schema import HOST, LineGap, MethodCoverage, Place, Requirement


def with_verification(model: Model, facts: Facts, coverage: dict[str, Coverage]) -> Model:
    requirements: dict[str, Requirement] = {}
    for name, requirement in model.requirements.items():
        covered: dict[str, list[MethodCoverage]] = {}
        for binding, measured in coverage.items():
            recordings = model.passing(requirement.verified_by, binding)
            if any(recording in measured.recordings for recording in recordings):
                covered[binding] = _covered_methods(
                    requirement, facts, measured, measured.of(recordings)
                )
        requirements[name] = replace(requirement, coverage=covered)
    gaps = list(_line_gaps(model, facts, coverage[HOST]))
    return replace(model, requirements=requirements, line_gaps=gaps)


def _covered_methods(
    requirement: Requirement, facts: Facts, measured: Coverage, covered: Covered
) -> list[MethodCoverage]:
    coverages: list[MethodCoverage] = []
    whole = measured.whole
    nodes = nodes_of(requirement.tree)
    for method in dict.fromkeys(name for node in nodes for name in sorted(accepted(node, facts))):
        for body in facts.bodies.get(method, []):
            lines = lines_of(body, whole.lines.get(body.place.file, set()))
            hit = covered.lines.get(body.place.file, set())
            branches = sorted(
                branch
                for branch in whole.branches.get(body.place.file, set())
                if branch[0] in lines
            )
            taken = covered.branches.get(body.place.file, set())
            if lines:
                coverages.append(
                    MethodCoverage(
                        method,
                        body.place,
                        {line: line in hit for line in lines},
                        [branch in taken for branch in branches] if measured.branched else None,
                    )
                )
    return coverages


def lines_of(body: BodyFact, lines: set[int]) -> list[int]:
    return sorted(line for line in lines if body.place.line <= line <= body.end)


class Owners:
    """The requirements that each method serves. A method serves a requirement through an invocation
    tree, through a tag, or through its callers."""

    def __init__(self, model: Model, facts: Facts) -> None:
        self.trees: dict[str, set[str]] = {}
        self.tags: dict[str, set[str]] = {}
        for requirement in model.requirements.values():
            for node in nodes_of(requirement.tree):
                for method in accepted(node, facts):
                    self.trees.setdefault(method, set()).add(requirement.id)
            for method in requirement.satisfied_by:
                self.tags.setdefault(method, set()).add(requirement.id)
        self.callers: dict[str, set[str]] = {}
        for body in facts.syntax.bodies:
            for call in body.calls:
                for target in facts.targets(call.target, call.virtual):
                    self.callers.setdefault(target, set()).add(body.id)

    def of(self, method: str) -> set[str]:
        reached = reached_from(
            [method], lambda name: () if name in self.trees else self.callers.get(name, ())
        )
        served = (table.get(name, set()) for name in reached for table in (self.trees, self.tags))
        return set().union(*served)


def _line_gaps(model: Model, facts: Facts, coverage: Coverage) -> Iterable[LineGap]:
    """Yields the source lines of a method if the tests of its requirements do not execute these
    lines on the host. For a method without a requirement, the tests of all requirements are
    considered. Drivers are left out, because a separate page shows their source lines."""
    owners = Owners(model, facts)
    executed: dict[frozenset[str], Covered] = {}
    for body in facts.syntax.bodies:
        module = model.modules.get(body.owner.split("::")[0]) if body.owner else None
        if module is None or module.datatype or is_board(body.place.file):
            continue
        requirements = frozenset(owners.of(body.id) or model.requirements)
        if requirements not in executed:
            tests = {test for name in requirements for test in model.requirements[name].verified_by}
            executed[requirements] = coverage.of(model.passing(tests, HOST))
        hit = executed[requirements].lines.get(body.place.file, set())
        lines = lines_of(body, coverage.whole.lines.get(body.place.file, set()) - hit)
        if lines:
            yield LineGap(
                body.id,
                Place(body.place.file, lines[0], lines[-1]),
                lines,
                sorted(requirements) if len(requirements) < len(model.requirements) else [],
            )
