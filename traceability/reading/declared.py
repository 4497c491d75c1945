"""Reads the declarations of ``design/``: trees, state machines, architecture, uses and patterns."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability import schema
from traceability.reading.change_kits import Kit, read_kits
from traceability.reading.concordance import Concordance, read_concordance
from traceability.reading.constant_texts import Constants
from traceability.reading.declared_safety import read_safety_case
from traceability.reading.proof_record import ProofEvent, read_events, read_properties
from traceability.reading.toml_reader import Entries, Problem
from traceability.schema import Place, TreeNode
from traceability.sources import files_below

CHANGES = Path("design/changes.toml")


@dataclass
class ClauseText:
    id: str
    pattern: str
    says: str
    fix: str
    # Roles that the clause mentions. For each clause, a page lists the modules with these roles.
    about: list[str]
    place: Place


@dataclass
class KnownApplication:
    """A pattern application that design/applications.toml declares. For each role, ``roles``
    contains the modules with this role."""

    id: str
    pattern: str
    roles: dict[str, list[str]]
    place: Place
    # operations that decorators do not forward to the component
    replaces: list[str] = field(default_factory=list)


@dataclass
class KnownPattern:
    """A pattern, its roles, and the number of its applications. Each application assigns at least
    one module to each role."""

    name: str
    applications: int
    roles: list[str]
    place: Place


@dataclass
class SharedFunctions:
    """A file with functions that several modules of a folder use. The file belongs to no module."""

    file: str
    why: str
    place: Place


@dataclass
class Block:
    name: str
    owners: list[str]
    place: Place


@dataclass
class PipeText:
    object: str  # Class::member
    name: str
    says: str
    place: Place


@dataclass
class Protection:
    protection: str
    why: str
    place: Place


@dataclass
class Recipe:
    """The recipe of a pattern: the steps that make a likely change where this pattern is used.
    ``alters``, ``adds`` and ``derives`` name roles of the pattern."""

    pattern: str
    # Each module with one of these roles implements one variant. To change a variant, only its
    # module must be edited.
    alters: list[str]
    adds: str = ""  # role of the class that the change adds
    derives: str = ""  # the added class derives from a class with this role
    steps: list[str] = field(default_factory=list)
    place: Place = field(default_factory=lambda: Place(str(CHANGES), 1))


@dataclass
class Particular:
    """The texts about the likely change of one pattern application."""

    id: str
    derives: list[str] = field(default_factory=list)
    examples: list[str] = field(default_factory=list)
    steps: list[str] = field(default_factory=list)
    place: Place = field(default_factory=lambda: Place(str(CHANGES), 1))


@dataclass
class Declared:
    entries: Entries = field(default_factory=lambda: Entries(Path()))
    machines: dict[str, schema.StateMachine] = field(default_factory=dict)
    architecture: list[schema.ArchitectureElement] = field(default_factory=list)
    groups: list[schema.ArchitectureGroup] = field(default_factory=list)
    connections: list[schema.Connection] = field(default_factory=list)
    allowed: list[schema.AllowedUse] = field(default_factory=list)
    cycles: list[schema.Cycle] = field(default_factory=list)
    trees: dict[str, tuple[Place, TreeNode | None]] = field(default_factory=dict)
    # place and text of each problem, and a text that explains how to fix the problem
    tree_errors: list[tuple[Place, str, str]] = field(default_factory=list)
    applications: dict[str, KnownApplication] = field(default_factory=dict)
    clauses: dict[str, ClauseText] = field(default_factory=dict)
    patterns: list[KnownPattern] = field(default_factory=list)
    apart: list[schema.Apart] = field(default_factory=list)
    shared: list[SharedFunctions] = field(default_factory=list)
    # logic module -> the names of its modules
    names: dict[str, list[str]] = field(default_factory=dict)
    # logic module -> the place of its entry
    name_places: dict[str, Place] = field(default_factory=dict)
    total: int | None = None  # number of modules in the paper
    blocks: list[Block] = field(default_factory=list)
    contexts: dict[str, schema.ExecutionContext] = field(default_factory=dict)
    ends: list[str] = field(default_factory=list)  # methods that stop the firmware and never return
    pipes: dict[str, PipeText] = field(default_factory=dict)
    # key: Class::member, or Class::* for all members of a class
    protections: dict[str, Protection] = field(default_factory=dict)
    board_findings: dict[str, schema.BoardFinding] = field(default_factory=dict)
    beliefs: list[schema.BoardBelief] = field(default_factory=list)
    belief_sources: dict[str, schema.BeliefSource] = field(default_factory=dict)
    justified: list[schema.Justified] = field(default_factory=list)
    equivalents: list[schema.Equivalent] = field(default_factory=list)
    numbers: list[schema.RequirementNumbers] = field(default_factory=list)
    numbers_without: list[schema.NumbersWithout] = field(default_factory=list)
    concordance: Concordance = field(default_factory=Concordance)
    tuned: list[schema.Tuned] = field(default_factory=list)
    recipes: dict[str, Recipe] = field(default_factory=dict)  # pattern -> its recipe
    particulars: dict[str, Particular] = field(default_factory=dict)
    # pattern application -> the folder that makes the likely change of this application
    kits: dict[str, Kit] = field(default_factory=dict)
    safety: schema.SafetyCase = field(default_factory=schema.SafetyCase)
    proofs: dict[str, schema.ProofProperty] = field(default_factory=dict)
    proof_events: dict[str, ProofEvent] = field(default_factory=dict)


# The files that a complete design must have. Invocation trees and state machines are in separate
# folders and are not listed here.
FILES = (
    *("applications", "architecture", "board_beliefs", "board_findings", "changes"),
    *("clauses", "closed_loop"),
    *("concordance", "execution", "justified", "modules", "mutants", "paper", "questions"),
    *("register_owners", "requirement_numbers", "safety_case", "stack", "statements"),
    *("tuned", "uses"),
)


def read_declared(root: Path, constants: Constants | None = None) -> Declared:
    entries = Entries(root, constants or {})
    declared = Declared(entries=entries)
    design = root / "design"
    _machines(root, entries, declared)
    _architecture(design / "architecture.toml", entries, declared)
    uses = design / "uses.toml"
    declared.allowed = _allowed(uses, entries)
    declared.cycles = entries.records(uses, "cycle", schema.Cycle)
    declared.apart = entries.records(uses, "apart", schema.Apart)
    for path in sorted((design / "trees").glob("*.tree")):
        _trees(root, path, declared)
    _patterns(design, entries, declared)
    declared.blocks = entries.records(design / "register_owners.toml", "block", Block, "name")
    _execution(design / "execution.toml", entries, declared)
    findings = design / "board_findings.toml"
    declared.board_findings = entries.named(findings, "finding", schema.BoardFinding, "id")
    beliefs = design / "board_beliefs.toml"
    sources = declared.belief_sources = entries.named(beliefs, "source", schema.BeliefSource, "id")
    outside = {each.id for each in sources.values() if each.outside}
    declared.beliefs = [
        replace(belief, shared=belief.source not in outside)
        for belief in entries.records(beliefs, "belief", schema.BoardBelief, shared=False)
    ]
    declared.justified = [
        entry
        for kind in ("method", "test", "line", "uncalled", "loop")
        for entry in entries.records(design / "justified.toml", kind, schema.Justified, kind=kind)
    ]
    declared.equivalents = entries.records(design / "mutants.toml", "equivalent", schema.Equivalent)
    declared.tuned = entries.records(
        design / "tuned.toml", "tuned", schema.Tuned, "to", may=("constants", "lines")
    )
    numbers, by_id = design / "requirement_numbers.toml", {"requirement": "id"}
    declared.numbers = entries.records(
        numbers, "requirement", schema.RequirementNumbers, "id", keys=by_id
    )
    declared.numbers_without = entries.records(numbers, "without", schema.NumbersWithout)
    declared.concordance = read_concordance(root, entries)
    changes, may = root / CHANGES, ["derives", "steps"]
    declared.recipes = entries.named(changes, "recipe", Recipe, "pattern", may=["adds", *may])
    declared.particulars = entries.named(
        changes, "application", Particular, "id", may=["examples", *may]
    )
    declared.kits = read_kits(root, entries)
    declared.safety = read_safety_case(root, entries)
    declared.proofs = read_properties(root, entries)
    declared.proof_events = read_events(root, entries)
    _modules(design / "modules.toml", entries, declared)
    entries.others()
    for path in files_below(root, ("design", "requirements"), (".toml",)):
        entries.whole(path)  # Other readers read the other tables of the file.
    if declared.total is not None:
        entries.absent(design / f"{name}.toml" for name in FILES)
    return declared


def _architecture(path: Path, entries: Entries, declared: Declared) -> None:
    declared.architecture = entries.records(path, "element", schema.ArchitectureElement, "id")
    declared.groups = entries.records(path, "group", schema.ArchitectureGroup, "name")
    ends = {"source": "from", "target": "to"}
    declared.connections = entries.records(
        path, "connection", schema.Connection, may=["connector", "through"], keys=ends
    )


def _allowed(path: Path, entries: Entries) -> list[schema.AllowedUse]:
    """Returns the allowed uses. The file has a table ``[uses."user"]`` for each user, with a line
    ``"used" = "reason"`` for each use."""
    tables = entries.value(path, "uses", {})
    begin = Place(str(path.relative_to(entries.root)), 1)
    uses: list[schema.AllowedUse] = []
    if not entries.fits(tables, begin, dict.fromkeys(tables, dict), {}):
        return uses
    for user, used in tables.items():
        place = entries.line_in(begin, f'uses."{user}"')
        if entries.fits(used, place, dict.fromkeys(used, str), {}):
            uses += [
                schema.AllowedUse(user, target, why, entries.line_in(place, f'"{target}"'))
                for target, why in used.items()
            ]
    return uses


def _patterns(design: Path, entries: Entries, declared: Declared) -> None:
    declared.applications = entries.named(
        design / "applications.toml", "application", KnownApplication, "id", may=["replaces"]
    )
    clauses = design / "clauses.toml"
    declared.clauses = entries.named(clauses, "clause", ClauseText, "id")
    declared.patterns = entries.records(clauses, "pattern", KnownPattern, "name")


def _modules(path: Path, entries: Entries, declared: Declared) -> None:
    declared.total = entries.value(path, "total", None)
    for item, place in entries.tables(
        path, "logic", {"folder": str, "modules": list}, own="folder"
    ):
        declared.names[item["folder"]] = item["modules"]
        declared.name_places[item["folder"]] = place
    declared.shared = entries.records(path, "shared", SharedFunctions, "file")


def _machines(root: Path, entries: Entries, declared: Declared) -> None:
    for path in sorted((root / "design" / "fsm").glob("*.toml")):
        machine = _machine(Place(str(path.relative_to(root)), 1), path, entries)
        if machine is not None and machine.id in declared.machines:
            text = f"{declared.machines[machine.id].place.file} already has a machine {machine.id}"
            fix = "use a different id for each machine"
            entries.problems.append(Problem(machine.place, text, fix))
        elif machine is not None:
            declared.machines[machine.id] = machine


def _machine(place: Place, path: Path, entries: Entries) -> schema.StateMachine | None:
    transitions = entries.records(
        path,
        "transition",
        schema.Transition,
        may=["guard", "action", "requirements"],
        keys={"source": "from", "event": "on", "target": "to"},
    )
    if place.file in entries.unreadable:
        return None
    needs = {"id": str, "title": str, "application": str, "initial": str, "states": dict}
    may = {"events": dict, "guards": dict, "actions": dict, "note": str}
    found = {name: entries.value(path, name, None) for name in (*needs, *may)}
    data = {name: value for name, value in found.items() if value is not None}
    if not entries.fits(data, place, needs, may):
        return None
    return schema.StateMachine(transitions=transitions, place=place, **data)


def _execution(path: Path, entries: Entries, declared: Declared) -> None:
    declared.ends = entries.value(path, "ends", [])
    may, keys = ["body", "idle", "intended"], {"intended": "priority"}
    declared.contexts = entries.named(
        path, "context", schema.ExecutionContext, "id", may=may, keys=keys
    )
    declared.pipes = entries.named(path, "pipe", PipeText, "object")
    for item, place in entries.tables(
        path, "shared", {"members": list, "protection": str, "why": str}
    ):
        for member in item["members"]:
            declared.protections[member] = Protection(item["protection"], item["why"], place)


def _trees(root: Path, path: Path, declared: Declared) -> None:
    file = str(path.relative_to(root))
    current = ""
    # the nodes above the present node: depth and list of children of each
    stack: list[tuple[int, list[TreeNode]]] = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        words = line.split("#")[0].rstrip()
        if not words:
            continue
        place = Place(file, number)
        if re.fullmatch(r"N?FR-\d+", words):
            current, stack = words, []
            if words in declared.trees:
                first = declared.trees[words][0]
                text = f"{first.file}:{first.line} already has a tree of {words}"
                declared.tree_errors.append((place, text, "remove one of the two trees"))
            declared.trees[current] = (place, None)
            continue
        match = re.fullmatch(r"((?:  )*)(post )?([\w:~]+)::(~?\w+)(?: ([?*]))?", words)
        if match is None or not current:
            text = "this line is neither the id of a requirement nor a method of a tree"
            fix = "write 'FR-n', or an indented 'Class::method'; only ? or * may follow it"
            declared.tree_errors.append((place, text, fix))
            continue
        depth = len(match[1]) // 2
        label = f"{match[3]}::{match[4]}"
        if depth > (stack[-1][0] + 1 if stack else 0):
            text, fix = (
                "is indented too far",
                "indent the method by two blanks more than its caller",
            )
            declared.tree_errors.append((place, f"{label} {text}", fix))
        while stack and stack[-1][0] >= depth:
            stack.pop()
        kind = "root" if not stack else "post" if match[2] else "call"
        children: list[TreeNode] = []
        node = TreeNode(
            *(label, match[3].split("::")[0], match[4], None, kind, place),
            often=match[5] or "",
            children=children,
        )
        if stack:
            stack[-1][1].append(node)
        elif declared.trees[current][1] is None:
            declared.trees[current] = (declared.trees[current][0], node)
        else:
            text = f"the tree of {current} has a second root"
            declared.tree_errors.append((place, text, "keep only one root in the tree"))
            continue
        stack.append((depth, children))
