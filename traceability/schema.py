"""The typed records of the model, which readers, checks, pages and exports share.

Texts are plain text with the light markup of the comments: `names`, lists, and an empty line
between paragraphs. A value or result that this run did not produce is ``None``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from traceability.sources import EXTENSIONS

# The targets of a test. They are this machine, and the virtual board that boots the image.
HOST = "host"
VIRTUAL_K64 = "virtual K64"
BINDINGS = (HOST, VIRTUAL_K64)


@dataclass(frozen=True)
class Place:
    """A line of a file. The path is relative to the root of the project."""

    file: str
    line: int
    end: int | None = None


@dataclass(frozen=True)
class Param:
    name: str
    type: str
    text: str


@dataclass(frozen=True)
class Call:
    """A call as it is written. ``targets`` are the methods that the call can reach. A direct call
    has one target."""

    target: str
    virtual: bool
    place: Place
    targets: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Constant:
    """A number of the code that is shown in texts."""

    number: int
    unit: str
    place: Place


@dataclass(frozen=True)
class PaperStatement:
    """A demand or claim of the paper about the software, with the answer of this project."""

    where: str  # id of a place of the paper
    says: str
    here: Sequence[str]
    deviation: str
    place: Place


@dataclass(frozen=True)
class Tuned:
    """Constants whose values fit only one value of another constant."""

    to: str
    why: str
    constants: Sequence[str]
    place: Place


@dataclass(frozen=True)
class Method:
    """A member function of a module. Its id is ``Class::name``. Overloads have the same id."""

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
    params: Sequence[Param] = field(default_factory=list)
    returns: str = ""
    pre: Sequence[str] = field(default_factory=list)
    post: Sequence[str] = field(default_factory=list)
    errors: str = ""
    interrupt: str = ""
    satisfies: Sequence[str] = field(default_factory=list)
    documented: bool = False
    inherited_from: str | None = (
        None  # overridden method whose specification also applies to this method
    )
    overrides: str | None = None
    calls: Sequence[Call] = field(default_factory=list)
    called_by: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Function:
    """A function of a composition. A composition is a folder that contains functions and no
    module."""

    id: str
    place: Place
    calls: Sequence[Call] = field(default_factory=list)


@dataclass(frozen=True)
class DataPart:
    """A member of a value type, or a value of an enumeration."""

    name: str
    type: str  # "" for a value of an enumeration
    text: str
    unit: str  # "" if it has no unit
    makers: Sequence[str]  # modules
    readers: Sequence[str]


@dataclass(frozen=True)
class MessageField:
    """A field of an order, a report or a welcome."""

    name: str
    text: str
    width: str = ""  # "u8" or "i16"; "" when no message has the field
    writers: Sequence[str] = field(default_factory=list)  # modules
    readers: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class RoleBinding:
    application: str
    role: str
    module: str
    place: Place


@dataclass(frozen=True)
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
    bases: Sequence[str] = field(default_factory=list)
    subclasses: Sequence[str] = field(default_factory=list)
    roles: Sequence[RoleBinding] = field(default_factory=list)
    methods: Sequence[Method] = field(default_factory=list)
    parts: Sequence[DataPart] = field(default_factory=list)  # parts of a value type
    uses: Sequence[str] = field(default_factory=list)  # modules named in its header or source
    used_by: Sequence[str] = field(default_factory=list)
    requirements: Sequence[str] = field(default_factory=list)
    # headers, constants and types that its secret hides
    hides: Sequence[str] = field(default_factory=list)
    registers: Sequence[str] = field(default_factory=list)  # blocks of registers that it owns
    # tests that executed the module, or tests of its folder that have its name
    tests: Sequence[str] = field(default_factory=list)
    lines_total: int | None = None
    lines_covered: int | None = None
    branches_total: int | None = None
    branches_covered: int | None = None
    line_hits: Mapping[str, dict[int, int]] = field(default_factory=dict)  # file -> line -> hits
    flash_bytes: int | None = None
    ram_bytes: int | None = None

    @property
    def extension(self) -> bool:
        """Returns whether the module belongs to an extension. The design does not count modules of
        extensions."""
        return is_extension(self.logic)


def is_extension(logic: str) -> bool:
    """Returns whether a logic module belongs to an extension."""
    return logic.split("/", maxsplit=1)[0] == EXTENSIONS


@dataclass(frozen=True)
class LogicModule:
    """A folder of the design. It has its name in the paper, for example ``OperationModes``."""

    id: str
    name: str
    parent: str | None
    brief: str
    function: str
    secret: str
    place: Place
    modules: Sequence[str] = field(default_factory=list)
    hides: Sequence[str] = field(default_factory=list)  # names that only its folder uses
    children: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Clause:
    """A structural clause of a pattern, and whether one application fulfils it."""

    id: str
    says: str
    holds: bool
    places: Sequence[Place] = field(default_factory=list)


@dataclass(frozen=True)
class PatternApplication:
    id: str
    pattern: str
    title: str
    why: str
    changes: str
    module: str  # module whose comment declares it
    place: Place
    roles: Sequence[RoleBinding] = field(default_factory=list)


@dataclass(frozen=True)
class PatternPrice:
    """The cost of an application: the cost of the virtual calls in the image."""

    instructions: float  # mean number in a cycle
    flash: int  # bytes of the tables of its modules and of the instructions of the calls
    virtual_calls: int  # number of places in the image


@dataclass(frozen=True)
class TreeNode:
    """A node of a requirement's tree. ``resolved`` is the method with the body."""

    label: str
    module: str
    method: str
    resolved: str | None
    kind: str  # "root", "call", "post"
    place: Place
    reachable: bool | None = None
    # target with a recorded test -> whether a test executed the node there
    executed: Mapping[str, bool] = field(default_factory=dict)
    # targets that implement the method without recording its call
    outside: Sequence[str] = field(default_factory=list)
    children: Sequence[TreeNode] = field(default_factory=list)
    # The code posts the method although the tree declares a call, or calls it although the tree
    # declares a post.
    otherwise: bool = False
    often: str = ""  # declared: "" once, "?" under a condition, "*" several times
    often_in_code: str | None = None
    too_early: str = (
        ""  # the previous node in the tree, if the code calls the previous node after this node
    )

    @property
    def ran(self) -> bool | None:
        """Returns whether the node was executed on any target. Returns ``None`` when no target was
        measured."""
        return any(self.executed.values()) if self.executed else None


