"""./wr diff: compares the requirements, verdicts, modules, sizes, findings, metrics and files of
two commits."""

from __future__ import annotations

import argparse
import dataclasses
import json
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tools.steps import FailureError, UsageError
from traceability.exports.revision import (
    Revision,
    differences,
    read_revision,
    revision_of,
    write_revision,
)
from traceability.grouping import grouped
from traceability.model.build import build
from traceability.reading.build_evidence import git
from traceability.reading.comparison_record import Comparison, Difference, write_comparison
from traceability.sources import DESIGN
from weeding_robot_client.exit_codes import DONE

PAGE = "differences.html"
SYNTAX = Path("build/model/cache")
# The sources of the requirements, trees, tests, methods, reviews and modules.
FOLLOWED = (*(f"{folder}/" for folder in DESIGN), "requirements/", "design/", "tests/")
UNFOLLOWED = (".py", ".scenario", ".json")


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "diff",
        description="Compares two commits. Requirements, trees, tests, methods, reviews and "
        "modules are read from the sources of both commits. Verdicts, sizes, findings "
        "and metrics are compared if ./wr portal or ./wr check recorded both commits "
        "in build/revisions. Lists all files that differ. Some files, such as Python sources "
        "and pages, have the mark 'content not compared'. The next portal shows the "
        "differences on a page. Reading a commit for the first time "
        f"takes up to half a minute. The exit code is {DONE} with and without differences.",
    )
    parser.add_argument("first", metavar="REV1", help="a commit, a branch or a tag")
    parser.add_argument(
        "second",
        metavar="REV2",
        nargs="?",
        default="HEAD",
        help="the newer commit, branch or tag (default: HEAD)",
    )
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    parser.set_defaults(run=diff)


def diff(root: Path, options: argparse.Namespace) -> int:
    first, second = (load(root, name) for name in (options.first, options.second))
    found = [*differences(first, second), *changed_files(root, first.commit, second.commit)]
    unmeasured = [one.commit for one in (first, second) if one.findings is None]
    write_comparison(root, Comparison(first.commit, second.commit, found, unmeasured))
    if options.json:
        print(json.dumps([dataclasses.asdict(one) for one in found], indent=1))
        return 0
    print("\n".join(lines_of(found)))
    for commit in dict.fromkeys(unmeasured):
        print(
            f"\n{commit[:10]} has no recorded results. Its verdicts, findings, sizes and metrics "
            "are therefore not compared."
        )
    print(f"\nAfter ./wr portal, the page {PAGE} of the portal shows the differences.")
    return 0


def commit_of(root: Path, name: str) -> str:
    commit = git(root, "rev-parse", "--verify", "--quiet", f"{name}^{{commit}}").strip()
    if not commit:
        raise UsageError(f"git has no commit {name}; name a commit, a branch or a tag")
    return commit


def load(root: Path, name: str) -> Revision:
    """Returns the recorded revision. If there is no record, reads the sources and records the
    revision."""
    commit = commit_of(root, name)
    found = read_revision(root, commit)
    if found is None:
        found = read_sources(root, commit)
        write_revision(root, found)
    return found


def read_sources(root: Path, commit: str) -> Revision:
    """Reads the sources of a commit. They are unpacked into a temporary folder."""
    with tempfile.TemporaryDirectory(prefix="weeding-robot-") as folder:
        copy = Path(folder)
        unpack(root, commit, copy)
        copy_syntax(root, copy)
        built = build(copy)
    if built.facts.declared.entries.unreadable:
        raise FailureError(f"this version cannot read the design of {commit[:10]}")
    return revision_of(built.model, commit, None, {})


def unpack(root: Path, commit: str, folder: Path) -> None:
    archive = subprocess.run(
        ["git", "-C", str(root), "archive", commit], capture_output=True, check=True
    )
    subprocess.run(["tar", "-x", "-C", str(folder)], input=archive.stdout, check=True)


def copy_syntax(root: Path, copy: Path) -> None:
    """Copies the stored parse results of the present sources. Then a source is parsed only if it
    differs from the present source."""
    (copy / SYNTAX).mkdir(parents=True)
    for facts in (root / SYNTAX).glob("*.facts"):
        shutil.copy(facts, copy / SYNTAX)


def changed_files(root: Path, first: str, second: str) -> Iterator[Difference]:
    """Yields the files that differ. Some of these files have the mark 'content not compared'."""
    for line in git(root, "diff", "--no-renames", "--numstat", first, second).splitlines():
        added, removed, path = line.split("\t")
        lines = "binary" if added == "-" else f"+{added} -{removed} lines"
        followed = path.startswith(FOLLOWED) and not path.endswith(UNFOLLOWED)
        yield Difference(
            "changed files", path, lines + ("" if followed else "; content not compared")
        )


def lines_of(found: list[Difference]) -> list[str]:
    if not found:
        return ["no differences"]
    lines = []
    for section, members in sorted(grouped(found, lambda one: one.section).items()):
        width = max(len(one.subject) for one in members)
        lines += ["", f"{section}: {len(members)}"]
        lines += [f"  {difference.subject:<{width}}  {difference.text}" for difference in members]
    return lines[1:]
