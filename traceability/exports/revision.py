"""A summary of a commit (its requirements, modules, findings, sizes and metrics), and the
differences between the summaries of two commits."""

from __future__ import annotations

import difflib
import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.reading.comparison_record import Difference
from traceability.reading.results import read_record
from traceability.reading.traces import nodes_of

FOLDER = Path("build/revisions")
# A long row of unchanged words is shortened: only this number of words is shown at its beginning
# and at its end. A row is long if it has more than twice this number of words.
WORDS = 8


@dataclass(frozen=True)
class RequirementState:
    """A requirement in a commit. ``state`` is the verdict, or "" if there was no report with
    verdicts."""

    text: str
    rationale: str
    state: str
    tree: tuple[str, ...]  # names of the methods in the invocation tree, in the order of the tree
    tests: tuple[str, ...]
    methods: tuple[str, ...]
    reviews: tuple[str, ...]


@dataclass(frozen=True)
class Revision:
    """The summary of a commit, for the comparison with other commits."""

    commit: str
    requirements: Mapping[str, RequirementState]
    modules: Mapping[str, str]  # name of the module -> path of the header
    # check -> number of findings; None if there was no report
    findings: Mapping[str, int] | None = None
    # product -> bytes of flash, RAM and stack
    sizes: Mapping[str, dict[str, int]] = field(default_factory=dict)
    metrics: Mapping[str, float | None] = field(default_factory=dict)


# ---- making and storing summaries ------------------------------------------------


def revision_of(
    model: Model, commit: str, report: Report | None, metrics: Mapping[str, Any]
) -> Revision:
    """Returns the summary of a model. Without a report, verdicts and findings are left out, because
    they need results of a run."""
    return Revision(
        commit,
        {name: _requirement(model, name, report) for name in model.requirements},
        {name: module.header for name, module in model.modules.items()},
        dict(Counter(finding.check for finding in report.findings)) if report else None,
        {
            name: {"flash": image.flash, "RAM": image.ram, "stack": image.stack}
            for name, image in (model.products or {}).items()
        },
        {name: value for name, value in metrics.items() if _is_number(value)},
    )


def _is_number(value: object) -> bool:
    return value is None or (isinstance(value, int | float) and not isinstance(value, bool))


def _requirement(model: Model, name: str, report: Report | None) -> RequirementState:
    requirement = model.requirements[name]
    return RequirementState(
        requirement.text,
        requirement.rationale,
        report.requirements[name].state if report else "",
        tuple(node.label for node in nodes_of(requirement.tree)),
        tuple(requirement.verified_by),
        tuple(requirement.satisfied_by),
        tuple(f"{review.reviewer}, {review.date}" for review in requirement.reviews),
    )


def path_of(root: Path, commit: str) -> Path:
    return root / FOLDER / f"{commit}.json"


def write_revision(root: Path, revision: Revision) -> None:
    path = path_of(root, revision.commit)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(asdict(revision)) + "\n", encoding="utf-8")


def read_revision(root: Path, commit: str) -> Revision | None:
    return read_record(path_of(root, commit), Revision)


# ---- comparing summaries ---------------------------------------------------------


def differences(first: Revision, second: Revision) -> list[Difference]:
    return [
        *_names("requirements", first.requirements, second.requirements),
        *_of_requirements(first, second),
        *_names("modules", first.modules, second.modules),
        *_sizes(first, second),
        *_findings(first, second),
        *_numbers("metrics", first.metrics, second.metrics),
    ]


def _findings(first: Revision, second: Revision) -> list[Difference]:
    if first.findings is None or second.findings is None:
        return []
    return _numbers("findings", first.findings, second.findings, missing=0)


def _names(section: str, first: Mapping[str, Any], second: Mapping[str, Any]) -> list[Difference]:
    return [
        *(Difference(section, name, "removed") for name in first if name not in second),
        *(Difference(section, name, "added") for name in second if name not in first),
    ]


def _of_requirements(first: Revision, second: Revision) -> Iterator[Difference]:
    for name, before in first.requirements.items():
        after = second.requirements.get(name)
        if after is None:
            continue
        for section in ("text", "rationale"):
            old, new = getattr(before, section), getattr(after, section)
            if old != new:
                yield Difference(f"{section} of requirements", name, changed_words(old, new))
        if before.state and after.state and before.state != after.state:
            yield Difference("verdicts", name, f"{before.state} -> {after.state}")
        for section in ("tree", "tests", "methods", "reviews"):
            for text in changed_items(getattr(before, section), getattr(after, section)):
                yield Difference(f"{section} of requirements", name, text)


def changed_words(old: str, new: str) -> str:
    """Returns the difference between two texts: removed words as [-removed-] and added words as
    {+added+}, with the unchanged words around them. A long row of unchanged words is shortened."""
    before, after = old.split(), new.split()
    parts: list[str] = []
    matcher = difflib.SequenceMatcher(None, before, after, autojunk=False)
    for tag, i, j, k, m in matcher.get_opcodes():
        same = before[i:j]
        if tag == "equal":
            long = len(same) > 2 * WORDS
            parts += [*same[:WORDS], "...", *same[-WORDS:]] if long else same
            continue
        parts += [f"[-{' '.join(same)}-]"] if same else []
        parts += [f"{{+{' '.join(after[k:m])}+}}"] if m > k else []
    return " ".join(parts)


def changed_items(before: Sequence[str], after: Sequence[str]) -> list[str]:
    return [
        f"{line[0]} {line[2:]}"
        for line in difflib.ndiff(before, after)
        if line.startswith(("- ", "+ "))
    ]


def _sizes(first: Revision, second: Revision) -> Iterator[Difference]:
    for product, before in first.sizes.items():
        for difference in _numbers(product, before, second.sizes.get(product, {})):
            yield Difference("sizes", product, f"{difference.subject}: {difference.text} bytes")


def _numbers(
    section: str,
    first: Mapping[str, float | None],
    second: Mapping[str, float | None],
    missing: float | None = None,
) -> list[Difference]:
    """Compares the numbers of two commits by name. If only one commit has a number with this name,
    ``missing`` is used for the other commit. A number that is ``None`` is not compared, because it
    was not measured."""
    changed = []
    for name in sorted(first.keys() | second.keys()):
        before, after = first.get(name, missing), second.get(name, missing)
        if before is not None and after is not None and before != after:
            text = f"{before:g} -> {after:g} ({after - before:+g})"
            changed.append(Difference(section, name, text))
    return changed