@dataclass(frozen=True)
class TraceRow:
    """One call of a recorded run, with its depth and its method."""

    depth: int
    method: str
    module: str | None


@dataclass(frozen=True)
class TreeRun:
    """A recorded run of a test that contains a whole tree. The page shows the run next to the
    tree."""

    test: str
    rows: Sequence[TraceRow]
    start: int  # index of the first shown row in the whole recording
    # for each node of the tree, from the root: the row that matches it
    places: Sequence[int | None]
    folded: Sequence[FoldedCall] = field(default_factory=list)


@dataclass(frozen=True)
class FoldedCall:
    """Calls of a recorded run from one module into another. Equal calls are combined."""

    depth: int
    module: str
    methods: Sequence[str]  # methods that the module above called
    count: int
    declared_by: Sequence[str]  # requirements whose trees have a call between the two modules


@dataclass(frozen=True)
class MethodCoverage:
    """The part of a method that passing tests of a requirement executed on a target."""

    method: str
    place: Place
    lines: Mapping[int, bool]
    branches: Sequence[bool] | None  # None if branches are not recorded


@dataclass(frozen=True)
class LineGap:
    """Lines of a method that no test of its requirements executes, and their justification."""

    method: str
    place: Place
    lines: Sequence[int]
    requirements: Sequence[str]
    reason: str = ""


@dataclass(frozen=True)
class BindingResult:
    """The result of a test on one target: "passed", "failed", "skipped", or None when the test did
    not run."""

    result: str | None = None
    milliseconds: float | None = None
    message: str = ""
    stale: bool = False
    # files that may contain its recorded calls
    recordings: Sequence[str] = field(default_factory=list)
    measured: str = ""  # additional text that the test reports
    instances: Mapping[str, str] = field(
        default_factory=dict
    )  # instance of a parameterised test -> result
    images: Sequence[str] = field(default_factory=list)  # products whose images the test ran


@dataclass(frozen=True)
class Test:
    """A test case. It has a result for each target that it is built for."""

    id: str
    suite: str
    name: str
    brief: str
    place: Place
    verifies: Sequence[str] = field(default_factory=list)
    results: Mapping[str, BindingResult] = field(default_factory=dict)
    modules: Sequence[str] = field(default_factory=list)

    def gave(self, result: str | None) -> list[str]:
        """Returns the targets on which the test had this result."""
        return [binding for binding, outcome in self.results.items() if outcome.result == result]

    @property
    def passed(self) -> bool:
        return bool(self.results) and all(
            result.result == "passed" for result in self.results.values()
        )


