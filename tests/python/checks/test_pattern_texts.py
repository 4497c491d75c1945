"""The text of a finding lists the modules that have a role. If no module has this role, the text
contains the name of the role."""

from types import SimpleNamespace
from typing import cast

from traceability.checks.pattern_clauses import Shape


def shape(*roles: tuple[str, str]) -> Shape:
    items = [SimpleNamespace(module=module, role=role) for module, role in roles]
    return cast(
        "Shape", SimpleNamespace(playing=lambda role: [m.module for m in items if m.role == role])
    )


def test_a_role_without_a_module_is_named() -> None:
    with_role = shape(("SetTurn", "Concrete Command"), ("StopWheel", "Concrete Command"))
    assert Shape.any_with(with_role, "Concrete Command") == "SetTurn or StopWheel"
    without = shape(("SetTurn", "Command"))
    assert Shape.any_with(without, "Receiver") == "module with the role Receiver"
