"""Computes the test coverage and the filter values of the requirements and tests."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from traceability.grouping import grouped
from traceability.model.design_model import Model
from traceability.model.not_shown import ONLY, targets_of
from traceability.model.report import Report
from traceability.reading.traces import nodes_of
from traceability.schema import HOST, VIRTUAL_K64, MethodCoverage, Place, Requirement, Test


@dataclass
class Share:
    """The number of executed lines or branches, and the number of all lines or branches."""

    part: int
    whole: int

    @property
    def per_cent(self) -> float:
        return round(100 * self.part / self.whole, 1) if self.whole else 100

    def __str__(self) -> str:
        return f"{self.part}/{self.whole}"


def share(hits: Iterable[bool]) -> Share | None:
    values = list(hits)
    return Share(sum(values), len(values)) if values else None


def lines_of(methods: Iterable[MethodCoverage]) -> Share | None:
    return share(hit for method in methods for hit in method.lines.values())


def measured_lines(requirement: Requirement) -> tuple[str, Share] | None:
    """Returns the executed lines of the methods in the invocation tree, and the target on which
    they were measured. The target is the host if any line was measured there, and otherwise the
    virtual K64."""
    shares = ((name, lines_of(requirement.coverage.get(name, []))) for name in (HOST, VIRTUAL_K64))
    return next(((name, lines) for name, lines in shares if lines), None)


def branches_of(methods: Iterable[MethodCoverage]) -> Share | None:
    return share(hit for method in methods for hit in method.branches or [])


@dataclass
class CoverageRow:
    """The coverage of a module by the tests on the host: the executed source lines and branches. A
    file that belongs to no module has a separate row."""

    name: str  # module or file
    lines: Share
    branches: Share | None  # None if the branches were not counted
    missed: list[Place]  # source lines with a branch that no test executed


def coverage_rows(model: Model) -> list[CoverageRow]:
    """Returns a row for each module with measured lines. A file of the design that belongs to no
    module has its own row. The row with the smallest share of executed lines is first."""
    owners = {
        file: module.name
        for module in model.modules.values()
        if not module.datatype
        for file in (module.header, module.source)
    }
    files = grouped(model.host_files, lambda file: owners.get(file, file))
    rows = [coverage_of(model, name, paths) for name, paths in files.items()]

    def order(row: CoverageRow) -> tuple[float, float, str]:
        return row.lines.per_cent, row.branches.per_cent if row.branches else 100, row.name

    return sorted(filter(None, rows), key=order)


def coverage_of(model: Model, name: str, files: Iterable[str]) -> CoverageRow | None:
    """Returns the coverage of some files together. Returns None if no line of these files was
    measured."""
    measured = {file: model.host_files[file] for file in files if file in model.host_files}
    lines = share(hit for file in measured.values() for hit in file.lines.values())
    counts = [file.branches for file in measured.values() if file.branches is not None]
    branches = Share(*map(sum, zip(*counts, strict=True))) if counts else None
    missed = [Place(path, line) for path, file in measured.items() for line in file.missed]
    return CoverageRow(name, lines, branches, missed) if lines else None


def chart(
    sections: dict[str, list[Requirement]],
) -> dict[str, tuple[Share | None, Share | None, Share | None]]:
    """For the requirements of each section, returns three executed shares: of the source lines on
    the host, of the branches on the host, and of the source lines on the virtual K64. A method in
    several invocation trees is counted once for each tree."""

    def methods(items: list[Requirement], binding: str) -> list[MethodCoverage]:
        return [method for item in items for method in item.coverage.get(binding, [])]

    return {
        section: (
            lines_of(methods(items, HOST)),
            branches_of(methods(items, HOST)),
            lines_of(methods(items, VIRTUAL_K64)),
        )
        for section, items in sections.items()
    }


# Name of a filter on the page -> the values that a requirement (or a test) has for this filter.
Facets = dict[str, Sequence[str]]


def facets(model: Model, report: Report, requirement: Requirement) -> Facets:
    names = [method.split("::")[0] for method in requirement.satisfied_by]
    for node in nodes_of(requirement.tree):
        names.append(node.module)
    modules = [model.modules[name] for name in dict.fromkeys(names) if name in model.modules]
    return {
        "state": [report.requirements[requirement.id].state],
        "logic": sorted({module.logic for module in modules}),
        "pattern": sorted({role.application for module in modules for role in module.roles}),
        "method": [requirement.method] if requirement.method else [],
        "level": [requirement.level] if requirement.level else [],
        "goal": requirement.goals,
        "source": with_only(list(dict.fromkeys(one.kind for one in requirement.sources))),
        "binding": with_only(targets_of(model, requirement)),
    }


def with_only(values: Sequence[str]) -> list[str]:
    """Returns the values of a filter. If there is only one value, adds the value "only ..."."""
    return [*values, *(ONLY.format(value) for value in values if len(values) == 1)]


def facets_of_test(test: Test, model: Model, modules: Sequence[str]) -> Facets:
    """Returns the values of a test for the filters. A test without a requirement has no value for
    the filters of requirements and levels."""
    verified = [model.requirements[one] for one in test.verifies if one in model.requirements]
    folders = test.place.file.split("/")[1:-1]
    return {
        "result": sorted({run.result or "not run" for run in test.results.values()}),
        "target": list(test.results),
        "folder": ["/".join(folders)],
        "module": modules,
        "level": sorted({requirement.level for requirement in verified if requirement.level}),
        "requirement": list(test.verifies),
    }


def options(all_facets: Iterable[Facets]) -> dict[str, list[str]]:
    """Returns all values that occur for each filter, sorted. The page offers these values."""
    values: dict[str, set[str]] = defaultdict(set)
    for facet in all_facets:
        for name, own in facet.items():
            values[name].update(own)
    return {name: sorted(own, key=_numbers_in_order) for name, own in values.items()}


def _numbers_in_order(text: str) -> list[tuple[str, int]]:
    """Returns a sort key that compares numbers by value: FR-2 is before FR-10."""
    parts = re.findall(r"(\D*)(\d*)", text)
    return [(words, int(number or 0)) for words, number in parts]