@dataclass(frozen=True)
class Evidence:
    """A metric that a tool measures, with its bound. If the text could not be read, the relation is
    empty.
    """

    figure: str
    relation: str  # "at most", "at least", "exactly"
    bound: float
    unit: str
    place: Place

    @property
    def demand(self) -> str:
        return f"{self.relation} {self.bound:g} {self.unit}".strip()

    def holds(self, value: float | None) -> bool:
        """Returns whether a measured value is within the bound."""
        if value is None:
            return False
        if self.relation == "at most":
            return value <= self.bound
        if self.relation == "at least":
            return value >= self.bound
        return self.relation == "exactly" and value == self.bound


@dataclass(frozen=True)
class Baseline:
    """The hash of each text of each requirement. The key of a text is "kind name"."""

    links: Mapping[str, Sequence[str]]
    hashes: Mapping[str, str]


@dataclass(frozen=True)
class Review:
    """The review of one requirement by a person. ``state`` is the hash of all texts."""

    requirement: str
    reviewer: str
    email: str
    date: str
    commit: str
    state: str
    remark: str
    answers: Mapping[str, str]  # question -> "yes", "no", "not applicable"
    place: Place
    current: bool = False  # whether no text has changed since the review
    # Reasons why the record is not a valid review.
    objections: Sequence[str] = field(default_factory=list)

    @property
    def holds(self) -> bool:
        """Returns whether the review is about the present texts."""
        return self.current and not self.objections

    @property
    def open_points(self) -> list[str]:
        """Returns the questions that the reviewer answered with no."""
        return [question for question, answer in self.answers.items() if answer == "no"]


@dataclass(frozen=True)
class Suspicion:
    """A text that differs from the baseline, if a link depends on the text. For the kinds, see
    ``KINDS`` of reviews."""

    kind: str
    name: str
    place: Place
    text: str


@dataclass(frozen=True)
class SourceReference:
    """The source of a requirement: ``kind`` is one of ``SOURCE_KINDS``."""

    kind: str
    name: str


# The kinds of sources of a requirement.
SOURCE_KINDS = ("paper", "goal", "protocol", "data sheet", "decision")


@dataclass(frozen=True)
class Requirement:
    """A requirement. If no test shows a part of the requirement, ``partly`` describes this part."""

    id: str
    text: str
    section: str
    place: Place
    rationale: str = ""
    source: str = ""
    priority: str = ""
    level: str = ""  # "system", "software", "driver"
    products: Sequence[str] = field(default_factory=list)  # "all", or names of products
    method: str = ""  # method of verification: "test", "analysis", "measurement", "inspection"
    partly: str = ""
    goals: Sequence[str] = field(default_factory=list)  # safety goals that it serves
    sources: Sequence[SourceReference] = field(default_factory=list)
    satisfied_by: Sequence[str] = field(default_factory=list)
    verified_by: Sequence[str] = field(default_factory=list)
    tree: TreeNode | None = None
    # target -> run that contains the tree
    runs: Mapping[str, TreeRun] = field(default_factory=dict)
    # target -> executed parts of the methods
    coverage: Mapping[str, list[MethodCoverage]] = field(default_factory=dict)
    # fulfils the requirement instead of calls
    evidence: Sequence[Evidence] = field(default_factory=list)
    reviews: Sequence[Review] = field(default_factory=list)
    suspicions: Sequence[Suspicion] = field(default_factory=list)

    @property
    def reviewed(self) -> bool:
        """Returns whether a person reviewed the present texts of the requirement and found no open
        point."""
        return any(review.holds and not review.open_points for review in self.reviews)

    @property
    def by_calls(self) -> bool:
        """Returns whether calls fulfil the requirement. This is so if the requirement is functional
        or has a tree."""
        return self.id.startswith("FR-") or self.tree is not None


@dataclass(frozen=True)
class SafeState:
    """A state of the robot, with the situations in which this state is safe and is not safe."""

    id: str
    says: str
    safe: str
    not_safe: str
    place: Place


@dataclass(frozen=True)
class Assumption:
    """A demand on hardware or people, which safety needs and the firmware cannot fulfil."""

    id: str
    title: str
    text: str
    by: str
    confirm: str
    place: Place
    hazards: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Hazard:
    """A situation that can hurt somebody. ``level`` is its AgPLr. The level is empty when it cannot
    be computed."""

    id: str
    title: str
    situation: str
    harm: str
    severity: str
    exposure: str
    avoidance: str
    goals: Sequence[str]
    assumptions: Sequence[str]
    answer: str  # reaction of the firmware
    place: Place
    level: str = ""


