"""Reads what ``design/`` declares: trees, state machines, architecture, uses, pattern tables."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from traceability.model.changes import ChangeTexts, read_change_texts
from traceability.model.concordance import Concordance, read_concordance
from traceability.model.schema import (
    AllowedUse,
    Apart,
    ArchitectureElement,
    ArchitectureGroup,
    BoardFinding,
    Connection,
    Cycle,
    ExecutionContext,
    Justified,
    Place,
    StateMachine,
    Transition,
    TreeNode,
)

PACKAGE_DESIGN = Path(__file__).parents[2] / "design"


@dataclass
class ClauseText:
    id: str
    pattern: str
    says: str
    mend: str
    about: list[str]  # roles whose modules the clause speaks of


@dataclass
class KnownApplication:
    """An application of the design, and the modules that play each of its roles."""

    id: str
    pattern: str
    roles: dict[str, list[str]]
    place: Place
    replaces: list[str] = field(default_factory=list)  # operations that decorators do not forward


@dataclass
class KnownPattern:
    """A pattern: the roles that each application binds, and how many applications there are."""

    name: str
    applications: int
    roles: list[str]
    place: Place


@dataclass
class SharedFunctions:
    """A file that is no module: functions that the modules of a folder share."""

    file: str
    why: str
    place: Place


@dataclass
class Block:
    """A block of registers, and the modules that own it."""

    name: str
    owners: list[str]
    place: Place


@dataclass
class PipeText:
    """What a pipe of the robot is called."""

    name: str
    says: str
    place: Place


@dataclass
class Protection:
    """How a member that contexts share is protected."""

    protection: str
    why: str
    place: Place


@dataclass
class Declared:
    machines: dict[str, StateMachine] = field(default_factory=dict)
    architecture: list[ArchitectureElement] = field(default_factory=list)
    groups: list[ArchitectureGroup] = field(default_factory=list)
    connections: list[Connection] = field(default_factory=list)
    allowed: list[AllowedUse] = field(default_factory=list)
    cycles: list[Cycle] = field(default_factory=list)
    trees: dict[str, tuple[Place, TreeNode | None]] = field(default_factory=dict)
    tree_errors: list[tuple[Place, str]] = field(default_factory=list)
    applications: dict[str, KnownApplication] = field(default_factory=dict)
    clauses: dict[str, ClauseText] = field(default_factory=dict)
    patterns: list[KnownPattern] = field(default_factory=list)
    apart: list[Apart] = field(default_factory=list)
    shared: list[SharedFunctions] = field(default_factory=list)
    names: dict[str, list[str]] = field(default_factory=dict)  # logic module -> its modules
    name_places: dict[str, Place] = field(default_factory=dict)  # logic module -> its entry
    total: int | None = None  # how many modules the design has
    blocks: list[Block] = field(default_factory=list)
    contexts: dict[str, ExecutionContext] = field(default_factory=dict)
    ends: list[str] = field(default_factory=list)  # methods that end the firmware
    pipes: dict[str, PipeText] = field(default_factory=dict)
    protections: dict[str, Protection] = field(default_factory=dict)  # member, or Class::*
    board_findings: dict[str, BoardFinding] = field(default_factory=dict)
    justified: list[Justified] = field(default_factory=list)
    concordance: Concordance = field(default_factory=Concordance)
    changes: ChangeTexts = field(default_factory=ChangeTexts)


def read_declared(root: Path) -> Declared:
    declared = Declared()
    design = root / "design"
    for path in sorted((design / "fsm").glob("*.toml")):
        machine = _machine(root, path)
        declared.machines[machine.id] = machine
    declared.architecture = [
        ArchitectureElement(
            item["id"], item["kind"], item["name"], item["text"], item["modules"], place
        )
        for item, place in _tables(root, design / "architecture.toml", "element")
    ]
    declared.groups = [
        ArchitectureGroup(item["name"], item["module"], item["modules"], place)
        for item, place in _tables(root, design / "architecture.toml", "group")
    ]
    declared.connections = [
        Connection(item["kind"], item["from"], item["to"], item.get("connector", ""), place)
        for item, place in _tables(root, design / "architecture.toml", "connection")
    ]
    declared.allowed = [
        AllowedUse(item["from"], item["to"], item["why"], place)
        for item, place in _tables(root, design / "uses.toml", "allow")
    ]
    declared.cycles = [
        Cycle(item["within"], item["modules"], item["pattern"], place)
        for item, place in _tables(root, design / "uses.toml", "cycle")
    ]
    for path in sorted((design / "trees").glob("*.tree")):
        _trees(root, path, declared)
    for item, place in _tables(root, design / "applications.toml", "application"):
        known = KnownApplication(
            item["id"], item["pattern"], item["roles"], place, item.get("replaces", [])
        )
        declared.applications[known.id] = known
    for item, _ in _tables(root, design / "clauses.toml", "clause"):
        clause = ClauseText(**item)
        declared.clauses[clause.id] = clause
    declared.blocks = [
        Block(item["name"], item["owners"], place)
        for item, place in _tables(root, design / "register_owners.toml", "block")
    ]
    _execution(root, design / "execution.toml", declared)
    for item, place in _tables(root, design / "board_findings.toml", "finding"):
        declared.board_findings[item["id"]] = BoardFinding(item["id"], item["says"], place)
    declared.justified = [
        Justified(kind, item["names"], item["why"], place)
        for kind in ("method", "test", "line")
        for item, place in _tables(root, design / "justified.toml", kind)
    ]
    declared.concordance = read_concordance(root)
    declared.changes = read_change_texts(root)
    for item, place in _tables(root, design / "modules.toml", "logic"):
        declared.names[item["folder"]] = item["modules"]
        declared.name_places[item["folder"]] = place
    declared.shared = [
        SharedFunctions(item["file"], item["why"], place)
        for item, place in _tables(root, design / "modules.toml", "shared")
    ]
    declared.total = _total(design / "modules.toml")
    declared.patterns = [
        KnownPattern(item["name"], item["applications"], item["roles"], place)
        for item, place in _tables(root, design / "clauses.toml", "pattern")
    ]
    declared.apart = [
        Apart(item["modules"], item["others"], item["why"], place)
        for item, place in _tables(root, design / "uses.toml", "apart")
    ]
    return declared


def _total(path: Path) -> int | None:
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    total = tomllib.loads(text).get("total")
    return int(total) if total is not None else None


def _tables(root: Path, path: Path, name: str) -> list[tuple[dict[str, Any], Place]]:
    """The entries ``[[name]]`` of a file, each with its line."""
    if not path.exists():
        return []
    text = path.read_text(encoding="utf-8")
    header = f"[[{name}]]"
    numbers = [number for number, line in enumerate(text.splitlines(), 1) if line.strip() == header]
    file = str(path.relative_to(root))
    entries = tomllib.loads(text).get(name, [])
    return [(entry, Place(file, number)) for entry, number in zip(entries, numbers, strict=True)]


def _machine(root: Path, path: Path) -> StateMachine:
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    transitions = [
        Transition(
            item["from"],
            item["on"],
            item.get("guard", ""),
            item["to"],
            item.get("action", ""),
            place,
            item.get("requirements", []),
        )
        for item, place in _tables(root, path, "transition")
    ]
    return StateMachine(
        id=data["id"],
        title=data["title"],
        application=data["application"],
        initial=data["initial"],
        states=data["states"],
        transitions=transitions,
        place=Place(str(path.relative_to(root)), 1),
        events=data.get("events", {}),
    )


def _execution(root: Path, path: Path, declared: Declared) -> None:
    if not path.exists():
        return
    declared.ends = tomllib.loads(path.read_text(encoding="utf-8"))["ends"]
    for item, place in _tables(root, path, "context"):
        item.setdefault("body", "")
        declared.contexts[item["id"]] = ExecutionContext(place=place, **item)
    for item, place in _tables(root, path, "pipe"):
        declared.pipes[item["object"]] = PipeText(item["name"], item["says"], place)
    for item, place in _tables(root, path, "shared"):
        for member in item["members"]:
            declared.protections[member] = Protection(item["protection"], item["why"], place)


def _trees(root: Path, path: Path, declared: Declared) -> None:
    file = str(path.relative_to(root))
    current = ""
    stack: list[tuple[int, TreeNode]] = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        words = line.split("#")[0].rstrip()
        if not words:
            continue
        place = Place(file, number)
        if re.fullmatch(r"N?FR-\d+", words):
            current, stack = words, []
            declared.trees[current] = (place, None)
            continue
        match = re.fullmatch(r"((?:  )*)(post )?([\w:~]+)::(~?\w+)", words)
        if match is None or not current:
            declared.tree_errors.append((place, "this line is neither an id nor a node"))
            continue
        depth = len(match[1]) // 2
        node = TreeNode(
            label=f"{match[3]}::{match[4]}",
            module=match[3].split("::")[0],
            method=match[4],
            resolved=None,
            kind="post" if match[2] else "call",
            place=place,
        )
        while stack and stack[-1][0] >= depth:
            stack.pop()
        if stack:
            stack[-1][1].children.append(node)
        elif declared.trees[current][1] is None:
            node.kind = "root"
            declared.trees[current] = (declared.trees[current][0], node)
        else:
            declared.tree_errors.append((place, f"the tree of {current} has a second root"))
            continue
        stack.append((depth, node))
