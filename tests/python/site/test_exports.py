"""The files for other tools, of this project: each fits its published schema."""

import json
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

from tests.python.site.content import SITE
from traceability.exports.tool_files import FILES

SCHEMA = Path(__file__).parents[1] / "exports" / "sarif-2.1.0.schema.json"


@pytest.mark.parametrize("name", [file.name for file in FILES])
def test_the_page_of_exports_leads_to_each_file(name: str) -> None:
    assert f'href="{name}"' in (SITE / "exports.html").read_text(encoding="utf-8")
    assert (SITE / name).stat().st_size > 100


def test_the_requirements_fit_the_schema_of_reqif() -> None:
    path = SITE / "requirements.reqif"
    words = [sys.executable, "-m", "reqif.cli.main", "validate", "--use-reqif-schema", str(path)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_the_findings_fit_the_schema_of_sarif() -> None:
    findings = json.loads((SITE / "findings.sarif").read_text(encoding="utf-8"))
    jsonschema.Draft4Validator(json.loads(SCHEMA.read_text())).validate(findings)


def test_each_link_of_a_need_leads_to_a_need() -> None:
    data = json.loads((SITE / "needs.json").read_text(encoding="utf-8"))
    needs = data["versions"][data["current_version"]]["needs"]
    links = {link for need in needs.values() for link in need.get("verifies", [])}
    assert links <= needs.keys()
