"""The schema of the exported model rejects invalid data, and each diagram is exported with its
source text.

The tests of the built site check the model of this project.
"""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from portal.diagrams import diagram_files
from portal.portal import Portal
from tests.python.portal.fixture import REPORT, make_model, make_project
from traceability.exports.model_json import model_text, schema_text


@pytest.mark.parametrize("change", ["without a key", "another key", "another type"])
def test_what_does_not_fit_is_refused(change: str) -> None:
    data = json.loads(model_text(make_model(), REPORT))
    jsonschema.Draft202012Validator(json.loads(schema_text())).validate(data)
    module = data["modules"]["RC"]
    if change == "without a key":
        del module["secret"]
    elif change == "another key":
        module["secrets"] = []
    else:
        module["secret"] = 1
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft202012Validator(json.loads(schema_text())).validate(data)


def test_classes_are_described_in_words() -> None:
    definitions = json.loads(schema_text())["$defs"]
    assert definitions["Place"]["description"].startswith("A source line of a file")
    assert definitions["TreeNode"]["properties"]["children"]["items"] == {
        "$ref": "#/$defs/TreeNode"
    }


def test_each_diagram_has_its_source(tmp_path: Path) -> None:
    portal = Portal(tmp_path, make_project(tmp_path), REPORT, [])
    files = diagram_files(portal.diagrams)
    assert set(files) == {
        "diagrams/pattern-reading-modes.puml",
        "diagrams/machine-reading-modes.puml",
    }
    machine = files["diagrams/machine-reading-modes.puml"]
    assert machine.startswith("@startuml")
    assert machine.endswith("@enduml\n")
    assert "[[../modules/RC.html]]" in machine
