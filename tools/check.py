"""./wr check: checks the documents against the code."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from tools.documents import counted, read_findings, write_time
from tools.lock import only_one
from tools.tasks import DOCUMENTS, graph, pages_graph
from traceability.reading.published import publish
from traceability.reading.seeded_faults import last_seeded
from traceability.reading.task_record import SEEDED_FAULTS


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "check",
        description="Builds the model and checks it against the code. Prints each finding as "
        "'file:line: [check] fault; fix'. If a text or a name on the pages changed, also builds "
        "the pages and checks their links. ./wr portal always updates the pages.",
    )
    parser.add_argument(
        "--drift",
        nargs="*",
        metavar="CHECK",
        help="first test the checks: insert each seeded fault of tests/drift into a copy of the "
        "project. With the names of some checks, the command tests only these checks, and does not "
        "check the project.",
    )
    parser.add_argument(
        "--publish",
        action="store_true",
        help="with --drift: also write the result to a file in tests/records; then commit this "
        "file",
    )
    parser.set_defaults(run=run)


def run(root: Path, options: argparse.Namespace) -> int:
    if options.drift:
        return seed_some(root, options.drift)
    drift = options.drift is not None
    code = check(root, drift=drift)
    if drift and options.publish and (record := last_seeded(root)):
        score = {"found": record.found, "tried": record.tried}
        publish(root, "drift", "./wr check --drift", record.commit, score)
    return code


def seed_some(root: Path, checks: list[str]) -> int:
    """Inserts the faults of some checks, and prints the result of each fault."""
    from tools.seed_faults import seed

    with only_one(root, "check"):
        outcomes = seed(root, checks)
    for outcome in outcomes:
        print(f"{'found ' if outcome.caught else 'MISSED'}  [{outcome.check}] {outcome.says}")
        for text in [] if outcome.caught else outcome.said or ["nothing was found"]:
            print(f"        {text}")
    missed = sum(not outcome.caught for outcome in outcomes)
    print(f"{len(outcomes) - missed} of {len(outcomes)} faults found")
    return 1 if missed else 0


def check(root: Path, *, drift: bool = False) -> int:
    start = time.monotonic()
    with only_one(root, "check"):
        failed = graph(root).run([SEEDED_FAULTS]).failed if drift else []
        pages = pages_graph(root, keep=True).run([DOCUMENTS])
        if pages.changed_inputs.get(DOCUMENTS) == 1 and not drift:
            write_time(root, "build.edit_s", time.monotonic() - start)
        return report(root, [*failed, *pages.failed])


def report(root: Path, failed: list[str]) -> int:
    """Prints the findings of the documents and the failed tasks. Returns the exit code."""
    from traceability.checks import message, sort

    findings = read_findings(root)
    # The findings of these checks are printed first. A fault that such a check finds also causes
    # many findings of other checks.
    first = ("syntax-error", "design-entry")
    for finding in sorted(sort(findings or []), key=lambda finding: finding.check not in first):
        print(message(finding))
    if failed:
        print(f"failed: {', '.join(failed)}")
    unknown = "the findings are not known, because the documents were not built"
    print(unknown if findings is None else counted(findings))
    return 0 if findings == [] and not failed else 1
