"""A small project whose model has data for every kind of page."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

from tests.python.project_files import write_files
from traceability.model.design_model import Model
from traceability.model.report import Report, Verdict
from traceability.schema import (
    HOST,
    VIRTUAL_K64,
    AllowedUse,
    ArchitectureElement,
    BindingResult,
    BoardFinding,
    Call,
    Clause,
    Curve,
    DriverFault,
    FileCoverage,
    LikelyChange,
    LogicModule,
    LoopFigure,
    LoopPlot,
    LoopRun,
    LoopScenario,
    Method,
    Module,
    PaperElement,
    PaperPlace,
    Param,
    PatternApplication,
    Place,
    Requirement,
    RoleBinding,
    StateMachine,
    Test,
    TraceRow,
    Transition,
    TreeNode,
    TreeRun,
    Use,
)

PLACE = Place("design/a.toml", 3)
REPORT = Report(
    requirements={"FR-15": Verdict("verified")},
    clauses={"reading-modes": [Clause("pattern-state-abstract", "It is abstract", True, [PLACE])]},
)

MODES = "main_control/operation_modes"
HEADER = "#pragma once\n\nnamespace wr {\nclass {name} {{\n public:\n  void read();\n}};\n}}\n"
SOURCE = "namespace wr {\n\nvoid {name}::read() {{\n  act();\n}}\n}}\n"


# All projects of a process share the compiled templates and the finished diagrams.
SHARED = tempfile.TemporaryDirectory(prefix="portal-")


def make_project(root: Path) -> Model:
    """Writes the files of the project, and returns the model of the project."""
    for name in ("pages-cache/templates", "diagrams"):
        folder, shared = root / "build" / name, Path(SHARED.name, name)
        shared.mkdir(parents=True, exist_ok=True)
        if not folder.exists():
            folder.parent.mkdir(parents=True, exist_ok=True)
            folder.symlink_to(shared)
    files = {"docs/tour.rst": "Tour\n====\n\nSee :module:`RC` and :method:`RC::read`.\n"}
    for name, folder in (("MainController", "main_control"), ("Mode", MODES), ("RC", MODES)):
        for suffix, text in (("hpp", HEADER), ("cpp", SOURCE)):
            file = f"src/{folder}/{name}.{suffix}"
            files[file] = text.replace("{name}", name).replace("{{", "{")
    write_files(root, files)
    return make_model()


def make_model() -> Model:
    call = Call("Mode::read", True, Place("src/main_control/MainController.cpp", 4), ["RC::read"])
    controller = make_module("MainController", "main_control", "Context", [], calls=[call])
    mode = make_module("Mode", MODES, "State", [])
    rc = make_module("RC", MODES, "Concrete State", ["Mode"], satisfies=["FR-15"])
    controller, mode = replace(controller, uses=["Mode"]), replace(mode, subclasses=["RC"])
    rc = replace(rc, requirements=["FR-15"], tests=["RcTest.Reads"])
    modules = {m.name: m for m in (controller, mode, rc)}
    asked = Place("design/fsm/a.toml", 3)
    place = Place("src/main_control/MainController.cpp", 1)
    found = Place("design/board_findings.toml", 4)
    return Model(
        "0123456789abcdef", "0.1", "hash", {HOST: "hash", VIRTUAL_K64: "hash"},
        logic_modules={
            "main_control": LogicModule(
                "main_control", "MainControl", None, "Main Control.", "Runs the cycle.",
                "The steps.", Place("src/main_control/module.dox", 1),
                ["MainController"], [MODES],
            ),
            MODES: LogicModule(
                MODES, "OperationModes", "main_control", "Modes: the sources of orders.",
                "Reads.", "The sources.", Place(f"src/{MODES}/module.dox", 1),
                ["Mode", "RC"],
            ),
        },
        modules=modules,
        patterns={
            "reading-modes": PatternApplication(
                "reading-modes", "State", "Reading modes", "Sources differ.",
                "A new source.", "Mode", mode.place, [m.roles[0] for m in (mode, rc, controller)],
            )
        },
        requirements={"FR-15": make_requirement()},
        tests={
            "RcTest.Reads": Test(
                "RcTest.Reads", "RcTest", "Reads", "It reads.", Place("tests/RcTest.cpp", 9),
                ["FR-15"], {HOST: BindingResult("passed", 0.25)},
            )
        },
        machines={
            "reading-modes": StateMachine(
                "reading-modes", "Reading modes", "reading-modes", "RC", {"RC": "RC"},
                [
                    Transition("RC", "newMessage", "", "RC", "read", asked, ["FR-15"]),
                    Transition("RC", "noMessage", "", "RC", "", asked, ["FR-16"]),
                ],
                Place("design/fsm/a.toml", 1),
                events={"newMessage": "read", "noMessage": "read"},
                note="A guard uses old values.",
            )
        },
        uses=[Use("main_control", MODES, [place])],
        allowed_uses=[AllowedUse("main_control", MODES, "it reads", place)],
        architecture=[
            ArchitectureElement(name, "controller", name, "Text.", ["RC"], place)
            for name in ARCHITECTURE
        ],
        board_findings={
            "clock-gate": BoardFinding("clock-gate", "The clock is off.", found, ["RcTest.Reads"]),
        },
        driver_faults=[
            DriverFault(
                "Clock gate of UART0 left closed", f"src/{MODES}/RC.cpp", "clock-gate", True,
                "finding: clock-gate: UART0, in wr::K64Uart::start() at src/k64/K64Uart.cpp:31",
            )
        ],
        closed_loop=[
            LoopScenario(
                "step", "A step", "It steps.", "sim/scenario/examples/step.scenario",
                Place("design/closed_loop.toml", 1),
                [LoopPlot("Velocity", "rpm", [
                    Curve("set_point", HOST, [(0.0, 0.0), (1.0, 150.0)]),
                    Curve("truth", HOST, [(0.0, 0.0), (1.0, 20.0), (9.0, 150.0)]),
                ])],
                [LoopFigure("Settling time", 2000, "ms", "FR-15", {HOST: 1050.0})],
                {HOST: LoopRun(True, "")},
            )
        ],
        paper_places=[PaperPlace("Figure 1", "figure", "Modes", Place("design/paper.toml", 4))],
        paper=[
            PaperElement("figure", "Figure 1", ["machine:reading-modes", "view:guide"]),
            PaperElement("module", "CR", ["module:RC"], "The name is `RC`.", where=["Figure 1"]),
            PaperElement("method", "Mode::ask", ["method:Mode::read"], deviation="It reads."),
        ],
        changes={
            "reading-modes": LikelyChange(
                "reading-modes", "State", "Mode", ["RC"], "Concrete State", ["Mode"], MODES, [],
                ["Mode", "RC", "MainController"], ["FR-15"], ["RcTest.Reads"],
                ["Derive from {derives}.", "Construct it in {edits}."], [],
            )
        },
        host_files={
            f"src/{MODES}/RC.cpp": FileCoverage({3: True, 4: False}, [3], (1, 2)),
            "src/services/assertion.hpp": FileCoverage({4: True, 5: True}, [], (0, 0)),
        },
        files=[
            *(f for m in modules.values() for f in (m.header, str(m.source))),
            "src/services/assertion.hpp",
        ],
    )  # fmt: skip


ARCHITECTURE = [
    "clock-pulse",
    "main-control",
    "wheel-control",
    "direction-control",
    "wheel",
    "steering-device",
    "velocity-sensor",
    "current-sensor",
    "position-sensor",
    "tension",
    "steering-position",
    "set-points",
    "pipe",
    "connect-pc-to-mcu",
    "connect-mcu-to-pc",
    "connect-buffer-to-mcu",
]


def make_module(name: str, logic: str, role: str, bases: list[str], **method: Any) -> Module:
    header = f"src/{logic}/{name}.hpp"
    source = f"src/{logic}/{name}.cpp"
    place, abstract = Place(header, 4), role == "State"
    only = Method(
        f"{name}::read", name, "read", "void read(int order)", "public",
        "pure" if abstract else "plain", Place(header, 6), Place(source, 3, 5),
        brief="Reads an order.", params=[Param("order", "int", "the order")],
        interrupt="no", documented=True, **method,
    )  # fmt: skip
    return Module(
        name, f"wr::{name}", logic, abstract, False, f"The {name}.",
        "Calls `RC::read` for FR-15.", f"The secret of {name}.",
        place, header, source, bases, methods=[only],
        roles=[RoleBinding("reading-modes", role, name, place)],
    )  # fmt: skip


def make_requirement() -> Requirement:
    place = Place("design/trees/a.tree", 2)
    child = TreeNode("RC::read", "RC", "read", "RC::read", "call", place, True, {HOST: True})
    root = TreeNode(
        "MainController::read", "MainController", "read", "MainController::read", "root", place,
        True, {HOST: True}, children=[child],
    )  # fmt: skip
    trace = [
        TraceRow(0, "MainController::read", "MainController"),
        TraceRow(1, "Pipe::read", None),
        TraceRow(1, "RC::read", "RC"),
    ]
    return Requirement(
        "FR-15", "The system shall wait.", "Reading", Place("requirements/a.dox", 5),
        "Why.", "The paper.", "Test.", "high", satisfied_by=["RC::read"],
        verified_by=["RcTest.Reads"], tree=root,
        runs={HOST: TreeRun("RcTest.Reads", trace, 40, [0, 2])},
    )  # fmt: skip
