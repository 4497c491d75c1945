"""The page of the values for a single robot: its parameters, gains and limits."""

from __future__ import annotations

from typing import Any

from portal.portal import Portal
from portal.tuned_values import constant_named
from traceability.model.design_model import Model
from traceability.schema import Constant, Method, Tuned

ROBOT = "SystemConstants"  # the module with the values that several modules read
# The folders of the modules that control, measure or limit values.
CONTROL = (
    "src/wheel_control/",
    "src/steering_control/",
    "src/sensing/",
    "src/remote_control/",
    "src/functions/",
    "extensions/safety/",
)


def tuning(portal: Portal) -> dict[str, Any]:
    return {
        "robot": robot_values(portal.model),
        "dimensions": dimensions(portal),
        "control": control_values(portal.model),
    }


def robot_values(model: Model) -> list[tuple[Method, Constant]]:
    """Returns each method of SystemConstants that returns a number, and this number."""
    module = model.modules.get(ROBOT)
    methods = module.methods if module else []
    return [
        (method, model.constants[method.id]) for method in methods if method.id in model.constants
    ]


def dimensions(portal: Portal) -> list[tuple[Tuned, Constant]]:
    """Returns each value that depends on a constant outside SystemConstants, with this constant."""
    found = []
    for tuned in portal.model.tuned:
        constant = constant_named(portal.root, portal.model, tuned.to)
        if constant and not tuned.to.startswith(f"{ROBOT}::"):
            found.append((tuned, constant))
    return found


def control_values(model: Model) -> dict[str, list[tuple[str, Constant, list[str]]]]:
    """Returns the named constants that have a unit or depend on other constants, grouped by module.
    Each entry contains the name, the constant, and the names of the other constants on which the
    value depends."""
    values: dict[str, list[tuple[str, Constant, list[str]]]] = {}
    for name, constant in model.constants.items():
        chosen_for = [
            tuned.to for tuned in model.tuned if name.partition(".")[0] in tuned.constants
        ]
        module, _, own = name.partition("::")
        if not constant.place.file.startswith(CONTROL) or not own.startswith("k"):
            continue
        if constant.unit or chosen_for:
            values.setdefault(module, []).append((name, constant, chosen_for))
    return values
