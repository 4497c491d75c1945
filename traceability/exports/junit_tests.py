"""Exports the test results in the XML format of JUnit. Each test has the requirements that it
verifies."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.schema import BindingResult, Test

NAME = "tests.xml"


def junit_text(model: Model, _report: Report) -> str:
    """Returns the JUnit file. It has one test suite for each target. A test case has a property
    ``requirement`` for each requirement that the test verifies. A test is marked as skipped if its
    result belongs to older sources."""
    top = ET.Element("testsuites", name="weeding_robot")
    for target in model.results_hashes:
        suite = ET.SubElement(top, "testsuite", name=target)
        for test in model.tests.values():
            if target in test.results:
                _add_case(suite, test, test.results[target])
    for suite in [*top, top]:
        counts = {"tests": "testcase", "failures": "failure", "skipped": "skipped"}
        for name, tag in counts.items():
            suite.set(name, str(len(list(suite.iter(tag)))))
    ET.indent(top)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ET.tostring(top, encoding="unicode")}\n'


def _add_case(suite: ET.Element, test: Test, run: BindingResult) -> None:
    names = {"classname": test.suite, "name": test.name, "file": test.place.file}
    case = ET.SubElement(suite, "testcase", names)
    case.set("time", f"{(run.milliseconds or 0) / 1000:.3f}")
    if test.verifies:
        properties = ET.SubElement(case, "properties")
        for requirement in test.verifies:
            ET.SubElement(properties, "property", name="requirement", value=requirement)
    if run.words == "failed":
        ET.SubElement(case, "failure", message="failed").text = run.message
    elif run.words != "passed":
        ET.SubElement(case, "skipped", message=run.words or "not run")
