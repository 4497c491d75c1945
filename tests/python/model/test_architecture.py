"""Connections of the high-level diagram, looked for in the code of a small tree."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.python.model.lamp_tree import facts_of, write_lamp
from tests.python.model.test_execution import model_of
from traceability.checks import architecture_checks
from traceability.model.architecture import connections_of
from traceability.schema import ArchitectureElement, Connection, Place

PLACE = Place("design/architecture.toml", 1)


def way(root: Path, kind: str, source: str, target: str) -> tuple[list[str], list[str]]:
    """The way of a connection, and what is found about it."""
    facts = facts_of(write_lamp(root))
    model, _ = model_of(root)
    facts.declared.connections = [Connection(kind, source, target, "", PLACE)]
    model = replace(model, connections=connections_of(model, facts))
    findings = [f"[{one.check}] {one.text}" for one in architecture_checks.check(model, facts)]
    return model.connections[0].way, findings


def test_calls_are_followed_over_abstractions(tmp_path: Path) -> None:
    assert way(tmp_path, "call", "Work", "On") == (
        ["Work::execute", "Lamp::tick", "On::press"],
        [],
    )


def test_a_pipe_leads_from_its_writer_to_its_reader(tmp_path: Path) -> None:
    assert way(tmp_path, "pipe", "Button", "Lamp") == (["Button::execute", "Lamp::tick"], [])


@pytest.mark.parametrize("kind", ["call", "pipe"])
def test_a_connection_that_the_code_lacks_is_found(tmp_path: Path, kind: str) -> None:
    found = f"[arch-code] the code has no {kind} from On to Button"
    assert way(tmp_path, kind, "On", "Button") == ([], [found])


def test_what_lies_outside_needs_no_code(tmp_path: Path) -> None:
    assert way(tmp_path, "physical", "On", "Button") == ([], [])
    assert way(tmp_path, "pipe", "PC", "Button") == ([], [])


def test_names_of_modules_are_checked(tmp_path: Path) -> None:
    _, findings = way(tmp_path, "call", "On", "Bell")
    assert findings == ["[arch-module] there is no module Bell"]
    model, _ = model_of(tmp_path)
    model = replace(
        model, architecture=[ArchitectureElement("a", "sensor", "a", "", ["Eye"], PLACE)]
    )
    found = architecture_checks.check(model, facts_of(tmp_path))
    assert [one.text for one in found] == ["there is no module Eye"]
