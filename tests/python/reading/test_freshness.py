"""A result is valid only while the sources are the same as in the run that wrote this result."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.python.reading.task_records import record_task
from traceability.model.metrics import of_task
from traceability.reading import baseline_record, bench_record, products, results
from traceability.reading.seeded_faults import Outcome, read_record, write_record
from traceability.reading.task_record import BASELINE, BENCH, COVERAGE, IMAGES, SEEDED_FAULTS
from traceability.schema import BenchScenario, ProductImage

OUTCOME = Outcome("a-1", "module-secret", "Says.", "src/a.cpp", 1, True, True, ["found"])
TOTALS = {"flash": 17824, "ram": 12296}
BUILT = dict.fromkeys(products.PRODUCTS, ProductImage(**TOTALS, stack=0, forbidden=(), modules=()))


def write_images(root: Path) -> None:
    (root / results.TOTALS).write_text(json.dumps(TOTALS))
    content = {name: asdict(one) for name, one in BUILT.items()}
    (root / products.RESULTS).write_text(json.dumps(content))


def writer(path: Path, content: object) -> Callable[[Path], object]:
    return lambda root: (root / path).write_text(json.dumps(content))


class Case(NamedTuple):
    """A result of a task, its writer and its reader. If the result is valid, the reader returns
    ``known``. Otherwise, the reader returns ``unknown``."""

    task: str
    write: Callable[[Path], object]
    read: Callable[[Path], object]
    known: object
    unknown: object = None


CASES = {
    "bench": Case(
        BENCH,
        writer(bench_record.BENCH, {"steps": {"runs": {}, "profile": None}}),
        bench_record.read_bench,
        {"steps": BenchScenario()},
    ),
    "designs": Case(
        BASELINE,
        writer(baseline_record.RESULT, {"cycles": 1}),
        baseline_record.read_comparison,
        {"cycles": 1},
    ),
    "image": Case(
        IMAGES,
        write_images,
        lambda root: of_task(root, results.TOTALS),
        {"firmware.flash_bytes": 17824, "firmware.ram_bytes": 12296},
        {},
    ),
    "products": Case(IMAGES, write_images, products.read_products, BUILT),
    "coverage": Case(
        COVERAGE,
        writer(results.COVERAGE, {"line_total": 40, "line_percent": 98.5, "branch_percent": 95.0}),
        lambda root: of_task(root, results.COVERAGE),
        {"coverage.line": 98.5, "coverage.branch": 95.0},
        {},
    ),
    "seeded faults": Case(
        SEEDED_FAULTS, lambda root: write_record(root, [OUTCOME], 0, "abc"), read_record, [OUTCOME]
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_a_result_of_other_sources_is_none(tmp_path: Path, case: Case) -> None:
    source = tmp_path / "src/a.cpp"
    for folder in (source.parent, tmp_path / "build/results"):
        folder.mkdir(parents=True)
    source.write_text("int a;\n")
    assert case.read(tmp_path) == case.unknown
    case.write(tmp_path)
    assert case.read(tmp_path) == case.unknown, "no task wrote this result"
    record_task(tmp_path, case.task, "src")
    assert case.read(tmp_path) == case.known
    source.write_text("int b;\n")
    assert case.read(tmp_path) == case.unknown
