"""Each check has a seeded fault, and each fault can be inserted.

The commands ``./wr check --drift`` and ``./wr test --long`` verify that the checks find the faults.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.seed_faults import copy_part
from traceability.checks.registry import KNOWN
from traceability.reading.seeded_faults import COMPILER, SOURCES, STAGES, Edit, Fault, read_faults

pytestmark = pytest.mark.reads(".")

ROOT = Path(__file__).parents[3]
FAULTS = read_faults(ROOT)


def test_every_check_has_a_seeded_fault() -> None:
    missing = set(KNOWN) - {fault.check for fault in FAULTS}
    assert not missing, (
        f"these checks have no fault in tests/drift: {', '.join(sorted(missing))}; write faults"
    )


def test_every_fault_names_a_check_and_says_what_it_is() -> None:
    for fault in FAULTS:
        assert fault.check in KNOWN, fault.name
        assert fault.says.endswith("."), fault.name
        assert fault.stage in STAGES, fault.name
        assert fault.edits, fault.name
    assert len({(fault.check, fault.says) for fault in FAULTS}) == len(FAULTS)
    assert any(fault.check == COMPILER for fault in FAULTS)


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("copy")
    for name in SOURCES:
        copy_part(ROOT, root, name)
    return root


@pytest.mark.parametrize(
    "fault", [one for one in FAULTS if one.stage == "sources"], ids=lambda one: one.name
)
def test_fault_can_be_seeded_and_its_place_exists(fault: Fault, copy: Path) -> None:
    kept = {e.file: (copy / e.file).read_bytes() for e in fault.edits if (copy / e.file).exists()}
    lines = [edit.apply(copy) for edit in fault.edits]
    assert fault.expected_line(copy, lines[0]) >= 1
    for file, content in kept.items():
        (copy / file).write_bytes(content)


def test_edit_that_matches_nothing_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("one\ntwo\n", encoding="utf-8")
    with pytest.raises(ValueError, match="three"):
        Edit("file", "three", "").apply(tmp_path)
    assert Edit("file", "^two", "2").apply(tmp_path) == 2
    assert (tmp_path / "file").read_text(encoding="utf-8") == "one\n2\n"
