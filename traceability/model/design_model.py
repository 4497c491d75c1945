"""The model. All checks, pages, charts and exports read it.

The model contains facts from the comments, the syntax tree, the declarations in ``design/``, the
test results, the recorded calls, the coverage and the sizes of the modules. Each run of a command
builds the model once (``traceability.model.build``)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from traceability import schema
from traceability.reading.baseline_record import Part
from traceability.reading.comparison_record import Comparison
from traceability.reading.published import Published
from traceability.reading.seeded_faults import Fault, Outcome


@dataclass(frozen=True)
class Model:
    commit: str
    version: str
    sources_hash: str
    # target on which tests run -> ``sources_hash`` if its last test results belong to the present
    # sources, "other sources" if they belong to other sources, None if there are no test results
    results_hashes: Mapping[str, str | None]
    logic_modules: Mapping[str, schema.LogicModule] = field(default_factory=dict)
    modules: Mapping[str, schema.Module] = field(default_factory=dict)
    functions: Mapping[str, schema.Function] = field(default_factory=dict)
    # name by which the texts refer to a constant -> the constant
    constants: Mapping[str, schema.Constant] = field(default_factory=dict)
    tuned: Sequence[schema.Tuned] = field(default_factory=list)
    patterns: Mapping[str, schema.PatternApplication] = field(default_factory=dict)
    requirements: Mapping[str, schema.Requirement] = field(default_factory=dict)
    tests: Mapping[str, schema.Test] = field(default_factory=dict)
    justified: Sequence[schema.Justified] = field(default_factory=list)
    equivalents: Sequence[schema.Equivalent] = field(default_factory=list)
    # result of the mutation test; None if it did not run with the present sources
    mutation: schema.Mutation | None = None
    machines: Mapping[str, schema.StateMachine] = field(default_factory=dict)
    contexts: Mapping[str, schema.ExecutionContext] = field(default_factory=dict)
    # pattern application -> its cost in the firmware image
    prices: Mapping[str, schema.PatternPrice] = field(default_factory=dict)
    # The two proofs for the firmware image. They are None if the image was not built from the
    # present sources.
    times: schema.TimeProof | None = None
    stack: schema.StackProof | None = None
    pipes: Sequence[schema.SharedPipe] = field(default_factory=list)
    shared: Sequence[schema.SharedMember] = field(default_factory=list)
    uses: Sequence[schema.Use] = field(default_factory=list)
    allowed_uses: Sequence[schema.AllowedUse] = field(default_factory=list)
    allowed_cycles: Sequence[schema.Cycle] = field(default_factory=list)
    kept_apart: Sequence[schema.Apart] = field(default_factory=list)
    architecture: Sequence[schema.ArchitectureElement] = field(default_factory=list)
    messages: Sequence[schema.MessageField] = field(default_factory=list)
    groups: Sequence[schema.ArchitectureGroup] = field(default_factory=list)
    connections: Sequence[schema.Connection] = field(default_factory=list)
    paper: Sequence[schema.PaperElement] = field(default_factory=list)
    statements: Sequence[schema.PaperStatement] = field(default_factory=list)
    paper_places: Sequence[schema.PaperPlace] = field(default_factory=list)
    # pattern application -> the likely change for which the pattern prepares the code
    changes: Mapping[str, schema.LikelyChange] = field(default_factory=dict)
    # folder below ports/ -> the port of the firmware to another device
    ports: Mapping[str, schema.Port] = field(default_factory=dict)
    comparison: Comparison | None = None  # the last comparison of two commits
    # the parts of the robot in the baseline design and in the pattern design
    baseline_parts: Sequence[Part] = field(default_factory=list)
    board_findings: Mapping[str, schema.BoardFinding] = field(default_factory=dict)
    beliefs: Sequence[schema.BoardBelief] = field(default_factory=list)
    belief_sources: Mapping[str, schema.BeliefSource] = field(default_factory=dict)
    # faults that were seeded in the drivers; None if they were not tried with the present sources
    driver_faults: Sequence[schema.DriverFault] | None = None
    # file of the design -> the lines and branches of the file that the tests on the host executed
    host_files: Mapping[str, schema.FileCoverage] = field(default_factory=dict)
    # file of a driver -> number of a source line -> true if a test on the virtual K64 executed it
    board_lines: Mapping[str, dict[int, bool]] | None = None
    line_gaps: Sequence[schema.LineGap] = field(default_factory=list)
    # texts that belong to no requirement, and that differ from the baseline
    suspicions: Sequence[schema.Suspicion] = field(default_factory=list)
    # ids that have a baseline or a review, although no requirement has this id
    reviews_of_nothing: Sequence[str] = field(default_factory=list)
    # The modules and pattern applications that the design demands. The code may lack some of them.
    designed_modules: Sequence[str] = field(default_factory=list)
    designed_applications: Mapping[str, str] = field(default_factory=dict)  # id -> pattern
    closed_loop: Sequence[schema.LoopScenario] = field(default_factory=list)
    safety: schema.SafetyCase = field(default_factory=schema.SafetyCase)
    proofs: schema.Proofs = field(default_factory=schema.Proofs)
    # The next three fields are records of other steps. A record is None if the sources have changed
    # after the step wrote it.
    bench: Mapping[str, schema.BenchScenario] | None = None
    # runs of the product that has no safety functions
    bench_paper: Mapping[str, schema.BenchScenario] | None = None
    products: Mapping[str, schema.ProductImage] | None = None
    faults: Sequence[Fault] = field(default_factory=list)  # seeded faults, which test the checks
    # results of the seeded faults; None if they do not belong to the present state of the project
    outcomes: Sequence[Outcome] | None = None
    # name of a test that does not run in each build, because it takes too long -> its last result
    last: Mapping[str, schema.LastRecord] = field(default_factory=dict)
    # kind of a test campaign -> its last published result
    campaigns: Mapping[str, Published] = field(default_factory=dict)
    build: schema.BuildEvidence | None = None
    # key of a metric -> value that another step measured
    measured: Mapping[str, Any] = field(default_factory=dict)
    files: Sequence[str] = field(default_factory=list)  # source files that have a page in the site

    @property
    def methods(self) -> list[schema.Method]:
        """Returns the methods of all modules and value types."""
        return [method for module in self.modules.values() for method in module.methods]

    @property
    def integers(self) -> dict[str, int]:
        """Returns the values of the constants that have an integer type."""
        numbers = {name: constant.number for name, constant in self.constants.items()}
        return {name: number for name, number in numbers.items() if isinstance(number, int)}

    def stale_on(self, binding: str) -> bool:
        """Returns true if a target has no test results, or if its test results do not belong to the
        present sources."""
        return self.results_hashes.get(binding) != self.sources_hash

    @property
    def results_stale(self) -> bool:
        return any(self.stale_on(binding) for binding in self.results_hashes)

    def passing(self, tests: Iterable[str], binding: str) -> dict[str, str]:
        """Returns the recordings of those tests that passed on a target, each with its test."""
        return {
            recording: name
            for name in tests
            if binding in self.tests[name].gave("passed")
            for recording in self.tests[name].results[binding].recordings
        }

    def mutants_of(self, requirement: str) -> list[schema.Mutant]:
        """Returns the mutants on which the tests of a requirement were tried. These mutants are in
        the methods of the requirement's invocation tree."""
        tried = self.mutation.tried if self.mutation else []
        return [mutant for mutant in tried if requirement in mutant.own]


def requirement_key(name: str) -> tuple[str, int]:
    """Returns the key by which the ids of requirements are sorted."""
    kind, _, number = name.partition("-")
    return (kind, int(number) if number.isdigit() else 0)
