"""The model: the source of all checks, pages, charts and exports.

Each run builds it once (``traceability.model.build``) from the comments, the syntax tree, the
declarations in ``design/``, test results, traces, coverage and sizes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from traceability.reading.comparison_record import Comparison
from traceability.reading.published import Published
from traceability.reading.seeded_fault_record import Outcome
from traceability.reading.seeded_faults import Fault
from traceability.schema import (
    AllowedUse,
    Apart,
    ArchitectureElement,
    ArchitectureGroup,
    BeliefSource,
    BenchScenario,
    BoardBelief,
    BoardFinding,
    BuildEvidence,
    Connection,
    Constant,
    Cycle,
    DriverFault,
    ExecutionContext,
    Function,
    Justified,
    LastRecord,
    LikelyChange,
    LineGap,
    LogicModule,
    LoopScenario,
    MessageField,
    Module,
    Mutant,
    Mutation,
    PaperElement,
    PaperPlace,
    PaperStatement,
    PatternApplication,
    PatternPrice,
    Port,
    ProductImage,
    Proofs,
    Requirement,
    SafetyCase,
    SharedMember,
    SharedPipe,
    StackProof,
    StateMachine,
    Suspicion,
    Test,
    TimeProof,
    Tuned,
    Use,
)


@dataclass(frozen=True)
class Model:
    commit: str
    version: str
    sources_hash: str
    # target with tests -> hash of the sources of its last run
    results_hashes: Mapping[str, str | None]
    logic_modules: Mapping[str, LogicModule] = field(default_factory=dict)
    modules: Mapping[str, Module] = field(default_factory=dict)
    functions: Mapping[str, Function] = field(default_factory=dict)
    # name that texts use -> constant
    constants: Mapping[str, Constant] = field(default_factory=dict)
    tuned: Sequence[Tuned] = field(default_factory=list)
    patterns: Mapping[str, PatternApplication] = field(default_factory=dict)
    requirements: Mapping[str, Requirement] = field(default_factory=dict)
    tests: Mapping[str, Test] = field(default_factory=dict)
    justified: Sequence[Justified] = field(default_factory=list)
    mutation: Mutation | None = None  # result for the present sources
    machines: Mapping[str, StateMachine] = field(default_factory=dict)
    contexts: Mapping[str, ExecutionContext] = field(default_factory=dict)
    prices: Mapping[str, PatternPrice] = field(default_factory=dict)  # application -> cost
    times: TimeProof | None = None  # for the image, if the present sources built it
    stack: StackProof | None = None  # for the image, if the present sources built it
    pipes: Sequence[SharedPipe] = field(default_factory=list)
    shared: Sequence[SharedMember] = field(default_factory=list)
    uses: Sequence[Use] = field(default_factory=list)
    allowed_uses: Sequence[AllowedUse] = field(default_factory=list)
    allowed_cycles: Sequence[Cycle] = field(default_factory=list)
    kept_apart: Sequence[Apart] = field(default_factory=list)
    architecture: Sequence[ArchitectureElement] = field(default_factory=list)
    messages: Sequence[MessageField] = field(default_factory=list)
    groups: Sequence[ArchitectureGroup] = field(default_factory=list)
    connections: Sequence[Connection] = field(default_factory=list)
    paper: Sequence[PaperElement] = field(default_factory=list)
    statements: Sequence[PaperStatement] = field(default_factory=list)
    paper_places: Sequence[PaperPlace] = field(default_factory=list)
    changes: Mapping[str, LikelyChange] = field(default_factory=dict)  # application -> change
    ports: Mapping[str, Port] = field(default_factory=dict)  # ports to other devices, by folder
    comparison: Comparison | None = None  # the last comparison of two commits
    board_findings: Mapping[str, BoardFinding] = field(default_factory=dict)
    beliefs: Sequence[BoardBelief] = field(default_factory=list)
    belief_sources: Mapping[str, BeliefSource] = field(default_factory=dict)
    driver_faults: Sequence[DriverFault] | None = None  # results for the present sources
    # File of the drivers -> line -> whether the tests executed it on the virtual K64.
    board_lines: Mapping[str, dict[int, bool]] | None = None
    line_gaps: Sequence[LineGap] = field(default_factory=list)
    # suspicions of texts without a requirement
    suspicions: Sequence[Suspicion] = field(default_factory=list)
    # requirements that have a review but no longer exist
    reviews_of_nothing: Sequence[str] = field(default_factory=list)
    # The elements that the design demands. Some elements may be missing in the code.
    designed_modules: Sequence[str] = field(default_factory=list)
    designed_applications: Mapping[str, str] = field(default_factory=dict)  # id -> pattern
    closed_loop: Sequence[LoopScenario] = field(default_factory=list)
    safety: SafetyCase = field(default_factory=SafetyCase)
    proofs: Proofs = field(default_factory=Proofs)
    # Records of other steps. They are ``None`` when the sources have changed since.
    bench: Mapping[str, BenchScenario] | None = None
    bench_paper: Mapping[str, BenchScenario] | None = (
        None  # runs of the robot without safety functions
    )
    products: Mapping[str, ProductImage] | None = None
    # faults that are inserted to test the checks
    faults: Sequence[Fault] = field(default_factory=list)
    outcomes: Sequence[Outcome] | None = None  # results of the inserted faults
    last: Mapping[str, LastRecord] = field(default_factory=dict)  # name of a test -> record
    campaigns: Mapping[str, Published] = field(default_factory=dict)  # the published records
    build: BuildEvidence | None = None
    measured: Mapping[str, Any] = field(default_factory=dict)  # metrics that other steps measured
    files: Sequence[str] = field(default_factory=list)  # sources for which the site has a page

    def stale_on(self, binding: str) -> bool:
        """Returns whether the results of a target are missing or are older than the sources."""
        return self.results_hashes.get(binding) != self.sources_hash

    @property
    def results_stale(self) -> bool:
        """Returns whether the results of any target are missing or are older than the sources."""
        return any(self.stale_on(binding) for binding in self.results_hashes)

    def mutants_of(self, requirement: str) -> list[Mutant]:
        """Returns the mutants in the methods of a requirement's tree, if the tests of the
        requirement were tried on them."""
        tried = self.mutation.tried if self.mutation else []
        return [mutant for mutant in tried if requirement in mutant.own]
