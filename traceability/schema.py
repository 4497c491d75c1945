"""The data classes of the model. The readers fill them, and the checks, pages and exports use them.

A text is plain text. It may contain `names` in backticks, lists, and empty lines between
paragraphs. A value or result is ``None`` if this run did not produce it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from traceability.sources import EXTENSIONS

# The targets on which a test can run: this computer, and the virtual board, which executes the
# firmware image.
HOST = "host"
VIRTUAL_K64 = "virtual K64"
BINDINGS = (HOST, VIRTUAL_K64)


@dataclass(frozen=True)
class Place:
    """A source line of a file, or the source lines from ``line`` to ``end``. ``file`` is the path
    relative to the root of the project. ``end`` is None for a single source line, or if the last
    source line is unknown."""

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
    """A call in the source text. The products pass objects to the caller. ``targets`` are the
    called method, and the methods that override it in the classes of these objects. If no such
    object is known, ``wired`` is false, and ``targets`` contains all overriding methods."""

    target: str
    virtual: bool
    place: Place
    targets: Sequence[str] = field(default_factory=list)
    wired: bool = True


@dataclass(frozen=True)
class Constant:
    """The value of a constant in the code. Texts of the pages show this value. The number is an int
    if the type of the constant is an integer type."""

    number: float
    unit: str
    place: Place


@dataclass(frozen=True)
class PaperStatement:
    """A demand or claim of the paper about the software, and its counterparts in this project."""

    where: str  # id of the place in the paper that contains the statement
    says: str
    here: Sequence[str]
    deviation: str
    place: Place


@dataclass(frozen=True)
class Tuned:
    """Constants and source lines that depend on the constant ``to``. If the value of ``to`` is
    changed, they need new values too. Each element of ``lines`` is a file and a text of the source
    line, such as ``sim/plant/DriveTrain.hpp: kRadius``."""

    to: str
    why: str
    constants: Sequence[str]
    place: Place
    lines: Sequence[str] = ()


@dataclass(frozen=True)
class Method:
    """A member function of a module. The id is ``Class::name``. Overloads of a method have the same
    id."""

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
    # The overridden method from which this method takes its specification. None if the method has
    # its own specification.
    inherited_from: str | None = None
    overrides: str | None = None
    calls: Sequence[Call] = field(default_factory=list)
    # caller -> the abstract method that it calls, if the object of this call is not known
    called_by: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Function:
    """A function outside classes. Its file does not have the name of a class. Such functions create
    and connect the objects of a product, handle an interrupt, or compute a value."""

    id: str
    place: Place
    calls: Sequence[Call] = field(default_factory=list)


@dataclass(frozen=True)
class DataPart:
    """A data member of a value type, or an enumerator of an enumeration."""

    name: str
    type: str  # "" for an enumerator
    text: str
    unit: str  # "" without a unit
    makers: Sequence[str]  # other modules that write the part
    readers: Sequence[str]  # other modules that read the part and do not write it


@dataclass(frozen=True)
class MessageField:
    """A field of the messages between the PC and the robot. Orders, reports and welcomes are such
    messages."""

    name: str
    text: str
    width: str = ""  # "u8" or "i16"; "" when no message has the field
    writers: Sequence[str] = field(default_factory=list)  # modules that write the field
    readers: Sequence[str] = field(default_factory=list)  # modules that read the field


@dataclass(frozen=True)
class RoleBinding:
    application: str
    role: str
    module: str
    place: Place


@dataclass(frozen=True)
class Module:
    """A design module, or a documented value type if ``datatype`` is true."""

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
    # members of a value type; empty for a module
    parts: Sequence[DataPart] = field(default_factory=list)
    # modules whose names are in the header or the source file of this module
    uses: Sequence[str] = field(default_factory=list)
    used_by: Sequence[str] = field(default_factory=list)
    # modules and value types whose header or source file contains the name of this module or type
    named_by: Sequence[str] = field(default_factory=list)
    requirements: Sequence[str] = field(default_factory=list)
    # headers, constants, functions and types that only this module may use (its secret)
    hides: Sequence[str] = field(default_factory=list)
    # blocks of registers that only this module and the other owners of the block may access
    registers: Sequence[str] = field(default_factory=list)
    # tests that executed a method of the module, and the tests in the test file that is named after
    # the module
    tests: Sequence[str] = field(default_factory=list)
    flash_bytes: int | None = None
    ram_bytes: int | None = None

    @property
    def extension(self) -> bool:
        """Returns whether the module belongs to an extension. Some checks compare the number of
        modules with the paper. These checks ignore the modules of extensions."""
        return is_extension(self.logic)


def is_extension(logic: str) -> bool:
    """Returns whether a logic module belongs to an extension."""
    return logic.split("/", maxsplit=1)[0] == EXTENSIONS


@dataclass(frozen=True)
class LogicModule:
    """A folder with design modules, or a folder that contains such folders. ``name`` is the name of
    the folder in the form that the paper uses, for example ``OperationModes``."""

    id: str
    name: str
    parent: str | None
    brief: str
    function: str
    secret: str
    place: Place
    modules: Sequence[str] = field(default_factory=list)
    # names that only the files of this folder may use
    hides: Sequence[str] = field(default_factory=list)
    children: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Clause:
    """A rule about the structure of a pattern, with the result of its check. ``holds`` is true if
    the code of one pattern application fulfils the rule."""

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
    module: str  # the module whose comment contains the @patternapp
    place: Place
    roles: Sequence[RoleBinding] = field(default_factory=list)


@dataclass(frozen=True)
class PatternPrice:
    """The cost of one pattern application in the firmware image: the cost of the virtual calls."""

    # mean number of instructions that the virtual calls cost in a control cycle
    instructions: float
    flash: int  # bytes of the virtual method tables and of the call instructions
    virtual_calls: int  # number of virtual calls in the firmware image
    choices: int  # number of these calls that can execute the methods of several classes


@dataclass(frozen=True)
class TreeNode:
    """A node in the invocation tree of a requirement. ``label`` is the method as the tree names it.
    ``resolved`` is the method that contains the executed code."""

    label: str
    module: str
    method: str
    resolved: str | None
    kind: str  # "root", "call", "post"
    place: Place
    reachable: bool | None = None
    # Target -> true if a test executed the node on this target. Only targets with recordings are
    # listed.
    executed: Mapping[str, bool] = field(default_factory=dict)
    # targets on which the method does not exist; for example the host for a method of a K64 driver
    outside: Sequence[str] = field(default_factory=list)
    children: Sequence[TreeNode] = field(default_factory=list)
    # True if the code and the tree differ in the kind of the call: a direct call in one of them,
    # and a post in the other.
    otherwise: bool = False
    # number of calls that the tree declares: "" one call, "?" one call under a condition, "*"
    # several calls
    often: str = ""
    often_in_code: str | None = None
    # The label of the previous node, if the code makes this call before the call of the previous
    # node. Otherwise "".
    too_early: str = ""

    @property
    def ran(self) -> bool | None:
        """Returns whether a test executed the node on at least one target. Returns ``None`` if no
        target has recordings."""
        return any(self.executed.values()) if self.executed else None


@dataclass(frozen=True)
class TraceRow:
    """One call in the recording of a test. ``depth`` is the number of calls that enclose this
    call."""

    depth: int
    method: str
    module: str | None


@dataclass(frozen=True)
class TreeRun:
    """The recording of a test that made all calls of an invocation tree. The page of the
    requirement shows the recording next to the tree."""

    test: str
    rows: Sequence[TraceRow]
    start: int  # index of the first shown row in the whole recording
    # for each node of the tree, beginning at the root: the number of the row that matches the node
    places: Sequence[int | None]
    folded: Sequence[FoldedCall] = field(default_factory=list)


@dataclass(frozen=True)
class FoldedCall:
    """A call from one module to another module in a recording. Calls with the same chain of calling
    modules are combined, and ``count`` is their number."""

    depth: int
    module: str
    methods: Sequence[str]  # methods that the calling module called
    count: int
    # requirements whose invocation trees contain a call between the two modules
    declared_by: Sequence[str]


@dataclass(frozen=True)
class MethodCoverage:
    """The source lines and branches of a method that the passed tests of one requirement executed
    on one target."""

    method: str
    place: Place
    lines: Mapping[int, bool]
    branches: Sequence[bool] | None  # None if the target does not record branches


@dataclass(frozen=True)
class FileCoverage:
    """The source lines and branches of a file that the tests on the host executed. gcovr counts the
    branches: it counts a branch once for each compiled copy of its source line."""

    lines: Mapping[int, bool]  # source line -> true if a test executed the line
    missed: Sequence[int]  # source lines with a branch that no test executed
    # number of executed branches, and number of all branches; None if gcovr did not count them
    branches: tuple[int, int] | None


@dataclass(frozen=True)
class LineGap:
    """Source lines of a method. No test of the method's requirements executes these lines.
    ``reason`` is the justification, if design/justified.toml contains one."""

    method: str
    place: Place
    lines: Sequence[int]
    requirements: Sequence[str]
    reason: str = ""


@dataclass(frozen=True)
class BindingResult:
    """The result of a test on one target: "passed", "failed", "skipped", or None if the test did
    not run."""

    result: str | None = None
    milliseconds: float | None = None
    message: str = ""
    stale: bool = False
    # files that may contain the recorded calls of this test
    recordings: Sequence[str] = field(default_factory=list)
    measured: str = ""  # text of the property "measured" that the test reports
    # for a parameterised or typed test: name of the instance, as in Prefix_Suite.Test_instance ->
    # result of the instance
    instances: Mapping[str, str] = field(default_factory=dict)
    # products whose firmware images the test executed
    images: Sequence[str] = field(default_factory=list)

    @property
    def words(self) -> str | None:
        """Returns the result, and states whether it belongs to older sources."""
        return f"{self.result}, stale" if self.result and self.stale else self.result


@dataclass(frozen=True)
class Test:
    """A test case. ``results`` has an entry for each target for which the test is built."""

    id: str
    suite: str
    name: str
    brief: str
    place: Place
    verifies: Sequence[str] = field(default_factory=list)
    results: Mapping[str, BindingResult] = field(default_factory=dict)
    modules: Sequence[str] = field(default_factory=list)

    def gave(self, result: str | None) -> list[str]:
        """Returns the targets on which the test had the given result."""
        return [binding for binding, outcome in self.results.items() if outcome.result == result]

    @property
    def passed(self) -> bool:
        return bool(self.results) and all(
            result.result == "passed" for result in self.results.values()
        )


@dataclass(frozen=True)
class Evidence:
    """The @evidence of a requirement: a measured metric must meet a bound. The relation is empty if
    the text of the tag could not be read."""

    figure: str
    relation: str  # "at most", "at least", "exactly"
    bound: float
    unit: str
    place: Place

    @property
    def demand(self) -> str:
        return f"{self.relation} {self.bound:g} {self.unit}".strip()

    def holds(self, value: float | None) -> bool:
        """Returns whether a measured value meets the bound."""
        if value is None:
            return False
        if self.relation == "at most":
            return value <= self.bound
        if self.relation == "at least":
            return value >= self.bound
        return self.relation == "exactly" and value == self.bound


@dataclass(frozen=True)
class Baseline:
    """The hashes of the texts on which each requirement depends. The key of a text is its kind and
    its name, separated by a blank."""

    links: Mapping[str, Sequence[str]]
    hashes: Mapping[str, str]


@dataclass(frozen=True)
class Review:
    """The review of one requirement by a person. ``state`` is the hash of all reviewed texts."""

    requirement: str
    reviewer: str
    email: str
    date: str
    commit: str
    state: str
    remark: str
    answers: Mapping[str, str]  # question -> "yes", "no", "not applicable"
    place: Place
    current: bool = False  # true if no reviewed text has changed since the review
    # Reasons why the record is not a valid review; empty for a valid review.
    objections: Sequence[str] = field(default_factory=list)

    @property
    def holds(self) -> bool:
        """Returns whether the review is valid and the reviewed texts have not changed since."""
        return self.current and not self.objections

    @property
    def open_points(self) -> list[str]:
        """Returns the questions to which the reviewer answered "no"."""
        return [question for question, answer in self.answers.items() if answer == "no"]


@dataclass(frozen=True)
class Suspicion:
    """A text that was changed, added or removed since the baseline. A person must review this
    change. ``KINDS`` in model/reviews.py lists the kinds of texts."""

    kind: str
    name: str
    place: Place
    text: str


@dataclass(frozen=True)
class SourceReference:
    """The origin of a requirement, for example a section of the paper. ``kind`` is one of
    ``SOURCE_KINDS``."""

    kind: str
    name: str


# The kinds of origins of a requirement.
SOURCE_KINDS = ("paper", "goal", "protocol", "data sheet", "decision")


@dataclass(frozen=True)
class Requirement:
    """A requirement. ``partly`` describes the part of the requirement that no test verifies. If
    there is no such part, ``partly`` is empty."""

    id: str
    text: str
    section: str
    place: Place
    rationale: str = ""
    source: str = ""
    priority: str = ""
    level: str = ""  # "system", "software", "driver"
    # "all", or the names of the products for which the requirement is valid
    products: Sequence[str] = field(default_factory=list)
    # method of verification; values: "test", "analysis", "measurement", "inspection"
    method: str = ""
    partly: str = ""
    # the safety goals to which the requirement contributes
    goals: Sequence[str] = field(default_factory=list)
    sources: Sequence[SourceReference] = field(default_factory=list)
    satisfied_by: Sequence[str] = field(default_factory=list)
    verified_by: Sequence[str] = field(default_factory=list)
    tree: TreeNode | None = None
    # target -> recording of a test that contains all calls of the tree
    runs: Mapping[str, TreeRun] = field(default_factory=dict)
    # target -> executed lines and branches of the methods
    coverage: Mapping[str, list[MethodCoverage]] = field(default_factory=dict)
    # metrics with bounds; if the metrics meet their bounds, the requirement is fulfilled
    evidence: Sequence[Evidence] = field(default_factory=list)
    reviews: Sequence[Review] = field(default_factory=list)
    suspicions: Sequence[Suspicion] = field(default_factory=list)

    @property
    def reviewed(self) -> bool:
        """Returns whether a person reviewed the present texts of the requirement, and did not give
        the answer "no" to any question."""
        return any(review.holds and not review.open_points for review in self.reviews)

    @property
    def by_calls(self) -> bool:
        """Returns whether the requirement is fulfilled by calls of methods. Returns true for a
        functional requirement (FR-n), and for a requirement with an invocation tree."""
        return self.id.startswith("FR-") or self.tree is not None


@dataclass(frozen=True)
class SafeState:
    """A safe state of the robot. ``safe`` describes the situations in which this state harms
    nobody. ``not_safe`` describes the situations in which it can harm somebody."""

    id: str
    says: str
    safe: str
    not_safe: str
    place: Place


@dataclass(frozen=True)
class Assumption:
    """An assumption of use: a demand on the hardware or on people. It is necessary for safety, but
    the firmware cannot ensure it."""

    id: str
    title: str
    text: str
    by: str
    confirm: str
    place: Place
    hazards: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Hazard:
    """A situation that can hurt somebody. ``level`` is the required performance level (AgPLr). If
    this level cannot be computed, ``level`` is empty."""

    id: str
    title: str
    situation: str
    harm: str
    severity: str
    exposure: str
    avoidance: str
    goals: Sequence[str]
    assumptions: Sequence[str]
    answer: str  # the reaction of the firmware to the situation
    place: Place
    # the fault scenarios in which the hazard occurs
    scenarios: Sequence[str] = field(default_factory=list)
    level: str = ""


@dataclass(frozen=True)
class SafetyGoal:
    """A safety goal. If the robot meets the goal, the hazards of this goal cause no harm. All times
    are in seconds."""

    id: str
    title: str
    text: str
    safe_states: Sequence[str]
    # the longest time that the firmware may need until the safe state, or until the halt to this
    # state begins
    time: float
    formula: str
    because: str
    reaction: float  # the time that the firmware needs until the same event
    reacts: str
    place: Place
    # known situations in which the robot does not meet the goal
    exceptions: Sequence[str] = field(default_factory=list)
    # conditions in which nothing limits the motion that the goal must limit
    open_points: Sequence[str] = field(default_factory=list)
    # greatest ordered velocity [m/s] in the formula; 0 if the formula does not contain it
    velocity: float = 0.0
    parts: str = ""  # formula of constants for the reaction time [ms]; "" if there is none
    computed: float | None = None  # value of the formula; None if the formula is invalid
    hazards: Sequence[str] = field(default_factory=list)
    level: str = ""  # the highest level among the hazards of the goal
    requirements: Sequence[str] = field(default_factory=list)  # requirements that name the goal
    scenarios: Sequence[str] = field(default_factory=list)  # fault scenarios that name the goal


@dataclass(frozen=True)
class FaultScenario:
    """A scenario with a hazardous situation: for example, a part of the robot fails. ``goals`` are
    the safety goals that must prevent harm. ``tests`` are the tests that execute the scenario."""

    name: str
    title: str
    goals: Sequence[str]
    place: Place
    # number of a line in the scenario file -> the expectation in this line
    expects: Mapping[int, str] = field(default_factory=dict)
    tests: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Correction:
    """Files that were edited to correct defects, and not to add a safety function. Nevertheless,
    some edited source lines in these files can belong to a safety function. ``for_safety`` is their
    number."""

    paths: Sequence[str]
    why: str
    place: Place
    for_safety: int = 0


@dataclass(frozen=True)
class TouchedFile:
    """The numbers of lines that were added and removed in a file of the robot since the base commit
    of the safety case."""

    file: str
    added: int
    removed: int
    # The reason why the edits do not belong to a safety function. The text is empty if they belong
    # to a safety function.
    corrections: str = ""

    @property
    def touched(self) -> int:
        return self.added + self.removed


@dataclass(frozen=True)
class SafetyCost:
    """The cost of the safety functions: the files and lines that were added or edited for them
    since the base commit. If git does not contain the base commit, the model has ``None`` instead
    of this object."""

    base: str
    commit: str
    files_added: Sequence[str]
    lines_added: int  # number of lines in the added files
    touched: Sequence[TouchedFile]
    # number of lines in existing files of the robot that were edited for safety functions
    for_safety: int


@dataclass(frozen=True)
class SafetyCase:
    """The safety case: the hazards, the goals that prevent harm, and the assumptions of use."""

    base: str = ""  # commit before the first safety function
    says: str = ""
    conditions: Sequence[str] = field(default_factory=list)
    limits: Sequence[str] = field(default_factory=list)
    risk_source: str = ""
    # the performance levels; the lowest level is the first
    levels: Sequence[str] = field(default_factory=list)
    # severity -> the rows of levels in the risk graph
    graph: Mapping[str, list[str]] = field(default_factory=dict)
    words: Mapping[str, str] = field(default_factory=dict)
    # level -> priority of a requirement
    priorities: Mapping[str, str] = field(default_factory=dict)
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
    """The links from the numbers in a requirement to constants in the code, for example ``200 ms``
    -> ``Class::name``."""

    requirement: str
    constants: Mapping[str, str]
    place: Place


@dataclass(frozen=True)
class NumbersWithout:
    """Numbers in requirements for which the code has no constant, for example ``FR-1 100 us``.
    ``why`` states why there is no constant."""

    numbers: Sequence[str]
    why: str
    place: Place


@dataclass(frozen=True)
class Justified:
    """The reason why code is permitted to break a rule. There are three rules. Each method, test
    and source line serves a requirement ("method", "test", "line"). The firmware itself calls each
    public method ("uncalled"). Each loop is a ``for`` with a condition ("loop")."""

    kind: str  # "method", "test", "line", "uncalled", "loop"
    names: Sequence[str]
    why: str
    place: Place
    # those names for which the justification is still necessary
    covers: Sequence[str] = field(default_factory=list)


@dataclass(frozen=True)
class Equivalent:
    """A source line, the changes of this line that no test can detect, and the reason."""

    file: str
    method: str
    line: str  # the text of the source line
    changes: Sequence[str]
    why: str
    place: Place


@dataclass(frozen=True)
class Mutant:
    """A fault that the mutation test inserted in a method, and the tests that found it."""

    place: Place
    method: str
    kind: str
    change: str
    killed_by: Sequence[str]  # tests that found the fault
    # requirement whose invocation tree contains the method -> true if a test of this requirement
    # finds the fault
    own: Mapping[str, bool]
    why: str = ""  # reason why no test can find the fault; empty without a justification


@dataclass(frozen=True)
class Mutation:
    """The result of a mutation test: the faults that were tried, and the total number of possible
    faults."""

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
    """The run of the tests on one target: the date of the run, and the seeds of the tests that use
    random numbers."""

    date: str
    seeds: Sequence[str]


@dataclass(frozen=True)
class FileHash:
    """The SHA-256 hash of a file that a build used or wrote. ``kind`` is "image", "input" or
    "result"."""

    kind: str
    file: str
    sha256: str


@dataclass(frozen=True)
class LintRun:
    """The results of ./wr lint for the present files."""

    commit: str  # commit at which ./wr lint ran; empty if git is not available
    steps: Mapping[str, str]  # step -> "passed", "failed" or "not run"


@dataclass(frozen=True)
class Counts:
    """The numbers of passed, failed and skipped tests of a run."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Counts) -> Counts:
        return Counts(
            self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped
        )

    def __str__(self) -> str:
        text = f"{self.passed} passed, {self.failed} failed"
        return f"{text}, {self.skipped} skipped" if self.skipped else text


