"""The exports for other tools. An independent tool reads each file, or the test checks the file
against a published schema."""

import csv
import json
import re
import subprocess
import sys
import textwrap
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from reqif.parser import ReqIFParser

from tests.python.portal.fixture import REPORT, make_model
from traceability.checks.registry import CHECKS
from traceability.exports.junit_tests import junit_text
from traceability.exports.model_json import model_text
from traceability.exports.requirement_files import csv_text, needs_text, reqif_text
from traceability.exports.sarif import sarif
from traceability.exports.tool_files import FILES, available
from traceability.exports.trace_items import trace_items
from traceability.exports.verification_table import junit, table
from traceability.model.design_model import Model
from traceability.model.report import Verdict
from traceability.schema import BindingResult, Finding, Place, Test

pytestmark = pytest.mark.reads("docs/other_tools.rst")

SARIF = json.loads((Path(__file__).parent / "sarif-2.1.0.schema.json").read_text())


@pytest.fixture
def model() -> Model:
    """Returns a model with a requirement whose text contains special characters of the formats."""
    model = make_model()
    (requirement,) = (one for one in model.requirements.values() if one.id == "FR-15")
    hard = replace(
        requirement, text='Below <5 km/h & "above",\nsecond line; ü', verified_by=["T.A"]
    )
    return replace(model, requirements={**model.requirements, "FR-15": hard})


def test_the_files_use_the_words_of_the_pages_for_a_verdict() -> None:
    model = make_model()
    verdicts = {**REPORT.requirements, "FR-15": Verdict("partly")}
    report = replace(REPORT, requirements=verdicts)
    (row,) = (one for one in table(model, report)["requirements"] if one["id"] == "FR-15")
    (failure,) = junit(model, report).findall(".//testcase[@name='FR-15']/failure")
    exported = json.loads(model_text(model, report))["requirements"]["FR-15"]
    states = {row["state"], failure.get("message"), exported["state"]}
    assert states == {"partly verified"}
    assert all(
        "partly verified" in make(model, report) for make in (csv_text, needs_text, reqif_text)
    )


# ---- ReqIF -----------------------------------------------------------------------


def validate(path: Path) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, "-m", "reqif.cli.main", "validate", "--use-reqif-schema", str(path)]
    return subprocess.run(words, capture_output=True, text=True, check=False)


@pytest.mark.runs_tools
def test_reqif_fits_the_schema_and_is_read_back(model: Model, tmp_path: Path) -> None:
    path = tmp_path / "a.reqif"
    path.write_text(reqif_text(model, REPORT), encoding="utf-8")
    done = validate(path)
    assert done.returncode == 0, done.stdout
    assert "0 errors, 0 schema issues found, 0 semantic issues found" in done.stdout
    bundle = ReqIFParser.parse(str(path))
    requirement = bundle.get_spec_object_by_ref("requirement-FR-15")
    values = {one.definition_ref.rpartition("-")[2]: one.value for one in requirement.attributes}
    assert values["ReqIF.ForeignID"] == "FR-15"
    assert values["ReqIF.Text"].replace("&#10;", "\n") == model.requirements["FR-15"].text
    assert values["state"] == "verified"
    content = bundle.core_content.req_if_content
    relations = {(one.source, one.relation_type_ref) for one in content.spec_relations}
    assert ("test-RcTest.Reads", "type-verifies") in relations
    (specification,) = content.specifications
    places = list(bundle.iterate_specification_hierarchy(specification))
    assert "requirement-FR-15" in [place.spec_object for place in places]


def test_reqif_has_no_empty_value(model: Model) -> None:
    """StrictDoc cannot import a file with an empty value."""
    assert 'THE-VALUE=""' not in reqif_text(model, REPORT)
    assert any(not value for one in trace_items(model, REPORT) for value in one.values.values())


@pytest.mark.runs_tools
def test_a_broken_link_in_reqif_is_found(model: Model, tmp_path: Path) -> None:
    path = tmp_path / "a.reqif"
    text = reqif_text(model, REPORT)
    wrong = text.replace("REF>requirement-FR-15<", "REF>requirement-FR-99<")
    path.write_text(wrong, encoding="utf-8")
    assert validate(path).returncode == 1


# ---- CSV -------------------------------------------------------------------------


def test_the_table_is_read_back(model: Model) -> None:
    rows = list(csv.DictReader(csv_text(model, REPORT).splitlines(keepends=True)))
    assert [row["id"] for row in rows] == list(model.requirements)
    (row,) = (row for row in rows if row["id"] == "FR-15")
    assert row["text"] == model.requirements["FR-15"].text
    assert row["state"] == "verified"
    assert row["verified_by"] == "T.A"


