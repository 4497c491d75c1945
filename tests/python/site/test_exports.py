"""The files of the built site for other tools. The files in the formats ReqIF and SARIF fit the
published schemas."""

import csv
import json
import re
import subprocess
import sys
import venv
from pathlib import Path

import jsonschema
import pytest

from tests.python.site.content import SITE
from traceability.exports.tool_files import FILES

ROOT = Path(__file__).parents[3]
SCHEMA = Path(__file__).parents[1] / "exports" / "sarif-2.1.0.schema.json"
STRICTDOC, LOCK = ROOT / "build/strictdoc", ROOT / "setup/strictdoc.lock"
IMPORTED = re.compile(r"^UID: (\S+)\nSTATEMENT: >>>\n(.*?)\n<<<$", re.MULTILINE | re.DOTALL)


@pytest.fixture
def strictdoc() -> Path:
    """Returns the path of the program StrictDoc. If needed, installs StrictDoc in a separate Python
    environment."""
    stamp = STRICTDOC / "installed.lock"
    if not stamp.exists() or stamp.read_bytes() != LOCK.read_bytes():
        venv.create(STRICTDOC, clear=True, with_pip=True)
        words = ["-m", "pip", "install", "--quiet", "--require-hashes", "--only-binary", ":all:"]
        done = subprocess.run(
            [STRICTDOC / "bin/python", *words, "-r", LOCK],
            capture_output=True,
            text=True,
            check=False,
        )
        if "Retrying" in done.stderr:
            pytest.skip("StrictDoc cannot be installed without a network")
        assert done.returncode == 0, done.stderr
        stamp.write_bytes(LOCK.read_bytes())
    return STRICTDOC / "bin/strictdoc"


@pytest.mark.parametrize("name", [file.name for file in FILES])
def test_the_page_of_exports_leads_to_each_file(name: str) -> None:
    assert f'href="{name}"' in (SITE / "exports.html").read_text(encoding="utf-8")
    assert (SITE / name).stat().st_size > 100


@pytest.mark.runs_tools
def test_the_requirements_fit_the_schema_of_reqif() -> None:
    path = SITE / "requirements.reqif"
    words = [sys.executable, "-m", "reqif.cli.main", "validate", "--use-reqif-schema", str(path)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


@pytest.mark.long
@pytest.mark.runs_tools
def test_strictdoc_imports_each_requirement_with_its_text(strictdoc: Path, tmp_path: Path) -> None:
    subprocess.run(
        [strictdoc, "convert", SITE / "requirements.reqif", tmp_path], check=True, cwd=tmp_path
    )
    (document,) = tmp_path.glob("*.sdoc")
    imported = dict(IMPORTED.findall(document.read_text(encoding="utf-8")))
    with (SITE / "requirements.csv").open(encoding="utf-8", newline="") as table:
        expected = {row["id"]: row["text"] for row in csv.DictReader(table)}
    assert imported == expected


def test_the_findings_fit_the_schema_of_sarif() -> None:
    findings = json.loads((SITE / "findings.sarif").read_text(encoding="utf-8"))
    jsonschema.Draft4Validator(json.loads(SCHEMA.read_text())).validate(findings)


def test_each_link_of_a_need_leads_to_a_need() -> None:
    data = json.loads((SITE / "needs.json").read_text(encoding="utf-8"))
    needs = data["versions"][data["current_version"]]["needs"]
    links = {link for need in needs.values() for link in need.get("verifies", [])}
    assert links <= needs.keys()