@dataclass(frozen=True)
class Exemption:
    """A comment that exempts a source line from rules of clang-tidy."""

    place: Place
    rules: str
    why: str


@dataclass(frozen=True)
class BuildEvidence:
    """The commit, the tools and the computer with which the pages were built."""

    commit: str  # empty if git is not available
    changed: Sequence[str]  # files that differ from the commit
    system: str
    processors: int
    tools: Mapping[str, str]  # program -> version
    runs: Mapping[str, TestRun]  # target -> run
    hashes: Sequence[FileHash]
    lint: LintRun | None = None  # None if ./wr lint did not run on the present files
    # folder of Python tests -> counts; None if these tests did not run on the present files
    tool_tests: Mapping[str, Counts | None] = field(default_factory=dict)
    failed: Sequence[str] = ()  # Python tests whose last run failed
    repeated: Sequence[str] = ()  # Python tests that failed at first, and then ran once more
    # file of Python tests -> number of its functions with long tests (see ./wr test --long)
    long_tests: Mapping[str, int] = field(default_factory=dict)
    exemptions: Sequence[Exemption] = ()


@dataclass(frozen=True)
class LastRecord:
    """The recorded result of a test that does not run in each build, because it takes too long.

    There are three such tests: the mutation test of the tests, the test of the checks with seeded
    faults, and a second build of the release, which must produce the same files.
    """

    command: str
    commit: str  # empty if git is not available
    found: int
    tried: int
    current: bool  # true if the test ran with the present sources
    date: str  # YYYY-MM-DD
    # number of faults for which a justification states that no test can find them
    justified: int = 0
    total: int | None = None  # number of possible faults; None if the record does not state it

    @property
    def extent(self) -> str:
        """Returns a sentence that states whether the run tried all possible faults."""
        if self.total is None:
            return "The record does not state whether the run tried all possible faults."
        if self.tried == self.total:
            return "The run tried all possible faults."
        return f"The run tried {self.tried:,} of {self.total:,} possible faults."


