"""The layers of folders on the page "Uses"."""

from __future__ import annotations

from portal.layers import layers
from traceability.schema import AllowedUse, Place

PLACE = Place("design/uses.toml", 1)
USES = [
    ("*", "units"),
    ("devices", "services"),
    ("k64", "devices"),
    ("k64/start_up", "k64"),
    ("k64/start_up", "main_control/modes"),
    ("main_control/modes", "main_control"),
    ("main_control", "main_control/modes"),
    ("main_control", "services"),
    ("extensions/safety/code", "main_control"),
]


def allowed(*more: tuple[str, str]) -> list[AllowedUse]:
    return [AllowedUse(source, target, "why", PLACE) for source, target in (*USES, *more)]


def test_a_folder_may_use_only_folders_of_lower_layers() -> None:
    found = layers(allowed())
    assert [(one.layer, one.name) for one in found] == [
        (1, "units"),
        (2, "services"),
        (3, "devices"),
        (3, "main_control"),
        (4, "extensions/safety"),
        (4, "k64"),
        (5, "k64/start_up"),
    ]
    assert found[-1].uses == ["k64", "main_control", "units"]


def test_uses_that_form_a_cycle_have_no_layers() -> None:
    assert layers(allowed(("services", "devices"))) == []
