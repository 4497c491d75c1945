"""./wr impact: shows the effects of a change."""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
import textwrap
from pathlib import Path

from tools.diff import commit_of
from tools.python_imports import importing_tests
from tools.steps import UsageError, need_file
from traceability.model.build import build
from traceability.model.impact import Impact, Impacts, Reached, UnknownSubjectError
from traceability.reading.build_evidence import git
from traceability.sources import FRAMES

WIDTH = 100
RANGE = ".."  # separates two commits
SHOWN = 12  # largest number of tests that are listed without --json


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "impact",
        description="Builds the model and lists the modules that a change may affect, sorted by "
        "distance. Also lists the requirements, patterns and tests to review. Some modules call a "
        "changed module only through an abstract class. The command lists these modules "
        "separately, without their requirements. For a change of a Python file, it lists the "
        "Python tests that import this file. Last, it lists the changed files whose effects are "
        "unknown, such as pages, scenarios and build files. The portal shows the effects on the "
        "page of each module and requirement.",
    )
    parser.add_argument(
        "subject",
        help="a file of the project, a module, a requirement (FR-15), or two commits as REV1..REV2",
    )
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    parser.set_defaults(run=impact)


def impact(root: Path, options: argparse.Namespace) -> int:
    found = impact_of(root, options.subject)
    if options.json:
        print(json.dumps(dataclasses.asdict(found), indent=1))
    else:
        print("\n".join(lines_of(found)))
    return 0


def impact_of(root: Path, subject: str) -> Impact:
    path = Path(subject)
    if path.is_file() and path.resolve().is_relative_to(root):
        subject = str(path.resolve().relative_to(root))
    elif "/" in subject and RANGE not in subject:
        need_file(root / subject, "name a file of the project")
    files = changed_files(root, subject) if RANGE in subject else [subject]
    if sys.stderr.isatty():
        print("Reads the sources and the results ...", file=sys.stderr, flush=True)
    try:
        impacts = Impacts(build(root).model)
        if RANGE in subject or (root / subject).is_file():
            return with_python(root, impacts.of_files(subject, files), files)
        return impacts.of(subject)
    except UnknownSubjectError as error:
        raise UsageError(str(error)) from error


def with_python(root: Path, found: Impact, files: list[str]) -> Impact:
    """Adds the Python tests that changed, or that import a changed Python file, directly or
    indirectly. A change of the table of the frames counts as a change of the client's
    layout.py, which reads this table."""
    python = [path for path in files if path.endswith(".py")]
    python += FRAMES[1:] if FRAMES[0] in files else ()
    for test, path in importing_tests(root, python).items():
        near = test == path
        why = "changed" if near else f"imports {path}"
        found.python_tests.append(Reached(test, 0 if near else 1, why))
    found.python_tests.sort(key=lambda one: one.distance)
    found.unfollowed = [path for path in found.unfollowed if not importing_tests(root, [path])]
    return found


def changed_files(root: Path, commits: str) -> list[str]:
    """Returns the files that differ between two commits."""
    for name in commits.split(RANGE):
        if name:
            commit_of(root, name)
    return git(root, "diff", "--no-renames", "--name-only", commits).splitlines()


def lines_of(found: Impact) -> list[str]:
    lines = [f"A change of the {found.kind} {found.subject}"]
    farthest = max((module.distance for module in found.modules), default=-1)
    for distance in range(farthest + 1):
        names = found.at(distance)
        titles = ["begins with", "may affect directly", f"may affect through {distance} uses"]
        title = titles[min(distance, 2)]
        lines += ["", f"{title}: {counted(len(names), 'module')}"]
        lines += reasons(names) if distance < 2 else wrapped([name.id for name in names])
    lines += ["", f"may call it through an abstract class: {counted(len(found.callers), 'module')}"]
    lines += reasons(found.callers)
    for noun, reached in (
        ("requirement", found.requirements),
        ("safety goal", found.goals),
        ("pattern", found.patterns),
    ):
        lines += ["", f"review: {counted(len(reached), noun)}"]
        lines += reasons(reached)
    lines += ["", f"run again: {counted(len(found.tests), 'test')}"]
    lines += reasons(found.tests[:SHOWN])
    if len(found.tests) > SHOWN:
        lines.append(f"  and {len(found.tests) - SHOWN} more; --json lists them")
    lines += ["", f"run again: {counted(len(found.python_tests), 'file')} of Python tests"]
    lines += reasons(found.python_tests)
    if found.unfollowed:
        lines += [
            "",
            f"effects unknown: {counted(len(found.unfollowed), 'file')}; run ./wr test --all",
        ]
        lines += [f"  {path}" for path in found.unfollowed]
    return lines


def counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def reasons(reached: list[Reached]) -> list[str]:
    width = max((len(one.id) for one in reached), default=0)
    return [f"  {one.id:<{width}}  {one.because}" for one in reached]


def wrapped(names: list[str]) -> list[str]:
    return textwrap.wrap(", ".join(names), WIDTH, initial_indent="  ", subsequent_indent="  ")
