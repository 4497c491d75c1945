"""The time bounds on the page "Bench"."""

from __future__ import annotations

from dataclasses import replace

import pytest

from portal.pages import all_pages
from portal.portal import Portal
from tests.python.portal.fixture import REPORT, make_project
from traceability.reading.published import Published
from traceability.schema import PathBound, TimeBound, TimeProof

pytestmark = pytest.mark.reads("site")

EDGES = TimeBound("edges-of-wheels", "Hall edges", 912, 8, 1, 32, 2, "eight inputs", 0.235)
SEEN = PathBound("order", "Order to duty cycle", [("wait", 100.2), ("cycle", 2.7)], 58.5, "why")
UNSEEN = PathBound("fault", "Fault to stop", [("tick", 1.0)], None, "why")
PROOF = TimeProof(
    contexts=[EDGES],
    cycle_ms=2.5,
    noise_ms=6.0,
    seen_ms=1.0,
    paths=[SEEN, UNSEEN],
    unbound=[],
    unresolved=[],
)
OUTCOMES = {"longest_ms": 1.25, "median_ms": 1.0, "noise_ms": 2.0, "noisy": 25}
RECORD = Published("./wr campaign loads", "c", "d", {"cases": 100, "outcomes": OUTCOMES})


@pytest.fixture(name="page", scope="module")
def bench_page(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("project")
    model = replace(make_project(folder), times=PROOF, campaigns={"loads": RECORD})
    pages = all_pages(Portal(folder, model, REPORT, []))
    return " ".join(next(page.body for page in pages if page.name == "bench").split())


def test_the_page_compares_each_bound_with_the_longest_drive(page: str) -> None:
    assert "The bound is 2.0 times the longest cycle." in page
    assert "25 of the drives have noise at all inputs" in page
    assert "is 3.0 times this time." in page


def test_the_page_has_each_path_with_the_time_of_its_recording(page: str) -> None:
    row = page[page.index('id="path-order"') : page.index('id="path-fault"')]
    assert ">102.9<" in row
    assert ">58.5<" in row
    assert "not recorded" in page[page.index('id="path-fault"') :]


def test_the_page_has_the_response_time_of_each_interrupt(page: str) -> None:
    assert ">235<" in page
    assert "8 in 1 ms, 32 in 1 ms with noise." in page


def test_answers_lead_to_the_comparison_with_the_paper_without_a_measurement_too(page: str) -> None:
    assert 'id="paper"' in page