@dataclass(frozen=True)
class Transition:
    source: str
    event: str
    guard: str
    target: str
    action: str
    place: Place
    requirements: Sequence[str] = field(default_factory=list)
    # the places in the code that change the state; empty if the transition stays in its state
    changes: Sequence[Place] = field(default_factory=list)
    tests: Sequence[str] = field(default_factory=list)  # passed tests that made the transition


@dataclass(frozen=True)
class StateMachine:
    """A declared state machine. ``states`` maps the name of a state to the module that implements
    the state.

    ``events`` maps an event to the operation of the State that the Context calls at this event.
    ``guards`` maps a guard or an event to the conditions that the code checks. ``actions`` maps an
    action to the methods that the code calls. ``note`` explains the events and the guards.
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
    note: str = ""
    # state change that the machine does not declare, as "from operation to" -> the tests that made
    # this change
    undeclared: Mapping[str, list[str]] = field(default_factory=dict)


@dataclass(frozen=True)
class ProofProperty:
    """A property that all runs of the composed state machines must have. ``formula`` states the
    property in linear temporal logic."""

    name: str
    requirement: str
    says: str
    formula: str
    place: Place


@dataclass(frozen=True)
class ProofResult:
    """The result of the proof of a property, and the size of the search for a counterexample."""

    verdict: str  # "proven", "false", "incomplete"
    states: int
    depth: int
    seconds: float
    # the events of the counterexample; empty for a proven property
    events: Sequence[str] = field(default_factory=list)
    # the scenario file that plays the counterexample; empty if the simulator cannot cause its
    # events
    scenario: str = ""
    # commit of the earlier run with the same model; empty if the commit is unknown
    recorded: str = ""
    # date of the earlier run, YYYY-MM-DD; empty if this build proved the property
    recorded_on: str = ""


@dataclass(frozen=True)
class Proofs:
    """The properties, the model in Promela, and the results. ``results`` is None if the present
    sources have no results."""

    properties: Mapping[str, ProofProperty] = field(default_factory=dict)
    results: Mapping[str, ProofResult] | None = None
    text: str = ""  # the machines and their composition in Promela
    # property -> the cycles of its counterexample
    words: Mapping[str, Sequence[tuple[str, Sequence[str]]]] = field(default_factory=dict)

    def of(self, requirement: str) -> list[ProofProperty]:
        """Returns the properties that state a requirement as a formula."""
        return [item for item in self.properties.values() if item.requirement == requirement]

    @property
    def proven(self) -> int | None:
        """Returns the number of proven properties. Returns None if there are no results for the
        present sources."""
        results = self.results
        return None if results is None else sum(r.verdict == "proven" for r in results.values())

    @property
    def recorded(self) -> list[ProofResult]:
        """Returns the results that this build did not compute. An earlier run with the same models
        recorded them."""
        return [result for result in (self.results or {}).values() if result.recorded_on]


@dataclass(frozen=True)
class ExecutionContext:
    """An execution context: code that the hardware starts. There are three kinds: an interrupt
    handler, the thread of a control system, and the program after a reset ("start")."""

    id: str
    kind: str  # "interrupt", "thread", "start"
    name: str
    says: str
    handlers: Sequence[str]
    body: str  # the method that a thread executes; "" for other kinds
    place: Place
    lines: Sequence[int] = field(default_factory=list)  # numbers of its interrupt lines
    priority: int | None = None
    # the methods at which the context enters the modules
    first: Sequence[str] = field(default_factory=list)
    # all methods of modules that the context may execute
    methods: Sequence[str] = field(default_factory=list)
    intended: int | None = None  # priority that the design states
    # the function that the program calls after a reset, when it has enabled the interrupts
    idle: str = ""


@dataclass(frozen=True)
class StackCall:
    """A function in the deepest chain of calls, with the bytes of its stack frame."""

    name: str
    bytes: int
    # True if the frame is computed from the instructions, because the compiler did not report it.
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
    """The longest processor time that a context can need. For an interrupt, it is the time of one
    execution. For a thread, it is the time of all its handlers in a control cycle."""

    context: str
    name: str
    cycles: int
    # Greatest number of starts of the context in each interval of `ticks` ms. None if the context
    # starts once in a control cycle.
    entries: int | None
    ticks: int
    # The number of starts in 1 ms if there is noise at all inputs. None if noise causes no
    # additional starts.
    noise: int | None
    priority: int | None
    why: str
    # For an interrupt: the longest time from the request to the end of the handler. None for a
    # thread.
    response_ms: float | None = None


@dataclass(frozen=True)
class PathBound:
    """The longest time from an input to its effect [ms]. It is the sum of the times in
    ``parts``."""

    name: str
    title: str
    parts: Sequence[tuple[str, float]]
    seen_ms: float | None  # measured time of the path in a recording; None without a recording
    why: str

    @property
    def ms(self) -> float:
        return sum(part for _, part in self.parts)


@dataclass(frozen=True)
class TimeProof:
    """The longest execution times of the robot's firmware image, computed from its instructions."""

    contexts: Sequence[TimeBound]
    # The longest time from the clock pulse to the end of the main thread, including all interrupts.
    cycle_ms: float
    noise_ms: float  # the same time as ``cycle_ms``, but with noise at all inputs
    # the longest measured time from the clock pulse to the report, in the runs of the bench and in
    # the tests of the firmware image
    seen_ms: float | None
    paths: Sequence[PathBound]
    # loops and memory copies without a known bound: function and place of each
    unbound: Sequence[tuple[str, Place]]
    # indirect calls whose target is unknown: function and place of each
    unresolved: Sequence[tuple[str, Place]]
    # the longest time [cycle] for which a lock blocks the interrupts
    locked: int = 0
    # locks that contain a loop or a call, and therefore have no bound: function and place of each
    unbound_locks: Sequence[tuple[str, Place]] = ()
    # interrupts that occur more often in a recording than declared: the context, the recording, and
    # a number of requests with the time [ms] from the first to the last of them
    too_often: Sequence[tuple[str, str, int, float]] = ()

    @property
    def proven(self) -> bool:
        return not (self.unbound or self.unresolved or self.unbound_locks)


