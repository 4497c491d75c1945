"""Builds the site. Several processes write the bodies of the generated pages. At the same time,
Sphinx reads the hand-written pages. Then Sphinx writes all pages."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import chain
from multiprocessing import get_context
from pathlib import Path

from portal.diagrams import DIAGRAMS, DiagramError, diagram_files
from portal.live_view import write_live
from portal.pages import all_pages
from portal.portal import Page, Portal
from portal.sphinx_pages import BODIES, body_file, run_sphinx, write_sources
from portal.writing import remove_others, write_changed
from traceability.checks.registry import CHECKS
from traceability.exports import model_json, verification_table
from traceability.exports.tool_files import available
from traceability.model.design_model import Model
from traceability.model.report import Report
from traceability.schema import Finding, Place

# Number of parts into which the pages are divided. If there are more parts than cores, all cores
# finish at nearly the same time.
PARTS = 8


@dataclass
class SiteResult:
    """The number of pages of the site, and the warnings of Sphinx."""

    pages: int
    warnings: list[Finding] = field(default_factory=list)


def build_site(root: Path, model: Model, report: Report) -> SiteResult:
    """Updates ``build/site`` from the model and its verdicts."""
    root = root.resolve()
    pages, site = root / "build" / "pages", root / "build" / "site"
    try:
        portal = Portal(root, model, report, CHECKS)
    except DiagramError as error:
        fix = "correct the source of the diagram, see the message of PlantUML"
        return SiteResult(0, [Finding(Place("design", 0), "doc-diagram", str(error), fix)])
    pages_written = write_sources(portal, pages)
    with get_context("fork").Pool(os.cpu_count() or 1, _share, (portal, site)) as pool:
        exported = pool.apply_async(_write_exports)
        written = pool.map_async(partial(_write_part, pages / BODIES), range(PARTS), 1)
        warnings = run_sphinx(portal, pages, site, lambda: list(chain(*written.get())))
        made = {page.name for page in chain(*written.get())}
        exported.get()
    remove_others(pages / BODIES, "*.html", [f"{name}.html" for name in made])
    pages_written |= made
    remove_others(site, "*.html", [f"{name}.html" for name in pages_written])
    shutil.rmtree(site / "_sources", ignore_errors=True)
    return SiteResult(len(pages_written), warnings)


# A forked process inherits these data. They are too large to be sent to the process.
_shared: list[tuple[Portal, Path]] = []


def _share(portal: Portal, site: Path) -> None:
    _shared.append((portal, site))


def _write_part(bodies: Path, part: int) -> list[Page]:
    """Writes the bodies of a part of the pages. Returns these pages without their bodies."""
    portal, _ = _shared[-1]
    made = []
    for page in all_pages(portal, part, PARTS):
        write_changed(body_file(bodies, page.name), page.body)
        made.append(replace(page, body=""))
    return made


def _write_exports() -> None:
    portal, site = _shared[-1]
    write_exports(portal, site)
    write_live(portal, site)


def write_exports(portal: Portal, site: Path) -> None:
    """Writes the files that are listed on the page "Exports"."""
    files = diagram_files(portal.diagrams)
    names_written = [name.rpartition("/")[2] for name in files]
    remove_others(site / DIAGRAMS, "*.puml", names_written)
    files[model_json.MODEL] = model_json.model_text(portal.model, portal.report)
    files[model_json.SCHEMA] = model_json.schema_text()
    files[verification_table.SCHEMA] = verification_table.schema_text()
    for name, text in files.items():
        write_changed(site / name, text)
    write_tool_files(portal.root, portal.model, portal.report)


def write_tool_files(root: Path, model: Model, report: Report) -> None:
    """Writes the files for other tools. They do not depend on the pages."""
    site = root / "build" / "site"
    for file in available(root):
        write_changed(site / file.name, file.make(root, model, report))
    verification_table.write_exports(root, site, model, report)
