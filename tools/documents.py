"""Makes the documents in a separate process, in four steps: the model, the checks, the site, and
the check of the links.

The last two steps take most of the time. ``./wr check`` skips them if they had no finding for the
last pages, and if no text or name on the pages has changed since. The pages then stay as they are,
until a command needs new pages."""

from __future__ import annotations

import gc
import hashlib
import json
import subprocess
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from tools.steps import FailureError, Steps, stoppable
from traceability.exports.revision import revision_of, write_revision
from traceability.reading.build_evidence import git
from traceability.reading.plain_constants import plain_constants
from traceability.reading.results import METRICS, TIMES, read_json
from traceability.schema import Finding, Place
from traceability.whole_file import write_whole

if TYPE_CHECKING:
    from traceability.model.build import Built
    from traceability.model.design_model import Model
    from traceability.model.report import Report

FINDINGS = Path("build/model/findings.json")
# This file exists if the pages were built together with the last checks, from the same sources.
CURRENT = Path("build/pages-cache/current")
# The texts and names with which the pages were built. The file exists only if the last two steps
# had no finding.
LINKED = Path("build/pages-cache/linked")
KEEP = "keep"  # argument of the process
INCOMPLETE = 3  # exit code of the process; a Python error ends the process with 1
PARTS = ("model", "checks", "site", "links")


def make_documents(root: Path, out: TextIO, texts: str, log: TextIO, *, keep: bool = False) -> str:
    """Builds the documents in four steps. Prints each output line of a step immediately.

    The steps run in a separate process, which frees its memory when it ends. A command that
    continues for a long time therefore does not occupy this memory.

    Some inputs of the pages are not read into the model. ``texts`` is the hash of these inputs.
    If ``keep`` is true, the pages stay as they are until one of these inputs or a name in the model
    changes."""
    words = [sys.executable, "-m", "tools.documents", str(root), texts, *([KEEP] if keep else [])]
    with (
        subprocess.Popen(
            words, stdout=subprocess.PIPE, stderr=log, text=True, cwd=root, process_group=0
        ) as made,
        stoppable(made),
    ):
        assert made.stdout is not None
        for line in made.stdout:
            log.write(line)
            print(line, end="", file=out, flush=True)
    if made.returncode == INCOMPLETE:
        raise FailureError("a step failed; see its message above")
    if made.returncode != 0:
        (root / FINDINGS).unlink(missing_ok=True)  # This file belongs to earlier documents.
        raise FailureError(f"the process of the documents ended early, with code {made.returncode}")
    return counted(read_findings(root) or [])


def read_findings(root: Path) -> list[Finding] | None:
    """Returns the findings of the last documents. Returns None if their process ended early."""
    records = read_json(root / FINDINGS)
    if records is None:
        return None
    return [Finding(**{**record, "place": Place(**record["place"])}) for record in records]


def write_time(root: Path, name: str, seconds: float) -> None:
    """Records the duration of a command, and adds it to the metrics."""
    add_metrics(root, {name: round(seconds, 1)}, TIMES, METRICS)


def add_metrics(root: Path, value: dict[str, float], *files: Path) -> None:
    """Adds numbers to the metrics of the documents. The numbers were measured after the documents
    were built."""
    for path in (root / name for name in files or (METRICS,)):
        metrics = read_json(path)
        text = json.dumps((metrics or {}) | value, indent=1, sort_keys=True)
        write_whole(path, f"{text}\n")


def main(root: Path, texts: str, *, keep: bool) -> int:
    """Runs the process. Returns INCOMPLETE if a step failed, and otherwise 0. Findings do not
    change this exit code."""
    # Garbage collection would take a fifth of the time. The process keeps the model until its end:
    # there is nothing to collect.
    gc.disable()
    findings, complete = make(root, Steps(root, len(PARTS)), Pages(root, texts, keep))
    write_whole(root / FINDINGS, json.dumps([asdict(finding) for finding in findings]))
    gc.freeze()
    return 0 if complete else INCOMPLETE


