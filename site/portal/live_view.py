"""The page that runs the simulated robot in the browser. This module collects the firmware images.
It also collects data from the model. The page shows these data while a firmware image runs."""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from portal import plots
from portal.portal import Portal
from portal.writing import remove_others, write_changed
from traceability.grouping import grouped
from traceability.model.design_model import Model
from traceability.reading import task_record
from traceability.reading.closed_loop_record import EXAMPLES
from traceability.reading.declared_safety import SCENARIOS
from traceability.reading.products import (
    CALLS_SUFFIX,
    DEFAULT,
    PAPER,
    PRODUCTS,
    image_of,
    recorded_image_of,
)
from traceability.reading.results import LIVE, LIVE_MODULE, read_fresh
from traceability.reading.traces import read_symbols
from traceability.schema import Method, TreeNode
from weeding_robot_client.layout import Field, Layout, read_frames

FOLDER = "live"  # folder in the site that contains the files of this page
DATA = "live.json"
# Before the reader starts the robot, the page shows the recorded curves of this scenario.
RECORDED = "stop"
SIGNATURE = re.compile(r"(?P<result>.+?) ?\b\w+\((?P<parameters>[^()]*)\)")
INTEGERS = {"void": "", "bool": "bool"} | {
    f"std::{sign}int{bits}_t": f"{kind}{bits}"
    for sign, kind in (("", "i"), ("u", "u"))
    for bits in (8, 16, 32)
}


@dataclass
class Image:
    """A firmware image that the page can run."""

    name: str
    product: str
    # True: the firmware image that is also flashed to a board. False: the firmware image for the
    # display of calls, in which each method is a separate function.
    flashed: bool
    commands: str
    size: int
    sha256: str


def images(root: Path) -> list[Image]:
    """Returns the firmware images that were built. The list is empty if the WebAssembly module was
    not built, because this module runs the images."""
    if not (root / LIVE_MODULE).exists():
        return []
    built = []
    for product, commands in PRODUCTS.items():
        for name, flashed in ((f"{product}{CALLS_SUFFIX}", False), (product, True)):
            path = root / file_of(name, ".bin")
            if path.exists():
                content = path.read_bytes()
                digest = hashlib.sha256(content).hexdigest()
                built.append(Image(name, product, flashed, commands, len(content), digest))
    return built


def file_of(name: str, suffix: str) -> Path:
    """Returns the path of a firmware image that the page loads."""
    product = name.removesuffix(CALLS_SUFFIX)
    return image_of(product, suffix) if product == name else recorded_image_of(product, suffix)


def run(portal: Portal) -> dict[str, Any]:
    """Returns the values for the template of the page."""
    built = images(portal.root)
    module = portal.root / LIVE_MODULE
    ran = [scenario for scenario in portal.model.closed_loop if scenario.runs]
    shown = [scenario for scenario in ran if scenario.name == RECORDED] or ran[:1]
    return {
        "images": built,
        "chosen": f"{PAPER}{CALLS_SUFFIX}",
        "scenarios": scenarios(portal.root, portal.model),
        "module_bytes": module.stat().st_size if built else 0,
        "recorded": shown,
        "drawings": {scenario.name: plots.draw_all(scenario.plots) for scenario in shown},
        "machines": list(portal.model.machines.values()),
        "measured": read_fresh(portal.root, LIVE, task_record.LIVE),
        "wide": True,
        "bare": True,
    }


def write_live(portal: Portal, site: Path) -> None:
    """Writes the files that the page loads when the reader starts the robot."""
    root, folder = portal.root, site / FOLDER
    built = images(root)
    names = [f"{image.name}.bin" for image in built]
    remove_others(folder, "*", [*names, DATA, LIVE_MODULE.name] if built else [])
    if not built:
        return
    write_changed(folder / LIVE_MODULE.name, (root / LIVE_MODULE).read_bytes())
    for image in built:
        write_changed(
            folder / f"{image.name}.bin", (root / file_of(image.name, ".bin")).read_bytes()
        )
    write_changed(folder / DATA, json.dumps(facts(portal, built), separators=(",", ":")))


def facts(portal: Portal, built: list[Image]) -> dict[str, Any]:
    """Returns the content of ``live.json``."""
    model = portal.model
    methods = [m.id for module in portal.designs for m in module.methods]
    numbers = {name: number for number, name in enumerate(dict.fromkeys(methods))}
    entered = entered_by_hardware(model)
    for name in sorted(entered):
        numbers.setdefault(name, len(numbers))
    table = read_frames((portal.root / "design/frames.toml").read_text(encoding="utf-8"))
    return {
        "methods": list(numbers),
        "parameters": parameters(portal, numbers),
        "hardware": sorted(numbers[name] for name in entered),
        "modules": [
            {
                "name": design.name,
                "logic": design.logic,
                "page": address(portal.links.module(design.name)),
            }
            for design in portal.designs
        ],
        "products": [
            asdict(image) | {"functions": functions(portal.root, image.name, numbers)}
            for image in built
        ],
        "trees": [
            {
                "id": requirement.id,
                "text": str(requirement.text),
                "products": list(requirement.products),
                "tree": tree(requirement.tree, overriders(model), portal, numbers),
            }
            for requirement in model.requirements.values()
            if requirement.tree is not None
        ],
        "machines": [
            {
                "id": machine.id,
                "title": machine.title,
                "initial": machine.initial,
                "states": dict(machine.states),
                "events": dict(machine.events),
                "transitions": [
                    [step.source, step.target, step.event, step.guard, list(step.requirements)]
                    for step in machine.transitions
                ],
            }
            for machine in model.machines.values()
        ],
        "frames": [frame(layout) for layout in table.frames.values()],
        "scenarios": scenarios(portal.root, model),
    }