@dataclass(frozen=True)
class SafetyGoal:
    """A goal that prevents hazards. Its times are in seconds."""

    id: str
    title: str
    text: str
    safe_states: Sequence[str]
    time: float  # time in which the firmware must prevent harm
    formula: str
    because: str
    reaction: float  # time that the firmware needs
    reacts: str
    requirements: Sequence[str]
    scenarios: Sequence[str]
    place: Place
    exceptions: Sequence[str] = field(default_factory=list)  # known exceptions to the goal
    computed: float | None = None  # result of the formula
    hazards: Sequence[str] = field(default_factory=list)
    level: str = ""  # the highest level of its hazards


@dataclass(frozen=True)
class FaultScenario:
    """A scenario in which something fails, its goals, and the tests that play it."""

    name: str
    title: str
    goals: Sequence[str]
    place: Place
    # line -> time in the expectation of this line [s]
    bounds: Mapping[int, float] = field(default_factory=dict)
    tests: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Correction:
    """Files whose edits correct defects. ``for_safety`` counts the lines of these edits that serve
    safety."""

    paths: Sequence[str]
    why: str
    place: Place
    for_safety: int = 0


@dataclass(frozen=True)
class TouchedFile:
    """The edited lines of a file of the robot, counted since the base of the safety case."""

    file: str
    added: int
    removed: int
    corrections: str = (
        ""  # reason why the edits are not for a safety function; empty for a safety function
    )

    @property
    def touched(self) -> int:
        return self.added + self.removed


@dataclass(frozen=True)
class SafetyCost:
    """The cost of the safety functions, which git counts. The model has ``None`` if git is
    missing."""

    base: str
    commit: str
    files_added: Sequence[str]
    lines_added: int  # number of lines added in these files
    touched: Sequence[TouchedFile]
    for_safety: int  # number of lines of the robot that were edited for safety functions


@dataclass(frozen=True)
class SafetyCase:
    """The hazards, the goals that prevent them, and the assumptions of the goals."""

    base: str = ""  # commit before the first safety function
    says: str = ""
    conditions: Sequence[str] = field(default_factory=list)
    limits: Sequence[str] = field(default_factory=list)
    risk_source: str = ""
    levels: Sequence[str] = field(default_factory=list)  # levels in ascending order
    graph: Mapping[str, list[str]] = field(default_factory=dict)  # severity -> rows of levels
    words: Mapping[str, str] = field(default_factory=dict)
    priorities: Mapping[str, str] = field(
        default_factory=dict
    )  # level -> priority of a requirement
    safe_states: Mapping[str, SafeState] = field(default_factory=dict)
    assumptions: Mapping[str, Assumption] = field(default_factory=dict)
    hazards: Mapping[str, Hazard] = field(default_factory=dict)
    goals: Mapping[str, SafetyGoal] = field(default_factory=dict)
    scenarios: Mapping[str, FaultScenario] = field(default_factory=dict)
    corrections: Sequence[Correction] = field(default_factory=list)
    data_sheets: Sequence[str] = field(default_factory=list)
    cost: SafetyCost | None = None


@dataclass(frozen=True)
class RequirementNumbers:
    """The constants with the numbers of a requirement: ``200 ms`` -> ``Class::name``."""

    requirement: str
    constants: Mapping[str, str]
    place: Place


@dataclass(frozen=True)
class NumbersWithout:
    """Numbers of requirements for which the code has no constant, for example ``FR-1 100 us``."""

    numbers: Sequence[str]
    why: str
    place: Place


@dataclass(frozen=True)
class Justified:
    """Methods, tests or lines of methods that serve no requirement, with the reason. There are two
    other kinds: methods that only tests call, and functions with a loop that does not count its
    iterations.
    """

    kind: str  # "method", "test", "line", "uncalled", "loop"
    names: Sequence[str]
    why: str
    place: Place
    covers: Sequence[str] = field(default_factory=list)  # ids that need the justification


@dataclass(frozen=True)
class Equivalent:
    """A source line, the changes to this line that no test can detect, and the reason."""

    file: str
    method: str
    line: str  # the text of the line
    changes: Sequence[str]
    why: str
    place: Place


@dataclass(frozen=True)
class Mutant:
    """A fault that the mutation test inserted in a method."""

    place: Place
    method: str
    kind: str
    change: str
    killed_by: Sequence[str]  # tests
    # requirement with the method in its tree -> whether one of its tests finds the fault
    own: Mapping[str, bool]
    why: str = ""  # reason why no test can find the fault; empty without a justification


@dataclass(frozen=True)
class Mutation:
    """The faults that were tried, and the number of all possible faults."""

    seed: int
    minutes: float
    total: int
    tried: Sequence[Mutant]

    @property
    def found(self) -> int:
        return sum(bool(mutant.killed_by) for mutant in self.tried)

    @property
    def justified(self) -> int:
        return sum(bool(mutant.why) for mutant in self.tried if not mutant.killed_by)


