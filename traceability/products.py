"""The products: each is an image of its own, which CMake makes from a composition."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable
from pathlib import Path

from traceability.sources import DESIGN, files_below

DEFAULT = "weeding_robot"
PAPER = "weeding_robot_paper"  # the paper's design alone: without safety functions
# Each product, and what commands it.
PRODUCTS = {
    DEFAULT: "the PC and the remote control, with safety functions",
    PAPER: "the PC and the remote control; the paper's design alone",
    "weeding_robot_pc": "the PC, with safety functions",
    "weeding_robot_pc_bluetooth": "the PC and a Bluetooth device, with safety functions",
    "weeding_robot_warning": "the PC and the remote control; warns before it stops",
}
REMOTE_CONTROL = {
    *("RC", "RcPin", "ReadRcPin", "RcBuffer", "VelocityBuffer", "DirectionBuffer"),
    *("RcVelocity", "RcDirection", "BufferReader", "WidthCollector"),
}
SAFETY = {
    *("SafeSystem", "OrderStageDecorator", "RobotStage", "SafetyBuilder"),
    *(
        "ProtectiveStop",
        "ContactWatch",
        "RetainedProtection",
        "WheelSupervision",
        "Arming",
        "SetPointRamp",
        "SpeedLimited",
    ),
}
STOP_MEMORY = {"PersistentStop", "RetainedStop"}
ENABLE_SWITCH = {
    *("EnableSwitch", "EnableBuffer", "PulsePosition", "RcVigilance", "SteeringGeometry"),
}
# Each product: what it has of the modules in which products differ. All have the rest.
HAS = {
    DEFAULT: REMOTE_CONTROL | SAFETY | STOP_MEMORY | ENABLE_SWITCH | {"SafetyDirector"},
    PAPER: REMOTE_CONTROL | {"RobotDirector"},
    "weeding_robot_pc": SAFETY | STOP_MEMORY | {"SafetyPcDirector"},
    "weeding_robot_pc_bluetooth": SAFETY
    | STOP_MEMORY
    | {"Bluetooth", "SignedPort", "SipHash", "BluetoothDirector"},
    "weeding_robot_warning": REMOTE_CONTROL | {"WaitingK", "WarningDirector"},
}
DIFFERENT = set().union(*HAS.values())
RESULTS = Path("build/results/products.json")  # what each image holds

# A symbol of a class of the project: a method, an object that it owns, or its table of methods.
SYMBOL = re.compile(r"[0-9a-f ]+ \w (?:[a-z-]+(?: [a-z]+)? (?:for|to) )?wr::(\w+)")


def intruders(held: Iterable[str], has: set[str]) -> set[str]:
    """The modules in an image that its product should not have."""
    return (set(held) & DIFFERENT) - has


def image_of(product: str, suffix: str) -> Path:
    return Path("build/k64") / f"{product}{suffix}"


def module_names(root: Path) -> set[str]:
    """The design modules: each has a header of its name, with its secret."""
    headers = files_below(root, DESIGN, (".hpp",))
    return {path.stem for path in headers if "@secret" in path.read_text(encoding="utf-8")}


def modules_in(elf: Path, known: Iterable[str]) -> list[str]:
    """The known modules of which an image holds code or constants, by its symbols."""
    words = ["arm-none-eabi-nm", "--demangle", str(elf)]
    listed = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    return sorted(modules_of(listed).intersection(known))


def modules_of(listed: str) -> set[str]:
    """The classes of the project in a list of symbols."""
    return {match[1] for match in map(SYMBOL.match, listed.splitlines()) if match}
