"""Inserts the seeded faults in copies of the project, checks the copies, and records the
findings."""

from __future__ import annotations

import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import FIRST_EXCEPTION, Future, ProcessPoolExecutor, wait
from multiprocessing import get_context
from pathlib import Path

from portal.site_build import build_site
from tools.steps import UsageError
from traceability.checks import message, run_checks, run_link_checks
from traceability.model.build import build, commit
from traceability.reading.seeded_faults import (
    COMPILER,
    SOURCES,
    Fault,
    Outcome,
    read_faults,
    write_record,
)
from traceability.schema import Finding

# Greatest distance from the expected line to the line of the finding, in source lines. A finding
# about a declaration may point to the comment above the declaration.
NEAR = 2
WORKERS = 2
PROGRESS = 30.0  # time between two messages about the progress [s]
BUILT = ("build/model", "build/results", "build/tasks.json")
FORK = get_context("fork")
tried = FORK.Value("i", 0)  # number of faults that were tried; all workers increase this number
# These folders are only read.
LINKED = (
    "build/trace",
    "build/host",
    "build/k64",
    "build/k64_calls",
    "build/calls",
)
PAGES = ("build/pages", "build/pages-cache", "build/site", "build/diagrams")


def seed_all(root: Path) -> list[Outcome]:
    """Inserts every fault that can be tried, and writes the record. Some faults need test results
    of the present sources, and others need built pages."""
    faults = read_faults(root)
    fresh = not build(root).model.results_stale
    stages = {"sources"} | ({"results"} if fresh else set())
    if (root / PAGES[2]).is_dir():
        stages |= {"pages", "site"}
    possible = [fault for fault in faults if fault.stage in stages]
    outcomes = list(_outcomes(root, possible))
    write_record(root, outcomes, len(faults) - len(possible), commit(root))
    return outcomes


def seed(root: Path, checks: list[str]) -> list[Outcome]:
    """Inserts the faults of some checks. Writes no record, because a record contains all faults."""
    faults = read_faults(root)
    unknown = sorted(set(checks) - {fault.check for fault in faults})
    if unknown:
        raise UsageError(f"there is no seeded fault for the check {', '.join(unknown)}")
    return list(_outcomes(root, [fault for fault in faults if fault.check in checks]))


def _outcomes(root: Path, faults: list[Fault]) -> Iterator[Outcome]:
    """Yields the outcome of each fault. For each stage, the groups of faults are divided among
    several copies of the project, which are checked in parallel."""
    tried.value = 0
    with (
        tempfile.TemporaryDirectory(prefix="drift-") as folder,
        ProcessPoolExecutor(WORKERS, mp_context=FORK) as pool,
    ):
        work = []
        for stage in dict.fromkeys(fault.stage for fault in faults):
            groups = grouped([fault for fault in faults if fault.stage == stage])
            parts = min(WORKERS, len(groups))
            work += [
                (root, Path(folder) / f"{stage}{part}", stage, groups[part::parts])
                for part in range(parts)
            ]
        parts_done = [pool.submit(_seed_part, *part) for part in work]
        _show_progress(parts_done, len(faults))
        done = {outcome.name: outcome for part in parts_done for outcome in part.result()}
    yield from (done[fault.name] for fault in faults)


def _show_progress(parts: list[Future[list[Outcome]]], faults: int) -> None:
    """Prints the progress periodically: the number of faults that were tried. Returns when all
    parts have ended, or when an error has occurred in a part."""
    start = time.monotonic()
    while wait(parts, PROGRESS, FIRST_EXCEPTION).not_done:
        if any(part.done() and part.exception() for part in parts):
            return
        seconds = time.monotonic() - start
        print(
            f"        {tried.value} of {faults} faults tried, {seconds:.0f} s",
            file=sys.__stdout__,
            flush=True,
        )


def grouped(faults: list[Fault]) -> list[list[Fault]]:
    """Returns groups of faults. No two faults of a group change the same file. The faults of a
    group are inserted together, because their findings can be distinguished.

    A fault in code that does not compile would hide the other faults. It is therefore checked
    alone."""
    alone = [[fault] for fault in faults if not fault.compiles]
    groups: list[tuple[set[str], list[Fault]]] = []
    for fault in faults:
        if not fault.compiles:
            continue
        files = {fault.place, *(edit.file for edit in fault.edits)}
        taken, group = next((group for group in groups if not group[0] & files), (set(), []))
        if not group:
            groups.append((taken, group))
        taken |= files
        group.append(fault)
    return [group for _, group in groups] + alone


def _seed_part(root: Path, tree: Path, stage: str, groups: list[list[Fault]]) -> list[Outcome]:
    copy = Copy(root, tree, stage)
    outcomes = []
    for group in groups:
        outcomes += copy.seed(group)
        with tried.get_lock():
            tried.value += len(group)
    return outcomes