@dataclass(frozen=True)
class StackProof:
    """The largest stack use of the robot's firmware image in bytes, computed from its calls."""

    # bytes that the hardware stores on the stack when it starts an interrupt handler
    exception_frame: int
    limit: int = 0  # size of the stack in the linker script
    seen: int | None = None  # largest measured stack use of a closed-loop run; None without a run
    contexts: Sequence[StackContext] = field(default_factory=list)
    # indirect calls whose target is unknown: function and place of each
    unresolved: Sequence[tuple[str, Place]] = field(default_factory=list)
    cycles: Sequence[list[str]] = field(default_factory=list)
    # functions whose stack frame has no known bound
    dynamic: Sequence[str] = field(default_factory=list)
    # functions of the project whose stack frame the compiler did not report
    untold: Sequence[str] = field(default_factory=list)

    @property
    def proven(self) -> bool:
        return not (self.unresolved or self.cycles or self.dynamic or self.untold)

    @property
    def levels(self) -> list[StackContext]:
        """Returns the context that needs the most stack at each priority. The order is from the
        lowest priority to the highest. The program after a reset ("start") is the first."""
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
        """Returns the largest possible stack use: the sum over all priorities. Each priority except
        the lowest also adds the frame that the hardware stores when it starts an interrupt
        handler."""
        levels = self.levels
        return sum(level.bytes for level in levels) + self.exception_frame * (len(levels) - 1)


