"""Builds the site: writes the pages that changed, then runs Sphinx over them."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Iterable
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.util.docutils import docutils_namespace, patch_docutils

from traceability.documents import exports, search, verification
from traceability.documents.diagrams import DiagramError
from traceability.documents.links import ROOT, depth_prefix
from traceability.documents.pages import all_pages, doxygen_file
from traceability.documents.pin_map import HEADER as PINS
from traceability.documents.pin_map import pin_map
from traceability.documents.portal import SITE, CheckText, Page, Portal
from traceability.documents.sphinx_warnings import WarningCollector
from traceability.model.schema import Finding, Model, Place

SCENARIO = Path("sim/scenario/examples/stop.scenario")
UNKNOWN_TO_BREATHE = re.compile(
    r"\s*<(satisfies|verifies|innerclass)\b.*?</\1>|<wr-[^>]*/>", re.DOTALL
)


@dataclass
class SiteResult:
    """How many pages the site has, and what Sphinx warned of."""

    pages: int
    warnings: list[Finding] = field(default_factory=list)


def build_site(root: Path, model: Model, findings: list[Finding]) -> SiteResult:
    """Brings ``build/site`` up to date with the model."""
    root = root.resolve()
    pages = root / "build" / "pages"
    try:
        portal = Portal(root, model, findings, check_texts())
        kept = write_sources(portal, pages)
    except DiagramError as error:
        mend = "correct what the diagram is made from, see the message of PlantUML"
        return SiteResult(0, [Finding(Place("design", 0), "doc-diagram", str(error), mend)])
    site = root / "build" / "site"
    with get_context("fork").Pool(1, _share, (portal, site, 1)) as pool:
        exported = pool.apply_async(_write_exports)
        warnings = run_sphinx(portal, pages)
        exported.get()
    remove_others(site, {f"{name}.html" for name in kept})
    return SiteResult(len(kept), warnings)


def check_texts() -> list[CheckText]:
    from traceability.checks.registry import CHECKS

    return [CheckText(c.id, c.title, c.why, c.holds, c.blind, c.mend) for c in CHECKS]


# ---- what Sphinx reads -------------------------------------------------------


def write_sources(portal: Portal, pages: Path) -> set[str]:
    """Writes generated and hand-written pages below the source folder; returns their names."""
    kept = write_pages(portal, pages) | copy_docs(portal.root / "docs", pages)
    write_included(portal.root, pages / "_generated")
    copy_doxygen(portal, pages / "_doxygen")
    write_changed(pages / "links.json", json.dumps(search.targets(portal), sort_keys=True))
    write_changed(pages / "_static" / "portal.js", search.script(portal))
    for path in pages.rglob("*.page"):
        if str(path.relative_to(pages).with_suffix("")) not in kept:
            path.unlink()
    return kept


def write_pages(portal: Portal, pages: Path) -> set[str]:
    """Each core writes a part of the generated pages."""
    parts = os.cpu_count() or 1
    with get_context("fork").Pool(parts, _share, (portal, pages, parts)) as pool:
        return set().union(*pool.imap_unordered(_write_part, range(parts)))


# What a process is forked with: too large to be sent to it.
_shared: list[tuple[Portal, Path, int]] = []


def _share(portal: Portal, pages: Path, parts: int) -> None:
    _shared.append((portal, pages, parts))


def _write_part(part: int) -> set[str]:
    portal, pages, parts = _shared[-1]
    kept = set()
    for page in all_pages(portal, part, parts):
        kept.add(page.name)
        write_changed(pages / f"{page.name}.page", source_of(page))
    return kept


def write_included(root: Path, target: Path) -> None:
    """What hand-written pages include from other folders of the project."""
    if (root / PINS).exists():
        write_changed(target / "pin_map.csv", pin_map(root))
    if (root / SCENARIO).exists():
        write_changed(target / "example.scenario", (root / SCENARIO).read_bytes())


def source_of(page: Page) -> str:
    """The facts about a page in one line, then its body, with links that fit its place."""
    facts = {"title": page.title, "nav": page.nav, "wide": page.wide, "api": page.api}
    body = page.body.replace(f'"{ROOT}', f'"{depth_prefix(page.name)}')
    return f"{json.dumps(facts)}\n{body}"


def copy_doxygen(portal: Portal, target: Path) -> None:
    """What Breathe needs: the classes of the modules, without what it does not know.

    Breathe reads a class again when its file is newer, so only changed files are replaced.
    """
    compounds = []
    for module in portal.designs:
        if path := doxygen_file(portal, module):
            text = UNKNOWN_TO_BREATHE.sub("", path.read_text(encoding="utf-8"))
            write_changed(target / path.name, text)
            name = f"<name>{module.qualified}</name>"
            compounds.append(f'<compound refid="{path.stem}" kind="class">{name}</compound>')
    index = f"<doxygenindex version='1.9.8'>{''.join(compounds)}</doxygenindex>"
    write_changed(target / "index.xml", index)


def copy_docs(docs: Path, pages: Path) -> set[str]:
    target = pages / "docs"
    kept = {path.relative_to(docs) for path in docs.rglob("*") if path.is_file()}
    for path in kept:
        write_changed(target / path, (docs / path).read_bytes())
    for old in target.rglob("*") if target.is_dir() else ():
        if old.is_file() and old.relative_to(target) not in kept:
            old.unlink()
    return {f"docs/{path.with_suffix('')}" for path in kept if path.suffix == ".rst"}


def write_changed(path: Path, content: str | bytes) -> None:
    """Writes a file unless it has this content: Sphinx reads again what is newer."""
    data = content.encode() if isinstance(content, str) else content
    if path.is_file() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


# ---- Sphinx ------------------------------------------------------------------


def run_sphinx(portal: Portal, pages: Path) -> list[Finding]:
    root = portal.root
    collector = WarningCollector(root, pages)
    state = root / "build" / "pages-cache" / "sphinx"
    with patch_docutils(), docutils_namespace():
        app = Sphinx(
            srcdir=pages,
            confdir=SITE,
            outdir=root / "build" / "site",
            doctreedir=state,
            buildername="html",
            status=None,
            warning=collector,
            parallel=os.cpu_count() or 1,
            confoverrides={
                "html_context": {"groups": portal.navigation.data()},
                "html_static_path": [str(pages / "_static")],
                "breathe_projects": {"firmware": str(pages / "_doxygen")},
            },
        )
        app.build()
    return collector.findings()


def _write_exports() -> None:
    portal, site, _ = _shared[-1]
    write_exports(portal, site)
    verification.write_exports(portal.root, site, portal.model)


def write_exports(portal: Portal, site: Path) -> None:
    """The files that the page of exports leads to."""
    files = exports.diagram_files(portal.diagrams)
    for path in (site / exports.DIAGRAMS).glob("*.puml"):
        if f"{exports.DIAGRAMS}/{path.name}" not in files:
            path.unlink()
    files[exports.MODEL] = exports.model_text(portal.model)
    files[exports.SCHEMA] = exports.schema_text()
    for name, text in files.items():
        write_changed(site / name, text)


def remove_others(site: Path, kept: Iterable[str]) -> None:
    """Removes the pages of modules, requirements and files that are no more."""
    names = set(kept)
    for path in site.rglob("*.html"):
        if str(path.relative_to(site)) not in names:
            path.unlink()
    shutil.rmtree(site / "_sources", ignore_errors=True)
