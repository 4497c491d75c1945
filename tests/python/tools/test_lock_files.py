"""For each package in a list in setup/, the lock file contains a version that the list permits."""

import re
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from tools.sbom import PINNED

pytestmark = pytest.mark.reads("setup")

SETUP = Path(__file__).parents[3] / "setup"
LISTS = sorted(SETUP.glob("*.in"))


def unmet(demanded: str, locked: str) -> list[str]:
    """Compares a list of packages with a lock file. Returns the demands of the list that are not
    met in the lock file."""
    versions = {normal(name): version for name, version in PINNED.findall(locked)}
    lines = [line.partition("#")[0].strip() for line in demanded.splitlines()]
    demands = [Requirement(line) for line in lines if line]
    return [
        str(demand)
        for demand in demands
        if (name := normal(demand.name)) not in versions or versions[name] not in demand.specifier
    ]


def normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


@pytest.mark.parametrize("path", LISTS, ids=lambda path: path.stem)
def test_a_lock_file_meets_its_list_of_packages(path: Path) -> None:
    assert unmet(path.read_text(), path.with_suffix(".lock").read_text()) == []


def test_another_or_a_missing_version_is_found() -> None:
    demanded = "# tools\ngcovr==8.6  # counts lines\nmypy\nsphinx>=9.0,<9.1\nruff\n"
    locked = "gcovr==8.8 \\\n    --hash=sha256:0\nmypy==2.0 \\\nsphinx==9.0.4 \\\n"
    assert unmet(demanded, locked) == ["gcovr==8.6", "ruff"]
