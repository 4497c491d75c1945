"""The imports between the packages have only one direction. The linter reports a wrong import."""

import shutil
from pathlib import Path

import pytest

from tools.lint import check_imports
from tools.steps import FailureError

pytestmark = pytest.mark.reads("tools", "traceability", "site/portal", "client", "pyproject.toml")

ROOT = Path(__file__).parents[3]
WRONG = [
    ("traceability/model/trees.py", "from portal import names"),
    ("traceability/reading/flow.py", "from traceability.model import trees"),
    ("traceability/model/trees.py", "from traceability.checks import registry"),
    ("traceability/schema.py", "from traceability.reading import results"),
    ("site/portal/names.py", "from tools import steps"),
    ("traceability/reading/clang_names.py", "from traceability.reading import flow"),
    ("site/portal/navigation.py", "if TYPE_CHECKING:\n    from portal.portal import Portal"),
    ("tools/usb_drive.py", "from tools import flash"),
    ("client/weeding_robot_client/reasons.py", "from traceability import schema"),
    ("client/weeding_robot_client/layout.py", "from weeding_robot_client import messages"),
]


def lint(root: Path) -> str:
    with (root / "log").open("w+", encoding="utf-8") as log:
        check_imports(root, log)
        log.seek(0)
        return log.read()


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Returns a copy of the packages, and of pyproject.toml with the rules for their imports."""
    for name in ("traceability", "site/portal", "tools", "client"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / name, tmp_path / name, ignore=ignored)
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def test_imports_go_one_way(copy: Path) -> None:
    assert "0 broken" in lint(copy)


@pytest.mark.parametrize(("file", "line"), WRONG)
def test_a_wrong_import_is_found(copy: Path, file: str, line: str) -> None:
    path = copy / file
    path.write_text(f"{path.read_text(encoding='utf-8')}\n{line}\n", encoding="utf-8")
    with pytest.raises(FailureError):
        lint(copy)
    module = file.removeprefix("site/").removesuffix(".py").replace("/", ".")
    text = (copy / "log").read_text(encoding="utf-8")
    assert "broken" in text
    assert module.rpartition(".")[2] in text