@dataclass(frozen=True)
class TestRun:
    """The time at which the tests ran on a target, and the seeds of the randomised tests."""

    date: str
    seeds: Sequence[str]


@dataclass(frozen=True)
class FileHash:
    """The SHA-256 of a file of a build. Kind: "image", "input" or "result"."""

    kind: str
    file: str
    sha256: str


@dataclass(frozen=True)
class BuildEvidence:
    """The sources, the tools and the machine of this build of the pages."""

    commit: str  # empty without git
    changed: Sequence[str]  # files that differ from the commit
    system: str
    processors: int
    tools: Mapping[str, str]  # program -> version
    runs: Mapping[str, TestRun]  # target -> run
    hashes: Sequence[FileHash]


@dataclass(frozen=True)
class LastRecord:
    """The last run of a test that takes too long to run in each build.

    Such a test tests the tests, tests the checks, or builds the release again and compares its
    files.
    """

    command: str
    commit: str  # empty without git
    found: int
    tried: int
    current: bool  # whether it ran with the present sources
    date: str  # YYYY-MM-DD
    justified: int = 0  # faults that no test found, because no test can find them


@dataclass(frozen=True)
class Transition:
    source: str
    event: str
    guard: str
    target: str
    action: str
    place: Place
    requirements: Sequence[str] = field(default_factory=list)
    # places in the code that make the transition; empty if the state does not change
    changes: Sequence[Place] = field(default_factory=list)
    tests: Sequence[str] = field(default_factory=list)  # passed tests that made the transition


@dataclass(frozen=True)
class StateMachine:
    """``states`` maps the name of a state to the module that implements the state.

    ``events`` maps an event to the operation of the state that the Context then calls. ``guards``
    maps a guard or an event to its condition in the code. ``actions`` maps an action to its calls.
    """

    id: str
    title: str
    application: str
    initial: str
    states: Mapping[str, str]
    transitions: Sequence[Transition]
    place: Place
    events: Mapping[str, str] = field(default_factory=dict)
    guards: Mapping[str, Sequence[str]] = field(default_factory=dict)
    actions: Mapping[str, Sequence[str]] = field(default_factory=dict)
    # change that is not declared, as "from operation to" -> the tests that made it
    undeclared: Mapping[str, list[str]] = field(default_factory=dict)


@dataclass(frozen=True)
class ProofProperty:
    """A property of the state machines and their composition, in linear temporal logic."""

    name: str
    requirement: str
    says: str
    formula: str
    place: Place


@dataclass(frozen=True)
class ProofResult:
    """The result of the proof of a property, and the size of the search."""

    verdict: str  # "proven", "false", "incomplete"
    states: int
    depth: int
    seconds: float
    events: Sequence[str] = field(default_factory=list)  # lines of the counterexample
    scenario: str = ""  # file that plays the counterexample, if its events can be played
    recorded: str = ""  # commit of the earlier run with the same model, if this commit is known
    recorded_on: str = ""  # date of this run, YYYY-MM-DD; empty if this build proved the property


@dataclass(frozen=True)
class Proofs:
    """The properties, the model in Promela, and the results if the present sources gave results."""

    properties: Mapping[str, ProofProperty] = field(default_factory=dict)
    results: Mapping[str, ProofResult] | None = None
    text: str = ""  # the machines and their composition in Promela
    # the cycles of each counterexample
    words: Mapping[str, Sequence[tuple[str, Sequence[str]]]] = field(default_factory=dict)

    def of(self, requirement: str) -> list[ProofProperty]:
        """Returns the properties that formalise a requirement."""
        return [item for item in self.properties.values() if item.requirement == requirement]

    @property
    def proven(self) -> int | None:
        """Returns the number of proven properties; None when nothing was proven with these
        sources.
        """
        results = self.results
        return None if results is None else sum(r.verdict == "proven" for r in results.values())

    @property
    def recorded(self) -> list[ProofResult]:
        """Returns the results of an earlier run with the same models. This build did not repeat the
        run.
        """
        return [result for result in (self.results or {}).values() if result.recorded_on]


@dataclass(frozen=True)
class ExecutionContext:
    """Code that the hardware starts: an interrupt, the thread of a control system, or the start."""

    id: str
    kind: str  # "interrupt", "thread", "start"
    name: str
    says: str
    handlers: Sequence[str]
    body: str  # the command that a thread executes
    place: Place
    lines: Sequence[int] = field(default_factory=list)  # lines of the interrupt controller
    priority: int | None = None
    # the first methods of modules that it executes
    first: Sequence[str] = field(default_factory=list)
    # all methods of modules that it may execute
    methods: Sequence[str] = field(default_factory=list)
    intended: int | None = None  # priority that the design states