@dataclass(frozen=True)
class SharedPipe:
    """A pipe of the robot. ``writers`` and ``readers`` map each method that writes or reads the
    pipe to its execution contexts."""

    id: str
    name: str
    says: str
    type: str
    place: Place
    writers: Mapping[str, list[str]] = field(default_factory=dict)
    readers: Mapping[str, list[str]] = field(default_factory=dict)


@dataclass(frozen=True)
class SharedMember:
    """A data member that one execution context changes, and that another context changes or
    reads."""

    id: str
    module: str
    type: str
    place: Place
    writers: Sequence[str]
    readers: Sequence[str]
    protection: str  # "" if the design states no protection
    why: str


@dataclass(frozen=True)
class Use:
    """A use in the code: files of the logic module ``source`` include or call the logic module
    ``target``."""

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
    """Two groups of modules. The design demands that no module of one group names a module of the
    other group."""

    modules: Sequence[str]
    others: Sequence[str]
    why: str
    place: Place


@dataclass(frozen=True)
class Cycle:
    """Logic modules that may use each other in a cycle, and the pattern that makes the cycle
    necessary."""

    within: str
    modules: Sequence[str]
    pattern: str
    place: Place


@dataclass(frozen=True)
class ArchitectureElement:
    """An element of the Process Control architecture, and the modules that implement this
    element."""

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
    """A name in the paper and its counterparts in this project. ``here`` lists the counterparts as
    "kind:name"."""

    kind: str
    name: str
    here: Sequence[str]
    alias: str = ""  # reason why the name in this project differs from the paper
    deviation: str = ""  # intended difference from the paper
    note: str = ""
    # ids of the places in the paper that contain the name
    where: Sequence[str] = field(default_factory=list)
    place: Place = field(default_factory=lambda: Place("", 0))


