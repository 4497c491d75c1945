"""The exported model fits its schema, and each diagram has its source."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import jsonschema
import pytest

from portal.diagrams import diagram_files
from portal.portal import Portal
from tests.python.portal.fixture import PLACE, REPORT, make_model, make_project
from traceability.exports.model_json import model_schema, model_text
from traceability.model.design_model import Model
from traceability.schema import ExecutionContext, Finding, Place, SharedMember, SharedPipe

FOUND = replace(REPORT, findings=[Finding(PLACE, "exec-shared", "text", "fix")])


@pytest.fixture
def model() -> Model:
    model = make_model()
    place = Place("design/execution.toml", 3)
    return replace(
        model,
        contexts={"timer": ExecutionContext("timer", "interrupt", "t", "x", ["f"], "", place)},
        pipes=[SharedPipe("A::b_", "pipe", "x", "Pipe<int>", place, {"A::w": ["timer"]})],
        shared=[SharedMember("A::b_", "A", "int", place, ["timer"], [], "", "")],
    )


def test_the_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(model_schema())


def test_the_model_fits_its_schema(model: Model) -> None:
    jsonschema.Draft202012Validator(model_schema()).validate(json.loads(model_text(model, FOUND)))


@pytest.mark.parametrize("change", ["without a key", "another key", "another type"])
def test_what_does_not_fit_is_refused(model: Model, change: str) -> None:
    data = json.loads(model_text(model, FOUND))
    module = data["modules"]["RC"]
    if change == "without a key":
        del module["secret"]
    elif change == "another key":
        module["secrets"] = []
    else:
        module["secret"] = 1
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.Draft202012Validator(model_schema()).validate(data)


def test_classes_are_described_in_words() -> None:
    definitions = model_schema()["$defs"]
    assert definitions["Place"]["description"].startswith("A line of a file")
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
