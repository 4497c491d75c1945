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
from traceability.model.metrics import METHODS
from traceability.model.report import Report
from traceability.reading.bench_record import SCENARIOS, SHARE, SLOW, Paper
from traceability.reading.fault_record import FAULTS, FUZZ, LOADS
from traceability.reading.lint_record import FAILED, NOT_RUN
from traceability.reading.products import RECORDED
from traceability.reading.traces import nodes_of
from traceability.schema import HOST, VIRTUAL_K64, LastRecord, Requirement

NAMES = {"mutation": "The mutation test of the tests", "drift": "The test of the checks"}

# The value of the filter for the target, if the tests of a requirement passed only on one target.
ONLY = "only {}"
PAPER = {paper.name: paper for paper in SCENARIOS}
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
OLD_DRIVES = "last played at commit"  # words of a known exception about drives that were played


@dataclass(frozen=True)
class NotShown:
    """A sentence about evidence that this build lacks, and the page with the details.

    ``query`` contains the values of the filters that select these details on the page. ``commit``
    is the commit of a run that this build did not repeat, if changes of the firmware can make its
    result untrue.
    """

    text: str
    page: str  # id of the page in the navigation
    query: str = ""
    commit: str = ""


def not_shown(model: Model, report: Report) -> list[NotShown]:
    requirements = list(model.requirements.values())
    texts: list[tuple[str, ...]] = [
        (
            "No real board has run this build. Tests run on this computer and on the virtual K64, "
            "which the authors of the firmware wrote.",
            "beliefs",
        ),
        (
            "The tests with sanitizers (./wr test sanitize) are a separate run. Their result is "
            "not part of this build.",
            "build_evidence",
        ),
        (
            "Branch coverage is measured only on the host, without the code for the K64. MC/DC is "
            "not measured.",
            "virtual_k64",
        ),
        *_products(model),
        *_beliefs(model),
        *_stale(model),
        *_static_analysis(model),
        *_tool_tests(model),
        *_reviews(requirements),
        *_states(report),
        *_verdicts(model, report),
        *_targets(model, requirements),
        *_driver_lines(model),
        *_times(model),
        *_proofs(model),
        *_drives(model),
        *_campaigns(model),
        *_lasts(model),
        *_release(model),
    ]
    return [NotShown(*parts) for parts in texts]


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


def _stale(model: Model) -> Iterator[tuple[str, str]]:
    targets = [target for target in model.results_hashes if model.stale_on(target)]
    if targets:
        yield (
            "The test results of these targets are missing or older than the sources: "
            f"{', '.join(targets)}.",
            "tests",
        )
    if model.build and model.build.changed:
        yield (
            "Number of files that differ from the commit of this build: "
            f"{len(model.build.changed)}.",
            "build_evidence",
        )


def _products(model: Model) -> Iterator[tuple[str, str]]:
    if model.safety.goals:
        yield (
            "Not all evidence is from all products. The section “Tested products” names the "
            "products with which the fault scenarios were played, and the product of each "
            "calculation and measurement.",
            "safety",
        )


def _beliefs(model: Model) -> Iterator[tuple[str, str]]:
    shared = sum(belief.shared for belief in model.beliefs)
    if shared:
        yield (
            f"The drivers and the virtual board rely on {_count(len(model.beliefs), 'value')} of "
            f"registers. For {shared} of them, no source outside of this project was found.",
            "beliefs",
        )


def _static_analysis(model: Model) -> Iterator[tuple[str, str]]:
    if model.build is None:
        return
    if model.build.lint is None:
        yield "The static analysis (./wr lint) was not run in this build.", "build_evidence"
        return
    for result, words in ((FAILED, "failed"), (NOT_RUN, "were not run")):
        steps = [step for step, one in model.build.lint.steps.items() if one == result]
        if steps:
            yield (
                f"These steps of the static analysis (./wr lint) {words} in this build: "
                f"{', '.join(steps)}.",
                "build_evidence",
            )


def _tool_tests(model: Model) -> Iterator[tuple[str, str]]:
    if model.build and model.build.failed:
        yield (
            f"{_count(len(model.build.failed), 'Python test')} of the tools, the client and the "
            f"pages failed: {', '.join(model.build.failed)}.",
            "build_evidence",
        )
    if model.build and model.build.long_tests:
        counts = model.build.long_tests.values()
        yield (
            "The long tests of the tools (./wr test --long) are not part of this build: "
            f"{_count(sum(counts), 'test function')} in {_count(len(counts), 'file')}.",
            "build_evidence",
        )
    if model.build and model.build.repeated:
        yield (
            f"{_count(len(model.build.repeated), 'test')} of the client failed at first. Only the "
            "second result counts.",
            "build_evidence",
        )


def _campaigns(model: Model) -> Iterator[tuple[str, str, str, str]]:
    for name, (text, page) in CAMPAIGNS.items():
        if record := model.campaigns.get(name):
            reactions = _reactions(record.result) if name == FAULTS else ""
            yield (
                f"This build did not repeat ./wr campaign {name} ({text}). Its last run was at "
                f"commit {record.commit[:7]}.{reactions}",
                page,
                "",
                record.commit,
            )


def _reactions(result: Mapping[str, Any]) -> str:
    """Returns the numbers of the faults after which the firmware did not react correctly."""
    counts = result["outcomes"]
    return (
        f" Of {_count(result['cases'], 'fault')}, {counts['silent']} caused wrong outputs that no "
        f"report showed, {counts['late']} were detected too late or had an effect after the reset, "
        f"and {counts['hung']} stopped all answers. {counts['stopped']} were not judged, because "
        "the virtual board could not continue."
    )