def make(root: Path, steps: Steps, pages: Pages) -> tuple[list[Finding], bool]:
    """Returns the findings. The second value is false if a step failed, and otherwise true."""
    from portal.site_build import build_site, write_tool_files
    from traceability.checks import run_checks, run_link_checks
    from traceability.exports.metrics_file import site_figures, write_metrics
    from traceability.model.build import build

    built: Built
    report: Report
    findings: list[Finding] = []

    def make_model(_log: TextIO) -> str:
        nonlocal built
        try:
            built = build(root)
        except UnicodeDecodeError as error:
            from traceability.checks.document_checks import not_text

            findings.extend(not_text(root))
            raise FailureError("a file is not UTF-8") from error
        return f"{len(built.model.modules)} modules, {len(built.model.requirements)} requirements"

    def run_all(_log: TextIO) -> str:
        nonlocal report
        report = run_checks(*built)
        findings.extend(report.findings)
        return counted(findings)

    def make_site(_log: TextIO) -> str:
        result = build_site(root, built.model, report)
        findings.extend(result.warnings)
        return f"{result.pages} pages"

    def check_links(_log: TextIO) -> str:
        site = root / "build" / "site"
        dead_links = run_link_checks(*built, site)
        findings.extend(dead_links)
        measured = site_figures(site, findings)
        metrics = write_metrics(root, built.model, report, measured)
        record_revision(root, built.model, report, metrics)
        return counted(dead_links)

    if not steps.run("model", make_model):
        for title in PARTS[1:]:
            steps.skip(title, "there is no model")
        return findings, False
    checked = steps.run("checks", run_all)
    if not checked or is_unreadable(built):
        missing = "a file of the design cannot be read" if checked else "there are no verdicts"
        for title in PARTS[2:]:
            steps.skip(title, missing)
        return findings, False
    if pages.stay(built.model):
        write_tool_files(root, built.model, report)
        for title in PARTS[2:]:
            steps.skip(title, "no text or name on the pages changed; ./wr portal updates the pages")
        return findings, True
    before = len(findings)
    if not steps.run("site", make_site):
        steps.skip("links", "the site was not built")
        return findings, False
    complete = steps.run("links", check_links)
    if complete:
        pages.built(sound=len(findings) == before)
    return findings, complete


@dataclass
class Pages:
    """The pages of the last run. ``keep`` is true if the pages may stay as they are."""

    root: Path
    texts: str
    keep: bool
    linked: str = ""

    def stay(self, model: Model) -> bool:
        """Returns true if the pages may stay as they are, because their links and warnings cannot
        have changed. Returns false if the pages must be built."""
        self.linked = linked_by(self.root, model, self.texts)
        last = self.root / LINKED
        same = self.keep and last.exists() and last.read_text(encoding="utf-8") == self.linked
        (self.root / CURRENT).unlink(missing_ok=True)
        if not same:
            last.unlink(missing_ok=True)
        return same

    def built(self, *, sound: bool) -> None:
        """Records that the pages were built. ``sound`` means that they had no finding."""
        write_whole(self.root / CURRENT, "")
        if sound:
            write_whole(self.root / LINKED, self.linked)


def linked_by(root: Path, model: Model, texts: str) -> str:
    """Returns a hash of everything that a link of a page can depend on: the texts and the names."""
    names: list[object] = [texts, sorted(model.files)]
    names += [[module.name, *(m.id for m in module.methods)] for module in model.modules.values()]
    names += [list(model.requirements), list(model.tests), list(model.patterns)]
    names += [list(model.machines), list(model.safety.goals), list(model.safety.hazards)]
    names += [sorted(model.constants), sorted(plain_constants(root)), sorted(model.logic_modules)]
    return hashlib.sha256(json.dumps(names).encode()).hexdigest()


def record_revision(root: Path, model: Model, report: Report, metrics: Path) -> None:
    """Records the verdicts and sizes for ./wr diff, if no file differs from the commit."""
    commit = git(root, "rev-parse", "HEAD").strip()
    if commit and not git(root, "status", "--porcelain"):
        write_revision(root, revision_of(model, commit, report, read_json(metrics) or {}))


def is_unreadable(built: Built) -> bool:
    """Returns whether a file of design/ could not be read. Every page would then be incomplete."""
    return bool(built.facts.declared.entries.unreadable)


def counted(findings: list[Finding]) -> str:
    return "1 finding" if len(findings) == 1 else f"{len(findings)} findings"


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2], keep=KEEP in sys.argv[3:]))
