"""The pages that Sphinx makes: the hand-written ones, and Doxygen's view of each class."""

from __future__ import annotations

import json
import re
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.util.docutils import docutils_namespace, patch_docutils

from traceability.documents import search
from traceability.documents.module_page import doxygen_file
from traceability.documents.pin_map import HEADER as PINS
from traceability.documents.pin_map import pin_map
from traceability.documents.portal import SITE, Portal
from traceability.documents.sphinx_warnings import WarningCollector
from traceability.documents.tables import COMMANDS, PACKAGES, command_table, package_table
from traceability.documents.writing import remove_others, write_changed
from traceability.model.schema import Finding, Module
from traceability.sources import files_below, hash_of

SCENARIO = Path("sim/scenario/examples/stop.scenario")
# What hand-written pages include from other folders: the file, its name beside them, the text.
INCLUDED = (
    (PINS, "pin_map.csv", pin_map),
    (SCENARIO, "example.scenario", lambda root: (root / SCENARIO).read_text("utf-8")),
    (COMMANDS, "commands.csv", command_table),
    (PACKAGES, "packages.csv", package_table),
)
UNKNOWN_TO_BREATHE = re.compile(
    r"\s*<(satisfies|verifies|innerclass)\b.*?</\1>|<wr-[^>]*/>", re.DOTALL
)


def write_sources(portal: Portal, pages: Path) -> set[str]:
    """Writes what Sphinx reads; returns the names of the pages."""
    shown = [m for m in portal.designs if doxygen_file(portal, m)]
    kept = copy_docs(portal.root / "docs", pages / "docs") | write_views(shown, pages / "doxygen")
    write_included(portal.root, pages / "_generated")
    copy_doxygen(portal, shown, pages / "_doxygen")
    write_changed(pages / "links.json", json.dumps(search.targets(portal), sort_keys=True))
    write_changed(pages / "_static" / "portal.js", search.script(portal))
    return kept


def copy_docs(docs: Path, target: Path) -> set[str]:
    kept = {path.relative_to(docs) for path in docs.rglob("*") if path.is_file()}
    for path in kept:
        write_changed(target / path, (docs / path).read_bytes())
    remove_others(target, "*", map(str, kept))
    return {f"docs/{path.with_suffix('')}" for path in kept if path.suffix == ".rst"}


def write_views(modules: list[Module], target: Path) -> set[str]:
    """A page for Doxygen's view of each class, and one that leads to them."""
    texts = {module.name: view_of(module) for module in modules}
    lines = "".join(f"   * :doc:`{name} <{name}>`\n" for name in sorted(texts))
    texts["index"] = (
        f"{headline('Members, by Doxygen')}"
        ".. container:: columns\n\n"
        "   The members of each class, as Doxygen reads them.\n\n"
        f"{lines}"
    )
    for name, text in texts.items():
        write_changed(target / f"{name}.rst", text)
    remove_others(target, "*.rst", [f"{name}.rst" for name in texts])
    return {f"doxygen/{name}" for name in texts}


def view_of(module: Module) -> str:
    return (
        f"{headline(f'{module.name}, by Doxygen')}"
        f"The members of :module:`{module.name}`, as Doxygen reads them.\n\n"
        ".. container:: api\n\n"
        f"   .. doxygenclass:: {module.qualified}\n"
        "      :members:\n"
        "      :protected-members:\n"
    )


def headline(title: str) -> str:
    return f"{title}\n{'=' * len(title)}\n\n"


def write_included(root: Path, target: Path) -> None:
    """What hand-written pages include from other folders of the project."""
    for source, name, text_of in INCLUDED:
        if (root / source).exists():
            write_changed(target / name, text_of(root))


def copy_doxygen(portal: Portal, modules: list[Module], target: Path) -> None:
    """What Breathe needs: the classes of the modules, without what it does not know.

    Breathe reads a class again when its file is newer, so only changed files are replaced.
    """
    compounds = []
    for module in modules:
        if path := doxygen_file(portal, module):
            text = UNKNOWN_TO_BREATHE.sub("", path.read_text(encoding="utf-8"))
            write_changed(target / path.name, text)
            name = f"<name>{module.qualified}</name>"
            compounds.append(f'<compound refid="{path.stem}" kind="class">{name}</compound>')
    index = f"<doxygenindex version='1.9.8'>{''.join(compounds)}</doxygenindex>"
    write_changed(target / "index.xml", index)


def run_sphinx(portal: Portal, pages: Path, site: Path) -> list[Finding]:
    cache = portal.root / "build" / "pages-cache"
    sound = cache / "sound-docs"  # names what was read without a warning
    docs = hash_of(pages, files_below(pages, ("docs", "_generated", "links.json")))
    collector = WarningCollector(portal.root, pages)
    with patch_docutils(), docutils_namespace():
        app = Sphinx(
            srcdir=pages,
            confdir=SITE,
            outdir=site,
            doctreedir=cache / "sphinx",
            buildername="html",
            status=None,
            warning=collector,
            confoverrides={
                "html_context": {"groups": portal.navigation.data()},
                "html_static_path": [str(pages / "_static")],
                "breathe_projects": {"firmware": str(pages / "_doxygen")},
                "read_all_docs": not sound.exists() or sound.read_text() != docs,
            },
        )
        app.build()
    found = collector.findings()
    write_changed(sound, "" if found else docs)
    return found