@dataclass(frozen=True)
class KitTest:
    """A test of a likely change. ``result`` is None if the test did not run in this build."""

    id: str
    target: str
    result: str | None
    place: Place


@dataclass(frozen=True)
class Port:
    """A port: a variant of the firmware for another device or for another microcontroller."""

    title: str
    says: str
    program: str  # name of the test program
    image: str
    needs: str  # program that must be installed for the tests; "" if no program is needed
    files: Mapping[str, int]  # file that the port adds -> number of its lines
    # number of existing lines of the composition that are removed or changed
    composition_lines: int
    outside_lines: int  # number of changed lines of other files
    tests: Mapping[str, str] | None  # test -> result; None if the present sources have no results
    # flash and RAM of the port's image [byte]; empty if the image was not built from the present
    # sources
    size: Mapping[str, int]
    size_on_k64: Mapping[str, int]  # flash and RAM of the same design on the K64 [byte]

    @property
    def passed(self) -> bool:
        """Returns whether tests ran and all of them passed."""
        return bool(self.tests) and set((self.tests or {}).values()) == {"passed"}


@dataclass(frozen=True)
class MadeChange:
    """A likely change that was really made, in a folder of changes/ or as an extension."""

    application: str
    event: str
    # description of the change in the list of hard changes on the page of the likely changes; "" if
    # the list does not contain the change
    hard: str
    why: str  # reason why the change must edit existing files
    classes: Sequence[str]
    # folder of the extension that makes the change; "" if a folder of changes/ makes it
    extension: str
    files: Sequence[str]  # added files
    patched: Sequence[str]  # existing files that the change edits
    # number of existing lines of the composition that the change removes or edits
    composition_lines: int
    # number of existing lines outside the composition that the change removes or edits
    outside_lines: int
    added_lines: int  # number of lines added to existing files
    flash: float | None  # additional flash memory [byte]
    ram: float | None
    instructions: float | None  # additional instructions in a cycle, on average
    tests: Sequence[KitTest]
    place: Place

    @property
    def new_lines(self) -> int:
        """Returns the number of new lines in existing files. An edited line is not a new line."""
        return self.added_lines - self.composition_lines - self.outside_lines