@dataclass(frozen=True)
class StackCall:
    """A function of the deepest chain of calls, with its frame."""

    name: str
    bytes: int
    # The frame is computed from the instructions, because the compiler did not report it.
    measured: bool


@dataclass(frozen=True)
class StackContext:
    """The largest stack use of one context, and the chain of calls that causes it."""

    id: str
    name: str
    kind: str  # "start", "thread", "interrupt", "fault"
    priority: int | None
    bytes: int
    chain: Sequence[StackCall]


@dataclass(frozen=True)
class TimeBound:
    """The longest processor time of an interrupt, or of a thread with all its handlers."""

    context: str
    name: str
    cycles: int
    # An interrupt is entered at most this often in any window of `ticks` ms. None means once in a
    # control cycle.
    entries: int | None
    ticks: int
    noise: (
        int | None
    )  # entries in a tick of 1 ms with noise at all inputs, if noise causes more entries
    priority: int | None
    why: str
    response_ms: float | None = (
        None  # for an interrupt: the time from its request to the end of its handler
    )


@dataclass(frozen=True)
class PathBound:
    """The longest time from an input to its effect, which is the sum of its parts [ms]."""

    name: str
    title: str
    parts: Sequence[tuple[str, float]]
    seen_ms: float | None  # time of the path in its recording
    why: str

    @property
    def ms(self) -> float:
        return sum(part for _, part in self.parts)


@dataclass(frozen=True)
class TimeProof:
    """The time bounds of the image of the robot."""

    contexts: Sequence[TimeBound]
    cycle_ms: (
        float  # time from the clock pulse to the end of the main thread, including all interrupts
    )
    noise_ms: float  # the same time with noise at all inputs
    seen_ms: float | None  # longest time from the clock pulse to the report in a run of the bench
    paths: Sequence[PathBound]
    unbound: Sequence[tuple[str, Place]]  # loops and copies without a bound: function and place
    unresolved: Sequence[tuple[str, Place]]  # calls without a known target: function and place

    @property
    def proven(self) -> bool:
        return not (self.unbound or self.unresolved)


@dataclass(frozen=True)
class StackProof:
    """The largest stack use of the image of the robot, in bytes."""

    exception_frame: int  # bytes that the hardware stores at each entry
    limit: int = 0  # size of the stack in the linker script
    seen: int | None = None  # largest stack use of a run in closed loop
    contexts: Sequence[StackContext] = field(default_factory=list)
    # calls without a known target: function and place
    unresolved: Sequence[tuple[str, Place]] = field(default_factory=list)
    cycles: Sequence[list[str]] = field(default_factory=list)
    dynamic: Sequence[str] = field(default_factory=list)  # functions whose frame has no bound
    # functions of the project for which the compiler reported no frame
    untold: Sequence[str] = field(default_factory=list)

    @property
    def proven(self) -> bool:
        return not (self.unresolved or self.cycles or self.dynamic or self.untold)

    @property
    def levels(self) -> list[StackContext]:
        """Returns for each priority the context that needs the most stack. The start has the lowest
        level."""
        worst: dict[int | None, StackContext] = {}
        for context in self.contexts:
            worst_here = worst.get(context.priority)
            if worst_here is None or context.bytes > worst_here.bytes:
                worst[context.priority] = context
        return sorted(
            worst.values(),
            key=lambda context: -(1 << 10 if context.priority is None else context.priority),
        )

    @property
    def total(self) -> int:
        """Returns the sum of all levels. Each level except the lowest includes the frame that the
        hardware stores.
        """
        levels = self.levels
        return sum(level.bytes for level in levels) + self.exception_frame * (len(levels) - 1)


@dataclass(frozen=True)
class SharedPipe:
    """A pipe of the robot. ``writers`` and ``readers`` are methods with their contexts."""

    id: str
    name: str
    says: str
    type: str
    place: Place
    writers: Mapping[str, list[str]] = field(default_factory=dict)
    readers: Mapping[str, list[str]] = field(default_factory=dict)


@dataclass(frozen=True)
class SharedMember:
    """A member that one context changes and another context changes or reads."""

    id: str
    module: str
    type: str
    place: Place
    writers: Sequence[str]
    readers: Sequence[str]
    protection: str  # "" when the design states no protection
    why: str


