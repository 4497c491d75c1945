"""Lists the evidence that a build lacks. The pages show this list, because a reader could otherwise
assume more evidence than there is."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlencode

from traceability.model.design_model import Model
from traceability.model.made_changes import proven
from traceability.model.metrics import METHODS, driver_lines
from traceability.model.report import Report
from traceability.reading.bench_record import SCENARIOS, SHARE, SLOW, Paper
from traceability.reading.lint_record import FAILED, NOT_RUN
from traceability.reading.products import RECORDED
from traceability.reading.published import FAULTS, FUZZ, LOADS
from traceability.reading.traces import nodes_of
from traceability.schema import HOST, VIRTUAL_K64, BuildEvidence, LastRecord, Requirement

NAMES = {"mutation": "The mutation test of the tests", "drift": "The test of the checks"}

# The value of the filter for the target, if the tests of a requirement passed only on one target.
ONLY = "only {}"
# Drivers that the image with recorded lines does not contain.
UNMEASURED = re.compile(r"extensions/\w+/k64/\w+\.cpp")
# campaign -> its content, and the page with the details
CAMPAIGNS = {
    FAULTS: ("random faults", "robustness"),
    FUZZ: ("random inputs", "robustness"),
    LOADS: ("random drives with a busy serial line", "bench"),
}
# State of a requirement -> the words for it. Other sentences list the states "partly" and "stale".
STATES = {
    "suspect": "suspect requirements (a text on which their verdict depends has changed since the "
    "baseline)",
    "failed": "requirements with a failed test",
    "unverified": "requirements that are not verified (evidence is missing, or a value is out of "
    "its bound)",
}
OLD_DRIVES = "last ran at commit"  # words of a known exception about simulated drives


@dataclass(frozen=True)
class NotShown:
    """A sentence about evidence that this build lacks, and the page with the details.

    ``query`` contains the values of the filters that select these details on the page. ``commit``
    is the commit of a run that this build did not repeat, if changes of the firmware can make its
    result untrue."""

    text: str
    page: str  # id of the page in the navigation
    query: str = ""
    commit: str = ""


ALWAYS = (
    NotShown(
        "No real board has run this build. Tests run on this computer and on the virtual K64, "
        "which the authors of the firmware wrote.",
        "beliefs",
    ),
    NotShown(
        "The tests with sanitizers (./wr test sanitize) are a separate run. Their result is "
        "not part of this build.",
        "build_evidence",
    ),
    NotShown(
        "Branch coverage is measured only on the host, without the code for the K64. MC/DC is "
        "not measured.",
        "virtual_k64",
    ),
)


def not_shown(model: Model, report: Report) -> list[NotShown]:
    return [
        *ALWAYS,
        *_sources(model),
        *(_build(model.build) if model.build else ()),
        *_requirements(model, report),
        *_missing_runs(model),
        *_measurements(model),
        *_earlier_runs(model),
    ]


def by_method(model: Model, report: Report) -> str:
    """Returns a text with the number of verified requirements for each method of verification."""
    words = {"test": "by tests", "analysis": "by analysis", "measurement": "by measurement"}
    states = report.requirements
    counts = {
        method: sum(
            requirement.method == method and states[requirement.id].state == "verified"
            for requirement in model.requirements.values()
        )
        for method in METHODS
    }
    listed = (f"{n} {words.get(method, f'by {method}')}" for method, n in counts.items() if n)
    return ", ".join(listed) or "none"


def _sources(model: Model) -> Iterator[NotShown]:
    if model.safety.goals:
        yield NotShown(
            "Some evidence exists only for some of the products. The section “Tested products” "
            "names the products with which the fault scenarios were played, and the product of "
            "each calculation and measurement.",
            "safety",
        )
    if shared := sum(belief.shared for belief in model.beliefs):
        yield NotShown(
            f"The drivers and the virtual board rely on {_count(len(model.beliefs), 'value')} of "
            f"registers. For {shared} of them, no source outside of this project was found.",
            "beliefs",
        )
    if targets := [target for target in model.results_hashes if model.stale_on(target)]:
        yield NotShown(
            "The test results of these targets are missing or older than the sources: "
            f"{', '.join(targets)}.",
            "tests",
        )


def _build(build: BuildEvidence) -> Iterator[NotShown]:
    texts = []
    if build.changed:
        texts.append(
            f"Number of files that differ from the commit of this build: {len(build.changed)}."
        )
    if build.lint is None:
        texts.append("The static analysis (./wr lint) was not run in this build.")
    results = build.lint.steps.items() if build.lint else ()
    for result, words in (FAILED, "failed"), (NOT_RUN, "were not run"):
        if steps := [step for step, one in results if one == result]:
            texts.append(
                f"These steps of the static analysis (./wr lint) {words} in this build: "
                f"{', '.join(steps)}."
            )
    if build.failed:
        texts.append(
            f"{_count(len(build.failed), 'Python test')} of the tools, the client and the "
            f"pages failed: {', '.join(build.failed)}."
        )
    if folders := [folder for folder, counts in build.tool_tests.items() if counts is None]:
        texts.append(
            "The Python tests in these folders of tests/python were not run with these sources: "
            f"{', '.join(folders)}."
        )
    if counts := build.long_tests.values():
        texts.append(
            "The long tests of the tools (./wr test --long) are not part of this build: "
            f"{_count(sum(counts), 'test function')} in {_count(len(counts), 'file')}."
        )
    if build.repeated:
        texts.append(
            f"{_count(len(build.repeated), 'test')} of the client failed at first. Only the "
            "second result counts."
        )
    yield from (NotShown(text, "build_evidence") for text in texts)


def _requirements(model: Model, report: Report) -> Iterator[NotShown]:
    requirements = list(model.requirements.values())
    reviewed = sum(requirement.reviewed for requirement in requirements)
    if reviewed < len(requirements):
        yield NotShown(
            "Reviews by a person who is not an author exist for "
            f"{f'only {reviewed}' if reviewed else 'none'} of the {len(requirements)} "
            "requirements.",
            "requirements",
        )
    counts = Counter(verdict.state for verdict in report.requirements.values())
    for state, words in STATES.items():
        if counts[state]:
            query = urlencode({"state": state})
            yield NotShown(f"Number of {words}: {counts[state]}.", "requirements", query)
    if report.findings:
        yield NotShown(f"The checks report {_count(len(report.findings), 'finding')}.", "checks")
    if partly := [requirement.id for requirement in requirements if requirement.partly]:
        yield NotShown(
            "These requirements are only partly verified, and their pages state the reason: "
            f"{', '.join(partly)}.",
            "requirements",
        )
    if goals := [name for name, verdict in report.goals.items() if verdict.state != "verified"]:
        yield NotShown(f"These safety goals are not verified: {', '.join(goals)}.", "safety")
    hazards = model.safety.hazards.values()
    if unplayed := [hazard.id for hazard in hazards if not hazard.scenarios]:
        yield NotShown(
            f"Number of hazards without a fault scenario: {len(unplayed)} of {len(hazards)} "
            f"({', '.join(unplayed)}).",
            "safety",
        )
    if short := sum(len(nodes_of(requirement.tree)) == 1 for requirement in requirements):
        yield NotShown(
            f"Number of invocation trees with only one node: {short}. Such a tree shows that a "
            "method ran, but shows no sequence of calls.",
            "trees",
        )
    if only_host := sum(targets_of(model, each) == [HOST] for each in requirements):
        yield NotShown(
            f"The tests of {_count(only_host, 'requirement')} passed only on the host. No test of "
            f"these requirements passed on the {VIRTUAL_K64}.",
            "requirements",
            urlencode({"binding": ONLY.format(HOST)}),
        )


def targets_of(model: Model, requirement: Requirement) -> list[str]:
    """Returns the targets on which a test of the requirement passed."""
    tests = [model.tests[name] for name in requirement.verified_by]
    passed = {target for test in tests for target in test.gave("passed")}
    return [target for target in model.results_hashes if target in passed]


def _missing_runs(model: Model) -> Iterator[NotShown]:
    """Yields the results that this build lacks. If a test of an example of a change did not pass,
    this example is counted. If a test of a port did not pass, this port is listed. ``_sources``
    lists missing test results of a target."""
    coverage = model.measured.get("coverage.line")
    results = (
        (coverage, "The combined coverage of the tests was not measured", "requirements"),
        (model.board_lines, "The executed lines of the drivers were not measured", "virtual_k64"),
        (model.driver_faults, "The faults seeded in the drivers were not tried", "virtual_k64"),
        (model.bench, "The times of the control cycle were not measured", "bench"),
        (model.stack, "The longest times and the largest stack were not calculated", "execution"),
        (model.proofs.results, "The properties of the state machines were not proved", "proofs"),
    )
    for result, words, page in results:
        if result is None:
            yield NotShown(f"{words} with these sources.", page)
    loops = model.closed_loop
    if unplayed := sum(not {HOST, VIRTUAL_K64} <= loop.runs.keys() for loop in loops):
        yield NotShown(
            f"For {unplayed} of {len(loops)} scenarios of the control performance, a run with "
            "these sources is missing (on the host or on the virtual board).",
            "closed_loop",
        )
    made = [change.made for change in model.changes.values() if change.made]
    if unproven := len(made) - sum(map(proven, made)):
        yield NotShown(
            "Some examples of likely changes have a failed test, or no test results with these "
            f"sources: {unproven} of {len(made)}.",
            "changes",
        )
    if ports := [name for name, port in model.ports.items() if not port.passed]:
        yield NotShown(
            "These ports to other devices have a failed test, or no test results with these "
            f"sources: {', '.join(ports)}.",
            "changes",
        )


def _measurements(model: Model) -> Iterator[NotShown]:
    missed, total = driver_lines(model)
    if missed:
        yield NotShown(
            f"In the image {RECORDED}, the tests did not execute {missed} of the {total} lines of "
            "src/k64. No reasons are stated for these lines. For the released images, the "
            "executed lines are not measured.",
            "virtual_k64",
        )
    if files := unmeasured_drivers(model):
        yield NotShown(
            "Some files of the extensions are compiled only for the K64. Their executed lines are "
            f"not measured: {', '.join(files)}.",
            "virtual_k64",
        )
    if slow := sum(_share(model, paper) > 1 for paper in SCENARIOS):
        yield NotShown(
            f"The control cycle misses its target in {slow} of "
            f"{_count(len(SCENARIOS), 'scenario')}. The target is 1/{SHARE} of the paper's time. "
            "The times are measured with the model of a slow flash.",
            "bench",
        )
    if recorded := model.proofs.recorded:
        yield NotShown(
            f"This build did not repeat {_count(len(recorded), 'proof')} of the state machines. A "
            f"run at commit {recorded[0].recorded[:7]} proved the same models.",
            "proofs",
        )


def unmeasured_drivers(model: Model) -> list[str]:
    """Returns the source files of the extensions that are compiled only for the K64. The image with
    recorded lines contains none of them."""
    return sorted(filter(UNMEASURED.match, model.files))


def _share(model: Model, paper: Paper) -> float:
    """Returns the greater of two quotients: the average time divided by the target of the average
    time, and the longest time divided by the target of the longest time. Returns 0 if the scenario
    was not measured."""
    measured = (model.bench or {}).get(paper.name)
    if measured is None:
        return 0
    times = measured.runs[SLOW].report_ms
    return SHARE * max(times.average / paper.average, times.maximum / paper.maximum)


def _earlier_runs(model: Model) -> Iterator[NotShown]:
    exceptions = {name: " ".join(goal.exceptions) for name, goal in model.safety.goals.items()}
    if goals := [name for name, text in exceptions.items() if OLD_DRIVES in text]:
        yield NotShown(
            "This build did not repeat the long series of drives with faults "
            "(tests/python/programs/test_random_drives.py). The commits of the last run are in the "
            f"known exceptions of {', '.join(goals)}.",
            "safety",
        )
    for name, (text, page) in CAMPAIGNS.items():
        if record := model.campaigns.get(name):
            reactions = _reactions(record.result) if name == FAULTS else ""
            yield NotShown(
                f"This build did not repeat ./wr campaign {name} ({text}). Its last run was at "
                f"commit {record.commit[:7]}.{reactions}",
                page,
                commit=record.commit,
            )
    for name in NAMES:
        last = model.last.get(name)
        if text := _last(name, last):
            # The test of the checks does not depend on the code of the firmware.
            old = name == "mutation" and last and not last.current
            yield NotShown(text, name, commit=last.commit if last and old else "")
    last = model.last.get("release")
    if last is None or not last.current:
        run = f" Its last run was at {_commit(last)} on {last.date}." if last else ""
        yield NotShown(f"./wr release --verify was not run in this build.{run}", "build_evidence")


def _reactions(result: Mapping[str, Any]) -> str:
    """Returns the numbers of the faults after which the firmware did not react correctly."""
    counts = result["outcomes"]
    return (
        f" Of {_count(result['cases'], 'fault')}, {counts['silent']} caused wrong outputs "
        f"without a report, {counts['late']} were detected too late or had an effect after the "
        f"reset, and {counts['hung']} stopped all answers. {counts['stopped']} were not judged, "
        "because the virtual board could not continue."
    )


def _last(name: str, last: LastRecord | None) -> str:
    if last is None:
        return f"{NAMES[name]} was not run in this build."
    if last.current:
        missed = last.tried - last.found - last.justified
        return f"{NAMES[name]} missed {missed} of {_count(last.tried, 'fault')}." if missed else ""
    justified = (
        f" For {last.justified} others, a justification states that no test can find them."
        if last.justified
        else ""
    )
    return (
        f"{NAMES[name]} was not run in this build. Its last run, at {_commit(last)} on "
        f"{last.date}, found {last.found} of {_count(last.tried, 'fault')}.{justified}"
    )


def _commit(last: LastRecord) -> str:
    return f"commit {last.commit[:7]}" if last.commit else "an unknown commit"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
