"""Each worked example of the page docs/how_these_pages_are_made.rst can be applied to the present
files. The tests in tests/python/worked_examples also test the result."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.python.worked_examples.examples import BEFORE, EXAMPLES, ROOT, apply, patches

pytestmark = pytest.mark.reads("docs", "design", "src", "tests", "site", "traceability")


@pytest.mark.parametrize("example", EXAMPLES)
def test_an_example_fits_the_present_files(example: str, tmp_path: Path) -> None:
    files = {name for text in patches(example) for name in BEFORE.findall(text)}
    assert files
    for name in files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    apply(tmp_path, example)