@dataclass(frozen=True)
class Use:
    """An actual use between logic modules: an include, or a call."""

    source: str
    target: str
    places: Sequence[Place]


@dataclass(frozen=True)
class AllowedUse:
    source: str
    target: str
    why: str
    place: Place


@dataclass(frozen=True)
class Apart:
    """Two groups of modules that never name each other."""

    modules: Sequence[str]
    others: Sequence[str]
    why: str
    place: Place


@dataclass(frozen=True)
class Cycle:
    """Logic modules that may use each other in a cycle, and the pattern that causes the cycle."""

    within: str
    modules: Sequence[str]
    pattern: str
    place: Place


@dataclass(frozen=True)
class ArchitectureElement:
    """An element of the Process Control architecture and the modules that refine it."""

    id: str
    kind: str
    name: str
    text: str
    modules: Sequence[str]
    place: Place


@dataclass(frozen=True)
class PaperPlace:
    """A picture, a table, a section or a box of the paper."""

    id: str
    kind: str
    title: str
    place: Place


@dataclass(frozen=True)
class PaperElement:
    """A name of the paper and its counterpart here. ``here`` contains targets as "kind:name"."""

    kind: str
    name: str
    here: Sequence[str]
    alias: str = ""  # reason why the name here is different
    deviation: str = ""  # intended difference from the paper
    note: str = ""
    where: Sequence[str] = field(default_factory=list)  # places of the paper that contain the name
    place: Place = field(default_factory=lambda: Place("", 0))


@dataclass(frozen=True)
class KitTest:
    """A test of a likely change. It has a result if it ran in this build."""

    id: str
    target: str
    result: str | None
    place: Place


@dataclass(frozen=True)
class Port:
    """The firmware with another device or microcontroller."""

    title: str
    says: str
    program: str  # name of the test program
    image: str
    needs: str  # program that the tests need; "" if they need none
    files: Mapping[str, int]  # file -> number of lines that the port adds
    composition_lines: (
        int  # number of existing lines of the composition that are removed or changed
    )
    outside_lines: int  # number of changed lines of other files
    tests: Mapping[str, str] | None  # results of the tests, if the present sources gave results
    # flash and RAM of its image [bytes], if the image was built from the present sources
    size: Mapping[str, int]
    size_on_k64: Mapping[str, int]  # flash and RAM of this design on the K64

    @property
    def passed(self) -> bool:
        """Returns whether tests ran and all of them passed."""
        return bool(self.tests) and set((self.tests or {}).values()) == {"passed"}


@dataclass(frozen=True)
class MadeChange:
    """A likely change that a folder of changes/ or an extension makes."""

    application: str
    event: str
    hard: str  # name in the list of hard changes
    why: str  # reason why existing files change
    classes: Sequence[str]
    extension: str  # folder of the extension that makes it; "" for a folder of changes/
    files: Sequence[str]  # added
    patched: Sequence[str]  # existing files
    composition_lines: int  # number of existing lines that are removed or changed
    outside_lines: int  # number of changed lines outside the composition
    added_lines: int  # number of lines added to existing files
    flash: float | None  # additional bytes
    ram: float | None
    instructions: float | None  # additional instructions in a cycle, on average
    tests: Sequence[KitTest]
    place: Place

    @property
    def new_lines(self) -> int:
        """Returns the number of lines added to existing files, without the changed lines."""
        return self.added_lines - self.composition_lines - self.outside_lines


@dataclass(frozen=True)
class LikelyChange:
    """The effort of a change that an application of a pattern absorbs."""

    application: str
    pattern: str
    hidden_by: str  # module
    altered: Sequence[str]  # modules, each of which hides one variant
    role: str  # role of a new class; "" when the change adds no class
    derives: Sequence[str]  # base classes of a new class
    logic: str  # folder of the existing classes
    edits: Sequence[str]  # modules that register a new class
    untouched: Sequence[str]
    requirements: Sequence[str]  # requirements to review
    tests: Sequence[str]
    steps: Sequence[str]
    examples: Sequence[str]  # modules of extensions that make such a change
    made: MadeChange | None = None


@dataclass(frozen=True)
class ArchitectureGroup:
    """Modules that the high-level diagram draws in one box; ``module`` represents all of them."""

    name: str
    module: str
    modules: Sequence[str]
    place: Place


@dataclass(frozen=True)
class Connection:
    """A connection of the high-level diagram: "call", "interrupt", "command", "pipe" or
    "physical"."""

    kind: str
    source: str
    target: str
    connector: str
    place: Place
    # Methods on the path of the connection. A connection outside the code has none.
    way: Sequence[str] = field(default_factory=list)

    @property
    def arrow(self) -> str:
        """Returns the name under which the concordance lists the connection."""
        return f"{self.source} -> {self.target} ({self.kind})"


