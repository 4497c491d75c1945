"""./wr check: the documents, checked against the code."""

from __future__ import annotations

import argparse
import gc
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from traceability.commands.steps import FailureError, Steps

if TYPE_CHECKING:
    from traceability.model.schema import Finding, Model

STEPS = 4
PARTS = ("model", "checks", "site", "links")
# Changed files -> the figure that the time for model, checks, site and links is then.
MEASURED = {None: "build.cold_s", 1: "build.edit_s"}


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "check",
        help="rebuild the documents and check them against the code",
        description="Builds the model and the site, and checks both against the code. Prints each "
        "finding as 'file:line: [check] what is wrong; what would mend it'.",
    )
    parser.add_argument(
        "--drift",
        action="store_true",
        help="first seed each fault of tests/drift in a copy, and see whether the checks find it",
    )
    parser.set_defaults(run=lambda root, options: check(root, drift=options.drift))


def check(root: Path, *, drift: bool = False) -> int:
    steps = Steps(root, STEPS + drift)
    if drift:
        seed_faults(root, steps)
    findings = make_documents(root, steps)
    return report(findings, steps)


def seed_faults(root: Path, steps: Steps) -> None:
    """Each fault must be found; what was found, and where, is on a page of the portal."""

    def seed(log: TextIO) -> str:
        from traceability.drift.record import read_record
        from traceability.drift.run import seed_all

        outcomes = read_record(root)
        if outcomes is None:
            outcomes = seed_all(root)
        missed = [one for one in outcomes if not one.caught]
        for one in missed:
            log.write(f"{one.name}: {one.says} [{one.check}] at {one.file}:{one.line}\n")
            log.writelines(f"    found: {said}\n" for said in one.said)
        found = f"{len(outcomes) - len(missed)} of {len(outcomes)} faults found"
        if missed:
            raise FailureError(found)
        return found

    steps.run("drift", seed)


def make_documents(
    root: Path, steps: Steps, figures: Callable[[], dict[str, float]] = dict
) -> list[Finding]:
    """Model, checks, site and links: four steps. A failed step leaves out those that need it.

    Where nothing has changed since they were made, they stay. ``figures`` tells, at the end, what
    the command itself measured.
    """
    from traceability.made import files_read, is_whole, read_made, write_made

    start, files, made = time.monotonic(), files_read(root), read_made(root)
    if made is not None and made.files == files and is_whole(root, made):
        for title in PARTS:
            steps.run(title, lambda _log: "unchanged")
        return made.findings
    changed = count_changes(made.files, files) if made else None
    with no_collection():
        findings, complete = make_anew(root, steps, lambda: measured(start, changed) | figures())
    if complete:
        write_made(root, files, findings)
    return findings


@contextmanager
def no_collection() -> Iterator[None]:
    """The model lives until the end: to look through it for garbage takes a fifth of the time."""
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


def measured(start: float, changed: int | None) -> dict[str, float]:
    """The time since the start, if it stands for a figure."""
    name = MEASURED.get(changed)
    return {name: round(time.monotonic() - start, 1)} if name else {}


def make_anew(
    root: Path, steps: Steps, figures: Callable[[], dict[str, float]]
) -> tuple[list[Finding], bool]:
    """The findings, and whether no step failed."""
    from traceability.checks import run_checks, run_link_checks
    from traceability.documents.build import build_site
    from traceability.metrics import site_figures, write_metrics
    from traceability.pipeline import build_model

    model: Model | None = None
    findings: list[Finding] = []

    def make_model(_log: TextIO) -> str:
        nonlocal model
        try:
            model = build_model(root)
        except UnicodeDecodeError as error:
            from traceability.checks.documents import not_text

            findings.extend(not_text(root))
            raise FailureError("a file is not UTF-8") from error
        return f"{len(model.modules)} modules, {len(model.requirements)} requirements"

    def run_all(_log: TextIO) -> str:
        assert model is not None
        findings.extend(run_checks(model))
        return counted(findings)

    def make_site(_log: TextIO) -> str:
        assert model is not None
        result = build_site(root, model, findings)
        findings.extend(result.warnings)
        return f"{result.pages} pages"

    def check_links(_log: TextIO) -> str:
        assert model is not None
        site = root / "build" / "site"
        found = run_link_checks(model, site)
        findings.extend(found)
        write_metrics(root, model, site_figures(site, findings) | figures())
        return counted(found)

    if not steps.run("model", make_model):
        for title in PARTS[1:]:
            steps.skip(title, "there is no model")
        return findings, False
    whole = steps.run("checks", run_all)
    if whole and is_unreadable(model):
        for title in PARTS[2:]:
            steps.skip(title, "a file of the design cannot be read")
        return findings, False
    if not steps.run("site", make_site):
        steps.skip("links", "the site was not built")
        return findings, False
    return findings, steps.run("links", check_links) and whole


def is_unreadable(model: Model | None) -> bool:
    """Whether a part of the design is missing, and every page would show less than there is."""
    return bool(model and model.facts and model.facts.declared.entries.unreadable)


def count_changes(before: dict[str, str], now: dict[str, str]) -> int:
    return len([file for file in before | now if before.get(file) != now.get(file)])


def counted(findings: list[Finding]) -> str:
    return "1 finding" if len(findings) == 1 else f"{len(findings)} findings"


def report(findings: list[Finding], steps: Steps) -> int:
    """Prints the findings and the failed steps; returns the exit code."""
    from traceability.checks import message, sort

    first = ("syntax-error", "design-entry")  # what others may follow from
    for finding in sorted(sort(findings), key=lambda one: one.check not in first):
        print(message(finding))
    if steps.failed:
        print(f"failed: {', '.join(steps.failed)}")
    print(counted(findings))
    return 1 if findings or steps.failed else 0
