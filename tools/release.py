"""./wr release: makes the files of a release from a commit. The bytes of these files do not depend
on the folder of the project."""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from tools.book import print_book
from tools.documents import read_findings
from tools.firmware import SVD
from tools.lock import only_one
from tools.release_files import below, different_members, sums_text, write_archive
from tools.sbom import NAME as SBOM
from tools.sbom import sbom_text
from tools.steps import FailureError, MissingError, UsageError
from tools.tasks import DOCUMENTS, K64_FIRMWARE, graph, pages_graph
from tools.verify_build import clone, run_in_copy
from traceability.exports.svd import write_svd
from traceability.exports.tool_files import FILES
from traceability.exports.verification_table import JSON, JUNIT, SCHEMA
from traceability.model.pattern_price import MEASURED
from traceability.reading.build_evidence import git
from traceability.reading.products import PRODUCTS, image_of
from traceability.reading.published import publish
from traceability.reading.results import LIVE_MODULE, RELEASE, RESULTS
from traceability.reading.task_record import IMAGES
from traceability.reading.task_record import RECORD as TASKS
from traceability.reading.traces import SOURCES
from traceability.sources import file_hash
from traceability.whole_file import write_json

FOLDER = Path("build/release")
SITE = Path("build/site")
SUMS = "SHA256SUMS"
CHANGELOG = Path("CHANGELOG.md")
VERSION = re.compile(r"project\([^)]*VERSION\s+([\d.]+)")
ARCHIVE = ".tar.gz"
TIMES, MODEL = MEASURED.parent, Path("build/model")
VERIFY = "./wr release --verify"
SHOWN = 20  # greatest number of shown differences inside an archive
SUFFIXES = (".elf", ".bin", ".hex")
# These files of a build are not needed by any page. They contain paths and times of this computer.
NOT_SHIPPED = (".doctree", ".pickle", ".buildinfo", ".bak", "status.json")
EXPORTS = ("model.json", "model.schema.json", JSON, SCHEMA, JUNIT, *(file.name for file in FILES))


@dataclass(frozen=True)
class Release:
    version: str
    commit: str
    when: int  # time of the commit [s since 1970]

    @property
    def name(self) -> str:
        return f"weeding_robot-{self.version}"


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "release",
        description="Makes the files of a release in build/release. Uses the present commit, and "
        "no file may differ from this commit. The release contains the firmware images with their "
        "hashes, a list of the parts (CycloneDX), the sources, the portal for reading without a "
        "network, the exports, and the notes. It also contains the book, if Chromium is installed. "
        "All times in the archives are the time of the commit.",
    )
    parser.add_argument(
        "--verify",
        action="store_true",
        help="make the release again in a new folder, with copies of the test results, and "
        "compare the two releases",
    )
    parser.add_argument(
        "--publish",
        action="store_true",
        help="with --verify: write the number of equal files to tests/records/release.json",
    )
    parser.set_defaults(run=run_release)


def run_release(root: Path, options: argparse.Namespace) -> int:
    if options.publish and not options.verify:
        raise UsageError("--publish needs --verify")
    return release(root, verify=options.verify, published=options.publish)


def release(root: Path, *, verify: bool, published: bool = False) -> int:
    made = identity(root)
    folder = root / FOLDER
    with only_one(root, "release"):
        build(root)
        shutil.rmtree(folder, ignore_errors=True)
        write_release(root, made, folder)
    print((folder / SUMS).read_text(encoding="utf-8"), end="")
    print(f"The release {made.version} of {made.commit[:10]} is in {FOLDER}")
    if not verify:
        return 0
    different = compare_with_second(root, folder)
    record = {"commit": made.commit, "reproducible": not different}
    write_json(root / RELEASE, record)
    for line in different:
        print(line)
    if published:
        files = len(below(folder))
        unequal = sum(not line.startswith(" ") for line in different)
        score = {"found": files - unequal, "tried": files}
        path = publish(root, RELEASE.stem, VERIFY, made.commit[:10], score)
        print(f"published in {path.relative_to(root)}")
    print("The two releases are the same." if not different else f"{len(different)} files differ.")
    return 1 if different else 0


