"""Builds the site: each core writes a part of the pages, while Sphinx makes its own."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path

from traceability.documents import exports, verification
from traceability.documents.diagrams import DiagramError
from traceability.documents.layout import Layout
from traceability.documents.pages import all_pages
from traceability.documents.portal import CheckText, Portal
from traceability.documents.sphinx_pages import run_sphinx, write_sources
from traceability.documents.writing import remove_others, write_changed
from traceability.model.schema import Finding, Model, Place

PARTS = 8  # of the pages: more than cores, so that none waits long for another


@dataclass
class SiteResult:
    """How many pages the site has, and what Sphinx warned of."""

    pages: int
    warnings: list[Finding] = field(default_factory=list)


def build_site(root: Path, model: Model, findings: list[Finding]) -> SiteResult:
    """Brings ``build/site`` up to date with the model."""
    root = root.resolve()
    pages, site = root / "build" / "pages", root / "build" / "site"
    try:
        portal = Portal(root, model, findings, check_texts())
    except DiagramError as error:
        mend = "correct what the diagram is made from, see the message of PlantUML"
        return SiteResult(0, [Finding(Place("design", 0), "doc-diagram", str(error), mend)])
    kept = write_sources(portal, pages)
    with get_context("fork").Pool(os.cpu_count() or 1, _share, (portal, site)) as pool:
        exported = pool.apply_async(_write_exports)
        written = pool.map_async(_write_part, range(PARTS), 1)
        warnings = run_sphinx(portal, pages, site)
        kept = kept.union(*written.get())
        exported.get()
    remove_others(site, "*.html", [f"{name}.html" for name in kept])
    shutil.rmtree(site / "_sources", ignore_errors=True)
    return SiteResult(len(kept), warnings)


def check_texts() -> list[CheckText]:
    from traceability.checks.registry import CHECKS

    return [CheckText(c.id, c.title, c.why, c.holds, c.blind, c.mend) for c in CHECKS]


# What a process is forked with: too large to be sent to it.
_shared: list[tuple[Portal, Path]] = []


def _share(portal: Portal, site: Path) -> None:
    _shared.append((portal, site))


def _write_part(part: int) -> set[str]:
    portal, site = _shared[-1]
    layout = Layout(portal.navigation)
    kept = set()
    for page in all_pages(portal, part, PARTS):
        kept.add(page.name)
        write_changed(site / f"{page.name}.html", layout.html(page))
    return kept


def _write_exports() -> None:
    portal, site = _shared[-1]
    write_exports(portal, site)
    verification.write_exports(portal.root, site, portal.model)


def write_exports(portal: Portal, site: Path) -> None:
    """The files that the page of exports leads to."""
    files = exports.diagram_files(portal.diagrams)
    kept = [name.rpartition("/")[2] for name in files]
    remove_others(site / exports.DIAGRAMS, "*.puml", kept)
    files[exports.MODEL] = exports.model_text(portal.model)
    files[exports.SCHEMA] = exports.schema_text()
    for name, text in files.items():
        write_changed(site / name, text)
