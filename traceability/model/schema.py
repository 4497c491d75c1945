"""The model: everything that documents, checks, charts and exports are made from.

It is built once per run (``traceability.pipeline.build_model``) from Doxygen's XML, the syntax
tree, the declarations in ``design/``, test results, traces, coverage and sizes, and then only read.
Texts that come from annotations are small HTML fragments: paragraphs and ``<code>`` only, escaped.
A figure or result that this run did not produce is ``None``.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from traceability.model.build import Facts


@dataclass
class Place:
    """A line of a file; the path is relative to the root of the project."""

    file: str
    line: int
    end: int | None = None


@dataclass
class Param:
    name: str
    type: str
    text: str


@dataclass
class Call:
    """A call as written. ``targets`` are the methods it can reach: one when the call is direct."""

    target: str
    virtual: bool
    place: Place
    targets: list[str] = field(default_factory=list)


@dataclass
class Method:
    """A member function of a module. Its id is ``Class::name``; overloads share one id."""

    id: str
    module: str
    name: str
    signature: str
    access: str
    kind: str  # "pure", "virtual", "override", "plain", "static", "constructor"
    place: Place
    body: Place | None = None
    brief: str = ""
    details: str = ""
    params: list[Param] = field(default_factory=list)
    returns: str = ""
    pre: list[str] = field(default_factory=list)
    post: list[str] = field(default_factory=list)
    errors: str = ""
    interrupt: str = ""
    satisfies: list[str] = field(default_factory=list)
    documented: bool = False
    inherited_from: str | None = None  # method whose specification holds here
    overrides: str | None = None
    calls: list[Call] = field(default_factory=list)
    called_by: list[str] = field(default_factory=list)


@dataclass
class RoleBinding:
    application: str
    role: str
    module: str
    place: Place


@dataclass
class Module:
    """A design module, or a documented value type when ``datatype`` is true."""

    name: str
    qualified: str
    logic: str
    abstract: bool
    datatype: bool
    brief: str
    function: str
    secret: str
    place: Place
    header: str
    source: str | None
    bases: list[str] = field(default_factory=list)
    heirs: list[str] = field(default_factory=list)
    roles: list[RoleBinding] = field(default_factory=list)
    methods: list[Method] = field(default_factory=list)
    uses: list[str] = field(default_factory=list)  # modules named in its header or source
    used_by: list[str] = field(default_factory=list)
    requirements: list[str] = field(default_factory=list)
    tests: list[str] = field(
        default_factory=list
    )  # tests that executed it, or lie in its folder and carry its name
    lines_total: int | None = None
    lines_covered: int | None = None
    branches_total: int | None = None
    branches_covered: int | None = None
    line_hits: dict[str, dict[int, int]] = field(default_factory=dict)  # file -> line -> hits
    flash_bytes: int | None = None
    ram_bytes: int | None = None


@dataclass
class LogicModule:
    """A folder below ``src``. The name is as in the paper: ``OperationModes``."""

    id: str
    name: str
    parent: str | None
    brief: str
    function: str
    secret: str
    place: Place
    modules: list[str] = field(default_factory=list)
    children: list[str] = field(default_factory=list)


@dataclass
class Clause:
    """A structural clause of a pattern, and whether it holds in one application."""

    id: str
    says: str
    holds: bool
    places: list[Place] = field(default_factory=list)


@dataclass
class PatternApplication:
    id: str
    pattern: str
    title: str
    why: str
    changes: str
    module: str  # above which it is declared
    place: Place
    roles: list[RoleBinding] = field(default_factory=list)
    clauses: list[Clause] = field(default_factory=list)


@dataclass
class TreeNode:
    """A node of a requirement's tree; ``resolved`` is the method that has the body."""

    label: str
    module: str
    method: str
    resolved: str | None
    kind: str  # "root", "call", "post"
    place: Place
    reachable: bool | None = None
    executed: bool | None = None
    recordable: bool = True  # False when only the platform implements it, outside the trace
    trace_row: int | None = None  # row of the recorded trace that this node matches
    children: list[TreeNode] = field(default_factory=list)


@dataclass
class TraceRow:
    """One call of a recorded run: depth and method."""

    depth: int
    method: str
    module: str | None


@dataclass
class Test:
    """A test case. The result is "passed", "failed", "skipped" or None when it did not run."""

    id: str
    suite: str
    name: str
    brief: str
    place: Place
    verifies: list[str] = field(default_factory=list)
    result: str | None = None
    milliseconds: float | None = None
    stale: bool = False
    binding: str = "host"
    message: str = ""
    modules: list[str] = field(default_factory=list)


@dataclass
class Requirement:
    """``state``: "verified", "failed", "stale" or "unverified"."""

    id: str
    text: str
    section: str
    place: Place
    rationale: str = ""
    source: str = ""
    verification: str = ""
    priority: str = ""
    satisfied_by: list[str] = field(default_factory=list)
    verified_by: list[str] = field(default_factory=list)
    tree: TreeNode | None = None
    trace_test: str | None = None  # the test whose trace is shown beside the tree
    trace: list[TraceRow] = field(default_factory=list)
    trace_start: int = 0  # index of the first shown row in the whole recording
    state: str = "unverified"
    reasons: list[str] = field(default_factory=list)


@dataclass
class Transition:
    source: str
    event: str
    guard: str
    target: str
    action: str
    place: Place
    requirements: list[str] = field(default_factory=list)


@dataclass
class StateMachine:
    """``states`` maps a state's name to the module that realises it."""

    id: str
    title: str
    application: str
    initial: str
    states: dict[str, str]
    transitions: list[Transition]
    place: Place


@dataclass
class Use:
    """Actual use between logic modules: an include, or a call."""

    source: str
    target: str
    places: list[Place]


@dataclass
class AllowedUse:
    source: str
    target: str
    why: str
    place: Place


@dataclass
class ArchitectureElement:
    """An element of the Process Control architecture and the modules that refine it."""

    id: str
    kind: str
    name: str
    text: str
    modules: list[str]
    place: Place


@dataclass
class Finding:
    """What a check found. ``text`` says what is wrong, ``mend`` what would mend it."""

    place: Place
    check: str
    text: str
    mend: str


@dataclass
class Model:
    commit: str
    version: str
    sources_hash: str
    results_hash: str | None
    logic_modules: dict[str, LogicModule] = field(default_factory=dict)
    modules: dict[str, Module] = field(default_factory=dict)
    patterns: dict[str, PatternApplication] = field(default_factory=dict)
    requirements: dict[str, Requirement] = field(default_factory=dict)
    tests: dict[str, Test] = field(default_factory=dict)
    machines: dict[str, StateMachine] = field(default_factory=dict)
    uses: list[Use] = field(default_factory=list)
    allowed_uses: list[AllowedUse] = field(default_factory=list)
    architecture: list[ArchitectureElement] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    files: list[str] = field(default_factory=list)  # sources that get a source page
    facts: Facts | None = field(default=None, repr=False)  # for the checks; no document reads it

    @property
    def results_stale(self) -> bool:
        """Whether the test results are missing or older than the sources."""
        return self.results_hash != self.sources_hash