def parameters(portal: Portal, numbers: dict[str, int]) -> dict[int, dict[str, Any]]:
    """For each method, returns the parameters that are passed in registers: the number of the
    register with the first parameter, and the name and kind of each parameter. The dictionary
    contains no overloaded methods, no methods without such a parameter, and no methods that may
    return their result in memory."""
    methods = (method for module in portal.designs for method in module.methods)
    found = grouped(methods, lambda method: method.id)
    return {
        numbers[name]: {"first": int(one[0].kind != "static"), "parameters": kinds}
        for name, one in found.items()
        if len(one) == 1 and (kinds := in_registers(one[0].signature))
    }


def in_registers(signature: str) -> list[list[str]]:
    """Returns the name and the kind of each parameter. The list ends before the first parameter
    whose type has no kind, because this parameter can be in memory instead of a register."""
    match = SIGNATURE.match(signature)
    if not match or kind_of(match["result"]) is None:
        return []
    kinds = []
    for parameter in filter(None, match["parameters"].split(", ")):
        type_, _, name = parameter.rpartition(" ")
        kind = kind_of(type_)
        if not kind:
            break
        kinds.append([name, kind])
    return kinds


def kind_of(type_: str) -> str | None:
    """Returns the kind of a type: "address" for pointers and references, a short name for integers
    and bool, an empty text for ``void``, and ``None`` for all other types."""
    if type_.endswith(("&", "*")):
        return "address"
    plain = type_.removeprefix("virtual ").removeprefix("static ").removeprefix("const ")
    return INTEGERS.get(plain)


def address(link: str | None) -> str:
    return (link or "").removeprefix("@/")


def entered_by_hardware(model: Model) -> set[str]:
    """Returns the functions that the hardware enters through the vector table of the firmware
    image. They are functions outside classes. No code of the firmware calls them."""
    called = {call.target for method in model.methods for call in method.calls}
    called |= {call.target for function in model.functions.values() for call in function.calls}
    return set(model.functions) - called


def functions(root: Path, name: str, numbers: dict[str, int]) -> list[list[int]]:
    """Returns the address of each method in a firmware image, and the number of the method in
    ``numbers``. The list is sorted by address."""
    cache = root / "build" / "pages-cache" / "symbols" / name
    symbols = read_symbols(root / file_of(name, ".elf"), "arm-none-eabi-nm", cache)
    return [[at, numbers[method]] for at, method in sorted(symbols.items()) if method in numbers]


def overriders(model: Model) -> dict[str, list[str]]:
    """Returns the direct and indirect overrides of each overridden method."""
    direct: dict[str, list[str]] = {}
    for method in model.methods:
        if method.overrides:
            direct.setdefault(method.overrides, []).append(method.id)

    def below(name: str) -> list[str]:
        return [method for own in direct.get(name, []) for method in (own, *below(own))]

    return {name: list(dict.fromkeys(below(name))) for name in direct}


def tree(
    node: TreeNode, over: dict[str, list[str]], portal: Portal, numbers: dict[str, int]
) -> dict[str, Any]:
    """Returns a declared invocation tree for the page. Each node lists the numbers of some
    methods: a recorded call of one of these methods matches the node."""
    method: Method | None = portal.links.find_method(node.resolved) if node.resolved else None
    accepted = [] if method is None else [method.id] if method.body else over.get(method.id, [])
    node_data: dict[str, Any] = {
        "n": node.label,
        "m": [numbers[n] for n in accepted if n in numbers],
    }
    if node.kind == "post":
        node_data["post"] = 1
    if node.children:
        node_data["c"] = [tree(child, over, portal, numbers) for child in node.children]
    return node_data


def frame(layout: Layout) -> dict[str, Any]:
    return {
        "name": layout.name,
        "kind": layout.kind,
        "fields": [field(entry) for entry in layout.fields],
    }


def field(field_entry: Field) -> dict[str, Any]:
    """Returns the description of a field of a frame, with the names of its values and bits."""
    data: dict[str, Any] = {
        "n": field_entry.name,
        "t": field_entry.type,
        "o": field_entry.offset,
        "m": field_entry.meaning,
    }
    if field_entry.unit:
        data |= {"u": field_entry.unit, "s": field_entry.scale}
    if field_entry.values:
        data["v"] = {entry.number: entry.shown for entry in field_entry.values.entries}
    if field_entry.bits:
        data["b"] = [bit.name for bit in field_entry.bits]
    return data


def first_comment(text: str) -> str:
    """Returns the text of the first comment of a scenario. The comment can have several lines."""
    comment = re.search(r"(?:^#.*\n?)+", text, re.MULTILINE)
    return " ".join(line[1:].strip() for line in comment[0].splitlines()) if comment else ""


def scenarios(root: Path, model: Model) -> list[dict[str, str]]:
    """Returns the scenarios that the page can play: the examples, and the fault scenarios."""
    titles = {
        scenario.name: (scenario.title.rstrip("."), "")
        for scenario in model.safety.scenarios.values()
    }
    titles |= {loop_run.name: (loop_run.title, loop_run.says) for loop_run in model.closed_loop}
    played = []
    for folder, product in ((EXAMPLES, PAPER), (SCENARIOS, DEFAULT)):
        for path in sorted((root / folder).glob("*.scenario")):
            text = path.read_text(encoding="utf-8")
            title, says = titles.get(path.stem, (path.stem.replace("_", " "), first_comment(text)))
            played.append(
                {
                    "name": path.stem,
                    "folder": folder.name,
                    "product": product,
                    "title": title,
                    "says": says,
                    "text": text,
                }
            )
    return played