class Copy:
    """A copy of the project, in which faults are inserted and removed."""

    def __init__(self, root: Path, tree: Path, stage: str) -> None:
        self.tree = tree
        self.stage = stage
        for name in SOURCES:
            copy_part(root, tree, name)
        if stage == "sources":
            copy_part(root, tree, "build/model")
        else:
            for name in (*BUILT, *PAGES):
                copy_part(root, tree, name)
            for name in LINKED:
                if (root / name).exists():
                    (tree / name).symlink_to(root / name)
        self.before = {_key(finding) for finding in self.findings()}
        self.cache = {path: path.read_bytes() for path in self._cached()}
        self.stamps = self._stamps()

    def findings(self) -> list[Finding]:
        if self.stage == "site":
            return run_link_checks(*build(self.tree), self.tree / "build" / "site")
        model, facts = build(self.tree)
        report = run_checks(model, facts)
        made = build_site(self.tree, model, report).warnings if self.stage == "pages" else []
        return [*report.findings, *made]

    def seed(self, faults: list[Fault]) -> list[Outcome]:
        """Inserts the faults together. If faults were not found, inserts these faults again, in two
        halves.

        A fault can hide all other faults of the group, for example if it makes a file of the design
        unreadable. The halves separate this fault from the other faults in a few runs."""
        outcomes = {
            fault.name: outcome for fault, outcome in zip(faults, self._seed(faults), strict=True)
        }
        missed = [fault for fault in faults if not outcomes[fault.name].caught]
        if len(faults) > 1:
            middle = (len(missed) + 1) // 2
            for half in filter(None, (missed[:middle], missed[middle:])):
                outcomes |= {outcome.name: outcome for outcome in self.seed(half)}
        return [outcomes[fault.name] for fault in faults]

    def _seed(self, faults: list[Fault]) -> list[Outcome]:
        edits = [edit for fault in faults for edit in fault.edits]
        before = {edit.file: _content(self.tree / edit.file) for edit in edits}
        new: list[Finding] = []
        lines = [0] * len(faults)
        error: list[str] = []
        try:
            for number, fault in enumerate(faults):
                changed = [edit.apply(self.tree) for edit in fault.edits]
                lines[number] = fault.expected_line(self.tree, changed[0])
            new = [finding for finding in self.findings() if _key(finding) not in self.before]
        except Exception as problem:  # An error in the project's tools is also an outcome.
            error = [f"{type(problem).__name__}: {problem}"]
        finally:
            self._restore(before)
        return [_outcome(*pair, new, error) for pair in zip(faults, lines, strict=True)]

    def _cached(self) -> list[Path]:
        """Returns the cached files of the copy. The result does not contain the messages of
        Doxygen, because these messages belong to the XML of Doxygen."""
        files = sorted((self.tree / "build" / "model").rglob("*.*"))
        kinds = (".json", ".facts", ".pickle")
        return [path for path in files if path.suffix in kinds and path.name != "doxygen.json"]

    def _stamps(self) -> dict[Path, int]:
        return {path: path.stat().st_mtime_ns for path in self._cached()}

    def _restore(self, before: dict[str, bytes | None]) -> None:
        """Restores the files, together with their parsed content. No file is then parsed twice."""
        for file, content in before.items():
            if content is None:
                (self.tree / file).unlink(missing_ok=True)
            else:
                (self.tree / file).write_bytes(content)
        now = self._stamps()
        for path, content in self.cache.items():
            if now.get(path) != self.stamps[path]:
                path.write_bytes(content)
        for path in set(now) - set(self.cache):
            path.unlink()
        self.stamps = self._stamps()


def _outcome(fault: Fault, line: int, new: list[Finding], error: list[str]) -> Outcome:
    right = [
        finding
        for finding in new
        if finding.check == fault.check
        and finding.place.file == fault.place
        and abs(finding.place.line - line) <= NEAR
    ]
    compiles = not any(finding.check == COMPILER for finding in new)
    return Outcome(
        name=fault.name,
        check=fault.check,
        says=fault.says,
        file=fault.place,
        line=line,
        caught=bool(right) and compiles == fault.compiles,
        compiles=compiles,
        said=error or [message(finding) for finding in right or new],
    )


def _key(finding: Finding) -> tuple[str, int, str, str]:
    return finding.place.file, finding.place.line, finding.check, finding.text


def _content(path: Path) -> bytes | None:
    return path.read_bytes() if path.is_file() else None


def copy_part(root: Path, tree: Path, name: str) -> None:
    """Copies a part of the project, without the precompiled library. This library contains the path
    of its folder. Therefore each copy builds the library again."""
    source, target = root / name, tree / name
    if source.is_dir():
        ignored = shutil.ignore_patterns("python", "standard*", "__pycache__", "xml")
        shutil.copytree(source, target, ignore=ignored if "site" not in name else None)
    elif source.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, target)
