"""The texts contain ids of requirements and of the safety case. The check finds ids that do not
exist."""

from pathlib import Path

from tests.python.model.small_tree import write_tree
from tests.python.project_files import write_files
from traceability.checks import id_checks
from traceability.model.build import build


def test_an_id_in_a_text_that_does_not_exist_is_found(tmp_path: Path) -> None:
    root = write_tree(tmp_path)
    files = {
        "docs/page.rst": "FR-15 to FR-16, NFR-1a, PFR-3 and HZ-2 (AU-1).\n",
        "tests/python/test_x.py": "# FR-99\n",
        "sim/robot.cpp": "\n// See SG-4.\n/// @satisfies FR-98\n",
        "design/tours.toml": 'ids = ["FR-97"]\n',
    }
    write_files(root, files)
    model, facts = build(root)
    found = [(one.place.file, one.place.line, one.text) for one in id_checks.check(model, facts)]
    assert found == [
        ("docs/page.rst", 1, "there is no requirement FR-16"),
        ("docs/page.rst", 1, "there is no hazard HZ-2"),
        ("docs/page.rst", 1, "there is no assumption AU-1"),
        ("sim/robot.cpp", 2, "there is no safety goal SG-4"),
    ]