def identity(root: Path) -> Release:
    """Returns the version, the commit and the time of the commit. Raises an error if a file differs
    from the commit."""
    commit = git(root, "rev-parse", "HEAD").strip()
    if not commit:
        raise MissingError("this folder is not a git clone, but a release needs a commit")
    changed = git(root, "status", "--porcelain").splitlines()
    if changed:
        raise FailureError(f"{len(changed)} files differ from the commit; commit them first")
    found = VERSION.search((root / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert found
    return Release(found[1], commit, int(git(root, "log", "-1", "--format=%ct")))


def build(root: Path) -> None:
    run = graph(root).run((K64_FIRMWARE, IMAGES))
    pages = pages_graph(root).run([DOCUMENTS])
    if run.failed or pages.failed:
        raise FailureError("the build failed; see its messages above")
    write_svd(root, root / SVD)
    print(f"the documents have {len(read_findings(root) or [])} findings")


def write_release(root: Path, made: Release, folder: Path) -> None:
    """Writes the files of the release, and then the list of their hashes."""
    images = {
        f"{product}{suffix}": root / image_of(product, suffix)
        for product in PRODUCTS
        for suffix in SUFFIXES
    }
    hashes = {name: file_hash(path) for name, path in images.items() if name.endswith(".bin")}
    texts = {
        SBOM: sbom_text(root, made.version, made.commit, made.when, hashes),
        "NOTES.md": notes(root, made),
    }
    folder.mkdir(parents=True)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    site = below(root / SITE, *NOT_SHIPPED)
    exports = {name: root / SITE / name for name in EXPORTS if (root / SITE / name).exists()}
    for part, files in (("images", images), ("portal", site), ("exports", exports)):
        inside = {f"{made.name}/{part}/{name}": path for name, path in files.items()}
        write_archive(folder / f"{made.name}-{part}{ARCHIVE}", inside, made.when)
    write_source(root, made, folder / f"{made.name}-source{ARCHIVE}")
    add_book(root, folder / f"{made.name}-book.pdf")
    (folder / SUMS).write_text(sums_text(folder, below(folder)), encoding="utf-8")


def write_source(root: Path, made: Release, path: Path) -> None:
    """Writes the archive of the sources. Each file has the time of the commit. A file is executable
    in the archive if it is executable in git."""
    words = ["archive", "--format=tar.gz", f"--prefix={made.name}/source/", made.commit]
    subprocess.run(["git", *words, "--output", path], cwd=root, check=True)


def add_book(root: Path, path: Path) -> None:
    """Adds the book, if Chromium is installed."""
    try:
        print_book(root, path)
    except MissingError as error:
        print(f"The release has no book: {error}")


def notes(root: Path, made: Release) -> str:
    """Returns the section of the version in the changelog."""
    text = (root / CHANGELOG).read_text(encoding="utf-8")
    found = re.search(rf"^## {re.escape(made.version)}\b.*?(?=^## |\Z)", text, re.M | re.S)
    if not found:
        raise FailureError(f"{CHANGELOG} has no section '## {made.version}'; write it")
    return f"{found[0].rstrip()}\n\nCommit {made.commit}\n"


# ---- the second time -------------------------------------------------------------


def compare_with_second(root: Path, folder: Path) -> list[str]:
    """Makes the release again in a clone. The results of tests are an input of this second
    release."""
    with tempfile.TemporaryDirectory(prefix="weeding-robot-") as name:
        copy = Path(name) / "project"
        print(f"Makes the release again in {copy}", flush=True)
        clone(root, copy)
        bring_results(root, copy)
        if run_in_copy(root, copy, "release"):
            raise FailureError("the release in the new folder failed; see its messages above")
        return differences(folder, copy / FOLDER)


def bring_results(root: Path, copy: Path) -> None:
    """Copies the results of tests and measurements, because they contain times that differ in a
    second run. Recordings also contain the addresses of the recorded program."""
    recorded = [path for one in SOURCES.values() for path in (one.folder, one.executable)]
    covered = [path.relative_to(root) for path in (root / MODEL).glob("coverage-*.pickle")]
    for name in (RESULTS, TASKS, TIMES, LIVE_MODULE, *recorded, *covered):
        if (root / name).is_dir():
            shutil.copytree(root / name, copy / name)
        elif (root / name).exists():
            (copy / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, copy / name)


def differences(first: Path, second: Path) -> list[str]:
    here, there = below(first), below(second)
    found = [
        f"{name} is only in one of the two releases" for name in sorted(here.keys() ^ there.keys())
    ]
    for name in sorted(here.keys() & there.keys()):
        if file_hash(here[name]) != file_hash(there[name]):
            found.append(f"{name}: the bytes differ")
            if name.endswith(ARCHIVE):
                inside = different_members(here[name], there[name])
                found += [f"  {member}" for member in inside[:SHOWN]]
    return found
