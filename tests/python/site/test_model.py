"""Facts in the exported model of this project. The tools compute these facts from the code."""

from __future__ import annotations

import json
from typing import Any

import jsonschema
import pytest

from tests.python.site.content import SITE

Facts = dict[str, Any]


@pytest.mark.parametrize("name", ["model", "verification"])
def test_the_file_fits_its_schema(name: str) -> None:
    schema, content = (
        json.loads((SITE / f"{name}.{suffix}").read_text(encoding="utf-8"))
        for suffix in ("schema.json", "json")
    )
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.Draft202012Validator(schema).validate(content)


@pytest.mark.parametrize(
    ("context", "first", "reaches", "not_reached"),
    [
        ("edges-of-wheels", "ActiveSensor::serve", "PeriodCollector::collect", "RcPin::serve"),
        (
            "wheel-threads",
            "WheelSystem::Body::execute",
            "VelSensor::measure",
            "FirstTimer::expired",
        ),
        ("main-thread", "MainController::Body::execute", "RC::read", "ActiveSensor::serve"),
        # The context reaches an extension of weeding_robot. It reaches no state of another product.
        (
            "main-thread",
            "MainController::Body::execute",
            "ProtectiveStop::follow",
            "WaitingK::actionNoMsg",
        ),
    ],
)
def test_a_context_reaches_the_objects_that_the_composition_connects(
    model: Facts, context: str, first: str, reaches: str, not_reached: str
) -> None:
    found = model["contexts"][context]
    assert found["first"] == [first]
    assert reaches in found["methods"]
    assert not_reached not in found["methods"]


@pytest.mark.parametrize(
    ("pipe", "kind", "writer", "reader"),
    [  # a pipe that is a member of a class, and a pipe outside classes
        (
            "WheelSystemBuilder::velocities_",
            "Pipe<Velocity>",
            "VelSensor::measure",
            "WheelController::velocity",
        ),
        (
            "extensions/safety/k64/main.cpp:rcVelocity",
            "Pipe<Velocity>",
            "VelocityBuffer::keep",
            "BufferReader::take",
        ),
    ],
)
def test_a_pipe_has_type_writer_and_reader(
    model: Facts, pipe: str, kind: str, writer: str, reader: str
) -> None:
    (found,) = [one for one in model["pipes"] if one["id"] == pipe]
    assert found["type"] == kind
    assert list(found["writers"]) == [writer]
    assert reader in found["readers"]


def test_a_part_of_a_data_type_has_unit_makers_and_readers(model: Facts) -> None:
    parts = {part["name"]: part for part in model["modules"]["SetPoints"]["parts"]}
    assert parts["steering"]["unit"] == "0.01 degree"
    assert "OrderMessage" in parts["steering"]["makers"]
    assert "DirSystem" in parts["steering"]["readers"]
    assert parts["orderId"]["readers"] == ["ReportMessage"]


def test_a_field_has_its_width_and_the_messages_that_write_and_read_it(model: Facts) -> None:
    fields = {field["name"]: field for field in model["messages"]}
    steering = fields["Steering"]
    assert (steering["width"], steering["writers"]) == ("i16", ["ReportMessage"])
    assert steering["readers"] == ["OrderMessage"]
    assert fields["WheelQuantity"]["width"] == "u8"


def test_a_likely_change_edits_the_composition_and_leaves_the_rest(model: Facts) -> None:
    change = model["changes"]["reading-modes"]
    assert (change["hidden_by"], change["role"]) == ("Mode", "Concrete State")
    assert change["edits"] == ["MainControllerBuilder"]
    assert {"PC", "RC"} <= set(change["altered"])
    assert "MainController" in change["untouched"]
    assert "MainControllerBuilder" not in change["untouched"]


def test_a_connection_of_the_architecture_is_a_way_through_the_code(model: Facts) -> None:
    ways = {(one["source"], one["target"]): one["way"] for one in model["connections"]}
    way = ways["MainController", "SerialReader"]
    assert way[0].startswith("MainController::")
    assert way[-1].startswith("SerialReader::")
    assert len(way) > 2


def test_the_title_of_a_section_has_no_sentence_in_it(model: Facts) -> None:
    titles = {one["section"] for one in model["requirements"].values()}
    assert sorted(title for title in titles if len(title.split()) > 5) == []
    assert len(titles) > 15
