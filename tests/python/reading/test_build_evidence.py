from pathlib import Path

import pytest

from traceability.reading.build_evidence import git


def test_the_output_of_git_is_empty_when_git_is_not_installed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert git(tmp_path, "rev-parse", "HEAD") == ""
