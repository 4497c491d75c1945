"""The figures of the image, and the comparison of the products."""

import json
from pathlib import Path

import pytest

from tests.python.reading.task_records import record_task
from traceability.model.metrics import image
from traceability.reading.image_record import TOTALS
from traceability.reading.products import PRODUCTS, RESULTS, read_products
from traceability.reading.task_record import IMAGES


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A project whose image was measured."""
    (tmp_path / "src").mkdir()
    (tmp_path / "src/RC.cpp").write_text("int a;\n")
    totals = {"flash": 17824, "ram": 12296}
    (tmp_path / TOTALS).parent.mkdir(parents=True)
    (tmp_path / TOTALS).write_text(json.dumps(totals))
    record_task(tmp_path, IMAGES, "src")
    return tmp_path


def test_the_figures_are_those_of_the_image(root: Path) -> None:
    assert image(root) == {"firmware.flash_bytes": 17824, "firmware.ram_bytes": 12296}


def test_the_image_of_other_sources_gives_no_figures(root: Path) -> None:
    (root / "src/RC.cpp").write_text("int b;\n")
    assert image(root) == {}


def test_products_are_compared_when_all_were_built_from_these_sources(root: Path) -> None:
    assert read_products(root) is None
    built = {name: {"flash": 40000} for name in PRODUCTS}
    (root / RESULTS).write_text(json.dumps(built))
    assert read_products(root) == built
    (root / "src/RC.cpp").write_text("int b;\n")
    assert read_products(root) is None


def test_an_image_that_was_not_measured_gives_no_figures(root: Path) -> None:
    (root / TOTALS).write_text("")
    assert image(root) == {}
    (root / TOTALS).unlink()
    assert image(root) == {}
