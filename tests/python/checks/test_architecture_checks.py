"""The check arch-module compares the modules of the architecture elements with the connections and
the groups."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from traceability.checks.architecture_checks import check
from traceability.schema import ArchitectureElement, ArchitectureGroup, Connection, Place

PLACE = Place("design/architecture.toml", 1)
MODULES = {"Controller": None, "Motor": None, "Brake": None, "Sensor": None}


def element(kind: str, *modules: str) -> ArchitectureElement:
    return ArchitectureElement(kind, kind, kind.title(), "It acts.", modules, PLACE)


def connection(kind: str, source: str, target: str) -> Connection:
    return Connection(kind, source, target, "", (), PLACE, ["Controller::run"])


CONTROLLER, PROCESS, SENSOR = (
    element("controller", "Controller"),
    element("process", "Motor"),
    element("sensor", "Sensor"),
)
COMMAND = connection("command", "Controller", "Motor")
PHYSICAL = connection("physical", "Motor", "Sensor")


@pytest.mark.parametrize(
    ("elements", "connections", "says"),
    [
        ([CONTROLLER, PROCESS, SENSOR], [COMMAND, PHYSICAL], []),
        (
            [CONTROLLER, element("process", "Motor", "Brake"), SENSOR],
            [COMMAND, PHYSICAL],
            ["no connection and no group contains Brake, a module of Process"],
        ),
        (
            [element("controller", "Controller", "Motor"), PROCESS, SENSOR],
            [COMMAND, PHYSICAL],
            ["Motor is a module of Controller and of Process"],
        ),
        (
            [CONTROLLER, element("process", "Brake"), SENSOR],
            [COMMAND, PHYSICAL, connection("call", "Brake", "Motor")],
            [
                "Motor has a command connection, but is not a module of a process",
                "Motor has a physical connection, but is not a module of a process",
                "no physical connection begins at a module of Process",
            ],
        ),
        (
            [CONTROLLER, PROCESS, element("sensor", "Controller")],
            [COMMAND, PHYSICAL],
            [
                "Controller is a module of Controller and of Sensor",
                "Sensor has a physical connection, but is not a module of a sensor",
            ],
        ),
    ],
)
def test_the_modules_of_an_element_agree_with_the_connections(
    elements: list[ArchitectureElement], connections: list[Connection], says: list[str]
) -> None:
    assert findings(elements, connections, []) == says


def test_a_module_of_a_group_needs_no_connection() -> None:
    group = ArchitectureGroup("Drive", "Motor", ["Motor", "Brake"], PLACE)
    elements = [CONTROLLER, element("process", "Motor", "Brake"), SENSOR]
    assert not findings(elements, [COMMAND, PHYSICAL], [group])


def findings(
    elements: list[ArchitectureElement],
    connections: list[Connection],
    groups: list[ArchitectureGroup],
) -> list[str]:
    model: Any = SimpleNamespace(
        modules=MODULES, architecture=elements, connections=connections, groups=groups
    )
    facts: Any = SimpleNamespace(line_in=lambda place, _name: place)
    return [finding.text for finding in check(model, facts)]