def _drives(model: Model) -> Iterator[tuple[str, str]]:
    goals = [
        goal.id
        for goal in model.safety.goals.values()
        if any(OLD_DRIVES in text for text in goal.exceptions)
    ]
    if goals:
        yield (
            "This build did not repeat the long series of drives with faults "
            "(tests/python/programs/test_random_drives.py). Known exceptions of "
            f"{', '.join(goals)} state the commits of their last run.",
            "safety",
        )


def _reviews(requirements: list[Requirement]) -> Iterator[tuple[str, str]]:
    missing = sum(not requirement.reviewed for requirement in requirements)
    if missing:
        number = "none" if missing == len(requirements) else f"only {len(requirements) - missing}"
        yield (
            f"Reviews by a person who is not an author exist for {number} of the "
            f"{len(requirements)} requirements.",
            "requirements",
        )


def _states(report: Report) -> Iterator[tuple[str, str, str]]:
    counts = Counter(verdict.state for verdict in report.requirements.values())
    for state, words in STATES.items():
        if counts[state]:
            query = urlencode({"state": state})
            yield f"Number of {words}: {counts[state]}.", "requirements", query
    if report.findings:
        yield f"The checks report {_count(len(report.findings), 'finding')}.", "checks", ""


def _verdicts(model: Model, report: Report) -> Iterator[tuple[str, str]]:
    requirements = model.requirements.values()
    partly = [requirement.id for requirement in requirements if requirement.partly]
    if partly:
        yield (
            "These requirements are only partly verified, and their pages state the reason: "
            f"{', '.join(partly)}.",
            "requirements",
        )
    goals = [name for name, verdict in report.goals.items() if verdict.state != "verified"]
    if goals:
        yield f"These safety goals are not verified: {', '.join(goals)}.", "safety"
    short = sum(
        requirement.tree is not None and len(nodes_of(requirement.tree)) == 1
        for requirement in requirements
    )
    if short:
        yield (
            f"Number of invocation trees with only one node: {short}. Such a tree shows that a "
            "method ran, but shows no sequence of calls.",
            "trees",
        )


def targets_of(model: Model, requirement: Requirement) -> list[str]:
    """Returns the targets on which a test of the requirement passed."""
    tests = [model.tests[name] for name in requirement.verified_by]
    passed = {target for test in tests for target in test.gave("passed")}
    return [target for target in model.results_hashes if target in passed]


def _targets(model: Model, requirements: list[Requirement]) -> Iterator[tuple[str, str, str]]:
    only_host = sum(targets_of(model, requirement) == [HOST] for requirement in requirements)
    if only_host:
        yield (
            f"The tests of {_count(only_host, 'requirement')} run only on the host, and not on the "
            f"{VIRTUAL_K64}.",
            "requirements",
            urlencode({"binding": ONLY.format(HOST)}),
        )


def driver_lines(model: Model) -> tuple[int, int]:
    """Returns the number of lines of the drivers that were not executed in the image ``RECORDED``,
    and the number of all their lines. Both are 0 if the lines were not measured."""
    hits = [hit for lines in (model.board_lines or {}).values() for hit in lines.values()]
    return hits.count(False), len(hits)


def _driver_lines(model: Model) -> Iterator[tuple[str, str]]:
    missed, total = driver_lines(model)
    if missed:
        yield (
            f"In the image {RECORDED}, the tests did not execute {missed} of the {total} lines of "
            "src/k64. No reasons are stated for these lines. The lines that the tests of the "
            "released images execute are not measured.",
            "virtual_k64",
        )
    if files := unmeasured_drivers(model):
        yield (
            "The executed lines of these files of the extensions, which are compiled only for the "
            f"K64, are not measured: {', '.join(files)}.",
            "virtual_k64",
        )


def unmeasured_drivers(model: Model) -> list[str]:
    """Returns the source files of the extensions that are compiled only for the K64. The image with
    recorded lines contains none of them."""
    return sorted(filter(UNMEASURED.match, model.files))


def _times(model: Model) -> Iterator[tuple[str, str]]:
    slow = [name for name, paper in PAPER.items() if _share(model, name, paper) > 1]
    if slow:
        yield (
            f"The control cycle misses its target in {len(slow)} of "
            f"{_count(len(PAPER), 'scenario')}. The target is 1/{SHARE} of the paper's time. The "
            "times are measured with the model of a slow flash.",
            "bench",
        )


def _share(model: Model, name: str, paper: Paper) -> float:
    """Returns the greater of two quotients: the average time divided by the target of the average
    time, and the longest time divided by the target of the longest time. Returns 0 if the scenario
    was not measured."""
    measured = (model.bench or {}).get(name)
    if measured is None:
        return 0
    times = measured.runs[SLOW].report_ms
    return SHARE * max(times.average / paper.average, times.maximum / paper.maximum)


def _proofs(model: Model) -> Iterator[tuple[str, str]]:
    recorded = model.proofs.recorded
    if recorded:
        yield (
            f"This build did not repeat {_count(len(recorded), 'proof')} of the state machines. A "
            f"run at commit {recorded[0].recorded[:7]} proved the same models.",
            "proofs",
        )


def _lasts(model: Model) -> Iterator[tuple[str, str, str, str]]:
    for name in NAMES:
        last = model.last.get(name)
        if text := _last(name, last):
            # The test of the checks does not depend on the code of the firmware.
            old = name == "mutation" and last and not last.current
            yield text, name, "", last.commit if last and old else ""


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


def _release(model: Model) -> Iterator[tuple[str, str]]:
    last = model.last.get("release")
    if last is None or not last.current:
        run = f" Its last run was at {_commit(last)} on {last.date}." if last else ""
        yield f"./wr release --verify was not run in this build.{run}", "build_evidence"


def _commit(last: LastRecord) -> str:
    return f"commit {last.commit[:7]}" if last.commit else "an unknown commit"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
