"""The check finds constants that seem to depend on the period of a cycle. In design/tuned.toml, it
also finds names and source lines that do not exist."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.python.model.small_tree import write_tree
from tests.python.project_files import replace_in, write_files
from traceability.checks.tuned_checks import check
from traceability.model.build import build
from traceability.schema import Finding

CONTROLLER = "src/main_control/MainController.cpp"
DESIGN = {
    "design/clauses.toml": '[[pattern]]\nname = "State"\nroles = ["State"]\napplications = 2\n',
    "design/requirement_numbers.toml": '[[requirement]]\nid = "FR-15"\n'
    'constants = { "300 ms" = "MainController::kLifetime" }\n',
}


def found(root: Path, tuned: str) -> list[Finding]:
    (root / "design/tuned.toml").write_text(tuned)
    return list(check(*build(root)))


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Returns a project with a constant that has no comment. A requirement is linked to this
    constant, and the rationale of the requirement states a number of cycles."""
    write_tree(tmp_path)
    write_files(tmp_path, DESIGN)
    constant = "namespace wr {\n\nconstexpr int kLifetime = 300;"
    replace_in(tmp_path / CONTROLLER, "namespace wr {", constant)
    rationale = "a lost link. It lasts for three cycles."
    replace_in(tmp_path / "requirements/reading.dox", "a lost link.", rationale)
    return tmp_path


def entry(constant: str, line: str) -> str:
    return (
        f'[[tuned]]\nto = "MainController::read"\nwhy = "It is."\nconstants = ["{constant}"]\n'
        f'lines = ["{line}"]\n'
    )


def test_a_time_that_a_requirement_counts_in_cycles_must_be_declared(root: Path) -> None:
    (finding,) = found(root, "")
    assert (finding.place.file, finding.place.line) == (CONTROLLER, 7)
    assert (
        "MainController::kLifetime seems to depend on SystemConstants::cyclePeriod" in finding.text
    )


def test_a_name_or_a_line_that_does_not_exist_is_found(root: Path) -> None:
    texts = [one.text for one in found(root, entry("MainController::kMore", f"{CONTROLLER}: kL"))]
    assert "there is no constant MainController::kMore" in texts
    assert f"no source line matches {CONTROLLER}: kL" in texts


def test_a_declared_line_and_constant_are_accepted(root: Path) -> None:
    (finding,) = found(root, entry("MainController::kLifetime", f"{CONTROLLER}: kLifetime"))
    # The entry declares no dependence on SystemConstants::cyclePeriod.
    assert "seems to depend" in finding.text