@dataclass(frozen=True)
class BoardFinding:
    """A kind of mistake that the virtual K64 detects, and the tests that cause this mistake."""

    id: str
    says: str
    place: Place
    tests: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class BeliefSource:
    """The source of a belief of the virtual board."""

    id: str
    says: str
    outside: bool  # Neither the driver nor the model was written from this source.
    place: Place


@dataclass(frozen=True)
class BoardBelief:
    """A value of a register on which the virtual board depends, and its meaning."""

    register: str  # block::NAME
    value: str
    says: str
    source: str  # id of a BeliefSource
    model: str  # file of the virtual board
    shared: bool  # Only the driver and the model state the belief.
    place: Place

    @property
    def name(self) -> str:
        """Returns the register without its block."""
        return self.register.rpartition("::")[2]


@dataclass(frozen=True)
class DriverFault:
    """A fault that a test inserted in a driver, and the findings of the virtual K64 in the image
    with this fault."""

    fault: str
    file: str
    finding: str
    caught: bool
    text: str


@dataclass(frozen=True)
class Finding:
    """A finding of a check. ``text`` describes the fault. If the finding has no ``fix``, it gets
    the fix of its check."""

    place: Place
    check: str
    text: str
    fix: str = ""


@dataclass(frozen=True)
class Curve:
    """A value over time. Its kind is "set_point", "measured" or "truth"."""

    kind: str
    binding: str
    points: Sequence[tuple[float, float]]  # seconds, value


@dataclass(frozen=True)
class LoopPlot:
    title: str
    unit: str
    curves: Sequence[Curve]


@dataclass(frozen=True)
class LoopFigure:
    """A metric of a run in closed loop, with its limit."""

    title: str
    limit: float
    unit: str
    requirement: str  # "" if no requirement states the limit
    values: Mapping[str, float | None]  # target that ran -> value; None if the run has no value

    def holds(self, binding: str) -> bool:
        value = self.values[binding]
        return value is not None and value <= self.limit


@dataclass(frozen=True)
class LoopRun:
    """Whether the run met all expectations of the scenario. If it did not, ``said`` is its
    output."""

    passed: bool
    said: str
    stack: int | None = None  # bytes of stack that the run used on the virtual K64


@dataclass(frozen=True)
class LoopScenario:
    name: str
    title: str
    says: str
    file: str
    place: Place
    plots: Sequence[LoopPlot]
    figures: Sequence[LoopFigure]
    runs: Mapping[str, LoopRun]  # target -> run with these sources


@dataclass(frozen=True)
class ProductImage:
    """The image of a product, with its bytes, its modules and its forbidden features."""

    flash: int
    ram: int
    stack: int
    forbidden: Sequence[str]
    modules: Sequence[str]


@dataclass(frozen=True)
class Spread:
    """The average, the least and the greatest value over the cycles of a run."""

    average: float
    minimum: float
    maximum: float


@dataclass(frozen=True)
class Latency:
    """The longest time from a request to its handler, and the source of the request."""

    us: float
    who: str


@dataclass(frozen=True)
class ExceptionCost:
    """The average cost of an interrupt or thread in a cycle."""

    who: str
    entries: float
    instructions: int
    us: float
    report_us: float


@dataclass(frozen=True)
class BenchRun:
    """One run of a scenario of the bench. A board measures neither instructions nor latencies."""

    report_ms: Spread  # time from the clock pulse to the report
    load: Spread  # [%] of the cycle
    start_us: Spread  # time from the clock pulse to the first instruction of the cycle
    jitter_us: float
    times_us: Sequence[int]  # for each cycle: time from the clock pulse to the report
    cycles: int
    instructions: Spread | None = None
    report_instructions: Spread | None = None  # instructions up to the report
    latency: Mapping[str, Latency] = field(default_factory=dict)  # priority -> the longest latency
    exceptions: Sequence[ExceptionCost] = field(default_factory=list)
    speed: float | None = None  # speed of the simulation, as a multiple of real time


@dataclass(frozen=True)
class Profile:
    """The average number of instructions of each name in a cycle. The first number is the total,
    and the second number counts up to the report."""

    modules: Sequence[tuple[str, float, float]]
    functions: Sequence[tuple[str, float, float]]


@dataclass(frozen=True)
class BenchScenario:
    """A scenario of the bench, with a run for each model of time and the instructions of each
    module."""

    runs: Mapping[str, BenchRun] = field(default_factory=dict)
    profile: Profile | None = None