# ---- sphinx-needs ----------------------------------------------------------------

PAGE = Path(__file__).parents[3] / "docs" / "other_tools.rst"


def settings_of_the_page() -> str:
    """Returns the content of conf.py from the page docs/other_tools.rst. Readers copy this content
    for Sphinx-Needs."""
    _, _, rest = PAGE.read_text(encoding="utf-8").partition(".. code-block:: python\n")
    block = re.match(r"(?:\n| {3}.*\n)+", rest)
    assert block
    return textwrap.dedent(block[0])


@pytest.mark.runs_tools
def test_sphinx_needs_imports_the_needs(model: Model, tmp_path: Path) -> None:
    (tmp_path / "conf.py").write_text(settings_of_the_page())
    (tmp_path / "index.rst").write_text("A\n=\n\n.. needimport:: needs.json\n\n.. needtable::\n")
    (tmp_path / "needs.json").write_text(needs_text(model, REPORT), encoding="utf-8")
    out = tmp_path / "out"
    words = [sys.executable, "-m", "sphinx", "-q", "-W", "-b", "needs", str(tmp_path), str(out)]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    data = json.loads((out / "needs.json").read_text())
    needs: dict[str, Any] = data["versions"][data["current_version"]]["needs"]
    given = json.loads(needs_text(model, REPORT))["versions"][model.version]["needs"]
    assert needs.keys() == given.keys()
    assert needs["FR-15"]["status"] == "verified"
    assert needs["FR-15"]["section"] == model.requirements["FR-15"].section
    assert needs["RcTest.Reads"]["verifies"] == ["FR-15"]


# ---- SARIF -----------------------------------------------------------------------


def test_findings_fit_the_schema_of_sarif(model: Model) -> None:
    check = CHECKS[3].id
    report = replace(
        REPORT,
        findings=[
            Finding(Place("src/a.cpp", 7), check, "it is wrong", "correct it"),
            Finding(Place("src/a.cpp", 0), "of-no-check", "it is wrong", "correct it"),
        ],
    )
    log = sarif(model, report)
    jsonschema.Draft4Validator(SARIF).validate(log)
    (run,) = log["runs"]
    first, second = run["results"]
    assert run["tool"]["driver"]["rules"][first["ruleIndex"]]["id"] == check
    assert first["locations"][0]["physicalLocation"] == {
        "artifactLocation": {"uri": "src/a.cpp"},
        "region": {"startLine": 7},
    }
    assert "ruleIndex" not in second
    log["runs"][0]["results"][0]["message"] = "plain"
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft4Validator(SARIF).validate(log)


# ---- JUnit -----------------------------------------------------------------------


def test_results_have_their_requirements_as_properties(model: Model) -> None:
    (target, *_) = model.results_hashes
    place = Place("tests/a.cpp", 1)
    results = {"A": "passed", "B": "failed", "C": "skipped"}
    tests = {
        f"T.{name}": Test(
            f"T.{name}", "T", name, "", place, ["FR-15"],
            {target: BindingResult(result, 1500, f"{result} <here>")},
        )
        for name, result in results.items()
    }  # fmt: skip
    top = ET.fromstring(junit_text(replace(model, tests=tests), REPORT).encode())
    suite = top.find(f"testsuite[@name='{target}']")
    assert suite is not None
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("3", "1", "1")
    for case in suite:
        found = [one.attrib for one in case.iter("property")]
        assert found == [{"name": "requirement", "value": "FR-15"}]
        assert case.get("time") == "1.500"
    failure = suite.find("testcase[@name='B']/failure")
    assert failure is not None
    assert failure.text == "failed <here>"


def test_a_result_of_older_sources_is_not_exported_as_passed(model: Model) -> None:
    (target, *_) = model.results_hashes
    stale = {target: BindingResult("passed", stale=True)}
    test = Test("T.A", "T", "A", "", Place("tests/a.cpp", 1), ["FR-15"], stale)
    top = ET.fromstring(junit_text(replace(model, tests={"T.A": test}), REPORT).encode())
    assert [one.get("message") for one in top.findall(".//skipped")] == ["passed, stale"]


def test_equal_models_give_equal_files(model: Model) -> None:
    for file in available(Path("/nowhere")):
        assert file.make(Path(), model, REPORT) == file.make(Path(), model, REPORT)
    assert len({file.name for file in FILES}) == len(FILES)
