"""./wr verify-build: the builds that it compares, and the builds that it refuses to compare."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.python.git_project import git
from tools.steps import FailureError
from tools.verify_build import RECORD, check_origin, clone, compare, compare_verdicts
from traceability.reading.products import PRODUCTS, image_of

ROW = {"id": "FR-1", "state": "verified", "tests": {"A.B": {"host": "passed"}}}


@pytest.fixture
def built(tmp_path: Path) -> Path:
    """Returns a project with a commit, its firmware images and its verdicts."""
    root = tmp_path / "project"
    root.mkdir()
    (root / ".gitignore").write_text("/build/\n/.venv\n")
    git(root, "init", "-q")
    git(root, "add", ".")
    git(root, "commit", "-qm", "x")
    write_build(root, git(root, "rev-parse", "--short=10", "HEAD"), ROW)
    return root


def write_build(root: Path, commit: str, row: dict[str, object]) -> None:
    for product in PRODUCTS:
        path = root / image_of(product, ".bin")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(b"image of " + product.encode())
    (root / RECORD).parent.mkdir(parents=True, exist_ok=True)
    (root / RECORD).write_text(json.dumps({"commit": commit, "requirements": [row]}))


def test_equal_builds_have_no_differences(built: Path, tmp_path: Path) -> None:
    check_origin(built, images=False)
    copy = tmp_path / "copy"
    clone(built, copy)
    write_build(copy, "other", ROW)
    assert list(compare(built, copy, images=False)) == []


def test_one_other_byte_of_an_image_is_a_difference(built: Path, tmp_path: Path) -> None:
    copy = tmp_path / "copy"
    write_build(copy, "x", ROW)
    changed = image_of(next(iter(PRODUCTS)), ".bin")
    (copy / changed).write_bytes(b"image")
    assert list(compare(built, copy, images=True)) == [f"{changed}: the bytes differ"]


def test_each_verdict_and_each_result_counts() -> None:
    other = {"id": "FR-1", "state": "failed", "tests": {"A.B": {"host": "failed"}}}
    found = list(compare_verdicts({"requirements": [ROW]}, {"requirements": [other]}))
    assert found == [
        "FR-1 is verified here, but failed in the new folder",
        "FR-1: A.B: {'host': 'passed'} here, {'host': 'failed'} there",
    ]
    assert list(compare_verdicts({"requirements": [ROW]}, {})) != []


def test_only_the_build_of_the_commit_is_repeated(built: Path) -> None:
    (built / "new").write_text("x")
    with pytest.raises(FailureError, match="1 files differ from the commit"):
        check_origin(built, images=False)
    git(built, "add", ".")
    git(built, "commit", "-qm", "y")
    with pytest.raises(FailureError, match="belong to another commit"):
        check_origin(built, images=False)
    (built / image_of(next(iter(PRODUCTS)), ".bin")).unlink()
    with pytest.raises(FailureError, match=r"run \./wr portal first"):
        check_origin(built, images=True)