@dataclass(frozen=True)
class LikelyChange:
    """The work that a likely change needs. The pattern limits the change to a few modules."""

    application: str
    pattern: str
    hidden_by: str  # module that hides the change
    # existing modules that implement one variant each; to change a variant, edit its module
    altered: Sequence[str]
    role: str  # role of the class that the change adds; "" if the change adds no class
    derives: Sequence[str]  # base classes of the class that the change adds
    logic: str  # folder of the existing classes
    # modules that must be edited, because they must name the added class; equal to ``altered`` if
    # the change adds no class
    edits: Sequence[str]
    untouched: Sequence[str]
    requirements: Sequence[str]  # requirements that must be reviewed after the change
    tests: Sequence[str]
    steps: Sequence[str]
    examples: Sequence[str]  # modules of extensions that make such a change
    made: MadeChange | None = None


@dataclass(frozen=True)
class ArchitectureGroup:
    """Modules that are one box in the high-level diagram. ``module`` represents all of them."""

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
    # Methods that the shown chain of calls must contain, in this order. Empty if the shortest chain
    # is a good example.
    through: Sequence[str]
    place: Place
    # The methods that form the connection in the code. Empty for a connection outside the code.
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
    """The document or fact that is the source of a belief of the virtual board."""

    id: str
    says: str
    # true if neither the driver nor its model in the virtual board was written from this source
    outside: bool
    place: Place


