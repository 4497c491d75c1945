"""./wr verify-build: repeats the build of the commit in a new folder, and compares the two
builds."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from tools.steps import FailureError, MissingError
from traceability.exports.verification_table import JSON
from traceability.reading.build_evidence import git, read_run
from traceability.reading.products import PRODUCTS, image_of
from traceability.reading.results import RESULTS, RUNS, read_json
from traceability.schema import HOST
from traceability.sources import file_hash
from weeding_robot_client.exit_codes import FAILED

RECORD = RESULTS / JSON
IMAGES_ONLY = ("firmware",)
WHOLE = ("portal", "--no-serve")


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "verify-build",
        description="Clones the present commit into a new folder, and builds and tests it there. "
        "Then compares the two builds: each firmware image byte by byte, the verdict of each "
        "requirement, and the results of the tests that verify requirements. Randomised tests get "
        "the seed of the first run. The exit code is "
        f"{FAILED} if the builds differ. The command takes as long as a first build.",
    )
    parser.add_argument(
        "--images", action="store_true", help="compare only the firmware images of the K64"
    )
    parser.set_defaults(run=verify_build)


def verify_build(root: Path, options: argparse.Namespace) -> int:
    check_origin(root, images=options.images)
    with tempfile.TemporaryDirectory(prefix="weeding-robot-") as folder:
        copy = Path(folder) / "project"
        print(f"Repeats the build in {copy}", flush=True)
        clone(root, copy)
        words = IMAGES_ONLY if options.images else WHOLE
        failed = run_in_copy(root, copy, *words)
        if failed and not (copy / RECORD).exists() and not options.images:
            raise FailureError("the build in the new folder failed; see its messages above")
        differences = list(compare(root, copy, images=options.images))
    for line in differences:
        print(line)
    what = "images" if options.images else "images, verdicts and test results"
    print(
        f"{len(differences)} differences" if differences else f"The two builds have equal {what}."
    )
    return 1 if differences else 0


def check_origin(root: Path, *, images: bool) -> None:
    """Checks that no file differs from the commit, and that this folder contains the results of a
    build. If ``images`` is false, also checks that these results belong to the commit."""
    if not git(root, "rev-parse", "HEAD"):
        raise MissingError("this folder is not a git clone: there is no commit to repeat")
    changed = git(root, "status", "--porcelain").splitlines()
    if changed:
        raise FailureError(f"{len(changed)} files differ from the commit; commit them first")
    needed = [root / image_of(product, ".bin") for product in PRODUCTS]
    needed += [] if images else [root / RECORD]
    missing = [path for path in needed if not path.exists()]
    if missing:
        raise MissingError(f"{missing[0].relative_to(root)} does not exist; run ./wr portal first")
    record = read_json(root / RECORD)
    commit = git(root, "rev-parse", "HEAD").strip()
    if not images and not commit.startswith((record or {}).get("commit", "-")):
        raise FailureError("the results here belong to another commit; run ./wr portal first")


def clone(root: Path, copy: Path) -> None:
    command = ["git", "clone", "--quiet", "--no-hardlinks", str(root), str(copy)]
    if subprocess.run(command, check=False).returncode:
        raise FailureError("git could not clone this folder; see its message above")
    (copy / ".venv").symlink_to(root / ".venv")


def run_in_copy(root: Path, copy: Path, *words: str) -> int:
    """Runs a command of ./wr in the copy, and returns its exit code. Python looks for modules in
    the copy first. The tests get the seed of the last run in ``root``."""
    path = os.pathsep.join(str(folder) for folder in (copy, copy / "client", copy / "site"))
    run = read_run(root, RUNS[HOST])
    seed = {"WR_SEED": run.seeds[0]} if run and len(run.seeds) == 1 else {}
    environment = {**os.environ, **seed, "PYTHONPATH": path}
    command = [sys.executable, "-m", "tools", *words]
    return subprocess.run(command, cwd=copy, env=environment, check=False).returncode


def compare(root: Path, copy: Path, *, images: bool) -> Iterator[str]:
    """Yields the differences, one in each line."""
    for product in PRODUCTS:
        name = image_of(product, ".bin")
        if file_hash(root / name) != file_hash(copy / name):
            yield f"{name}: the bytes differ"
    if images:
        return
    first, second = (read_json(folder / RECORD) or {} for folder in (root, copy))
    yield from compare_verdicts(first, second)


def compare_verdicts(first: Mapping[str, Any], second: Mapping[str, Any]) -> Iterator[str]:
    """Yields the requirements whose states differ, and the tests whose results differ."""
    rows = [{row["id"]: row for row in table.get("requirements", [])} for table in (first, second)]
    for name in sorted(rows[0].keys() | rows[1].keys()):
        here, there = (table.get(name, {}) for table in rows)
        if here.get("state") != there.get("state"):
            yield f"{name} is {here.get('state')} here, but {there.get('state')} in the new folder"
        tests, repeated = here.get("tests", {}), there.get("tests", {})
        for test in sorted(tests.keys() | repeated.keys()):
            if tests.get(test) != repeated.get(test):
                yield f"{name}: {test}: {tests.get(test)} here, {repeated.get(test)} there"