@dataclass(frozen=True)
class BoardBelief:
    """A belief: the assumed meaning of a register value. The virtual board implements this
    meaning."""

    register: str  # block::NAME
    value: str
    says: str
    source: str  # id of a BeliefSource
    model: str  # file of the virtual board
    # true if the belief has no independent source; the driver and the model could share a mistake
    shared: bool
    place: Place

    @property
    def name(self) -> str:
        """Returns the name of the register without its block."""
        return self.register.rpartition("::")[2]


@dataclass(frozen=True)
class DriverFault:
    """A fault that a test inserted in a driver, and the finding of the virtual K64 when it ran the
    firmware with this fault."""

    fault: str
    file: str
    finding: str
    caught: bool
    text: str


@dataclass(frozen=True)
class Finding:
    """A finding of a check. ``text`` describes the problem. If ``fix`` is empty, the general fix of
    the check is shown instead."""

    place: Place
    check: str
    text: str
    fix: str = ""


@dataclass(frozen=True)
class Curve:
    """A curve of a value over time. ``kind`` is "set_point", "measured" (reported by the robot) or
    "truth" (in the simulated robot)."""

    kind: str
    binding: str
    points: Sequence[tuple[float, float]]  # time [s] and value of each point


@dataclass(frozen=True)
class LoopPlot:
    title: str
    unit: str
    curves: Sequence[Curve]


@dataclass(frozen=True)
class LoopFigure:
    """A metric of a closed-loop scenario, with the greatest permitted value."""

    title: str
    limit: float
    unit: str
    requirement: str  # "" if no requirement states the limit
    # target on which the scenario ran -> value; None if the value could not be computed
    values: Mapping[str, float | None]

    def holds(self, binding: str) -> bool:
        value = self.values[binding]
        return value is not None and value <= self.limit


@dataclass(frozen=True)
class LoopRun:
    """The result of a closed-loop run. ``passed`` is true if the run met all expectations of the
    scenario. If ``passed`` is false, ``said`` is the output of the run."""

    passed: bool
    said: str
    stack: int | None = None  # largest stack use of the run on the virtual K64 [byte]


@dataclass(frozen=True)
class LoopScenario:
    name: str
    title: str
    says: str
    file: str
    place: Place
    plots: Sequence[LoopPlot]
    figures: Sequence[LoopFigure]
    runs: Mapping[str, LoopRun]  # target -> run with the present sources


@dataclass(frozen=True)
class ProductImage:
    """The firmware image of a product. ``modules`` are the modules in the firmware image.
    ``forbidden`` are the parts that the firmware image contains although the product must not
    contain them."""

    flash: int
    ram: int
    stack: int
    forbidden: Sequence[str]
    modules: Sequence[str]


@dataclass(frozen=True)
class Spread:
    """The average, the smallest and the greatest value of a quantity over the cycles of a run."""

    average: float
    minimum: float
    maximum: float


@dataclass(frozen=True)
class Latency:
    """The longest time from the request of an interrupt to the start of its handler, and the name
    of this interrupt."""

    us: float
    who: str


@dataclass(frozen=True)
class ExceptionCost:
    """The average cost of an interrupt or thread in a control cycle."""

    who: str
    entries: float
    instructions: int
    us: float
    report_us: float


@dataclass(frozen=True)
class BenchRun:
    """One run of a scenario of the bench. Instructions and latencies are measured only on the
    virtual board, and not on a real board."""

    report_ms: Spread  # time from the clock pulse to the report
    load: Spread  # processor time in per cent of the cycle
    start_us: Spread  # time from the clock pulse to the first instruction of the cycle
    jitter_us: float
    times_us: Sequence[int]  # for each cycle: time from the clock pulse to the report
    cycles: int
    instructions: Spread | None = None
    report_instructions: Spread | None = None  # instructions from the clock pulse to the report
    latency: Mapping[str, Latency] = field(default_factory=dict)  # priority -> the longest latency
    exceptions: Sequence[ExceptionCost] = field(default_factory=list)
    speed: float | None = None  # speed of the simulation: simulated time divided by real time


@dataclass(frozen=True)
class Profile:
    """The average number of instructions of each module and of each function in a cycle. The first
    number is for the whole cycle. The second number is for the time from the clock pulse to the
    report."""

    modules: Sequence[tuple[str, float, float]]
    functions: Sequence[tuple[str, float, float]]


@dataclass(frozen=True)
class BenchScenario:
    """A scenario of the bench. ``runs`` has a run for each timing model. ``profile`` has the
    instructions of each module."""

    runs: Mapping[str, BenchRun] = field(default_factory=dict)
    profile: Profile | None = None
