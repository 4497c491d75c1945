"""Sphinx writes all pages: the hand-written pages, and the pages whose bodies come from
templates."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from html import escape
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.docutils import docutils_namespace, patch_docutils

from portal import search
from portal.board_figure import board_figure
from portal.frame_tables import TABLE, frame_tables, live_frames
from portal.links import ROOT, depth_prefix
from portal.module_page import MEMBERS, doxygen_file
from portal.package_diagram import PACKAGES
from portal.pin_map import HEADER as PINS
from portal.pin_map import pin_map
from portal.portal import Page, Portal
from portal.sphinx_extension import NAMES
from portal.sphinx_warnings import WarningCollector
from portal.tables import TABLES, measures_table
from portal.templates import SITE
from portal.writing import remove_others, write_changed
from traceability.schema import Finding, Module
from traceability.sources import files_below, hash_of

EXAMPLE_TEST = Path("tests/wheel_control/algorithms/PiRegulatorTest.cpp")
EXAMPLE_FIXTURE = Path("tests/sensing/position/DirSensorTest.cpp")
SCENARIO = Path("sim/scenario/examples/stop.scenario")
CHANGES = Path("CHANGELOG.md")
CONTRIBUTING = Path("CONTRIBUTING.md")
README = Path("README.md")
BUILD = Path("CMakeLists.txt")
TOOLCHAIN = Path("setup/k64-toolchain.cmake")
IMAGES = Path("src/k64/CMakeLists.txt")
IDENTITY = Path("src/CMakeLists.txt")


def sections(root: Path, path: Path) -> str:
    """Returns the sections of a file in Markdown, without the title of the file. A page in
    ``docs/`` includes these sections."""
    text = (root / path).read_text("utf-8").partition("\n")[2]
    return text.replace("\n## ", "\n# ").replace("](docs/", "](/docs/")


def folder_table(root: Path) -> str:
    """Returns the table in the README that lists the folders of the project."""
    text = (root / README).read_text("utf-8")
    return text.partition("\n## Folders\n\n")[2].partition("\n\n")[0] + "\n"


def first_test(root: Path) -> str:
    """Returns the example of a test: the source file with only its first test."""
    text = (root / EXAMPLE_TEST).read_text("utf-8")
    head, first, *_ = text.split("\n/// @brief ")
    end = text[text.rindex("}  // namespace\n") :]
    return f"{head}\n/// @brief {first}\n{end}"


def fixture(root: Path) -> str:
    """Returns the example of a fixture."""
    begin, end = "class DirSensorTest", "\n};\n"
    text = (root / EXAMPLE_FIXTURE).read_text("utf-8")
    return f"{begin}{text.partition(begin)[2].partition(end)[0]}{end}"


def compiler_options(root: Path) -> str:
    """Returns the compiler options of a firmware image, as excerpts from the CMake files."""
    parts = (
        (TOOLCHAIN, "set(CMAKE_CXX_FLAGS_INIT", "\n#"),
        (BUILD, "set(CMAKE_CXX_STANDARD 20)", "\nset(CMAKE_EXPORT"),
        (BUILD, "add_library(common_options", "\n\n"),
        (BUILD, "add_library(firmware_options", "if(WR_TRACE)"),
        (IMAGES, "set(in_flash", "\n#"),
        (IMAGES, "  target_link_options(${name} PRIVATE", "\n  add_custom_command"),
        (IDENTITY, "set_property(SOURCE ${identity} PROPERTY COMPILE_OPTIONS", "\n"),
    )
    blocks = []
    for path, begin, end in parts:
        after = (root / path).read_text("utf-8").partition(begin)[2]
        blocks.append(f"# {path}\n{begin}{after.partition(end)[0].rstrip()}\n")
    return "\n".join(blocks)


# Files that hand-written pages include. Each entry has the source file, the name of the generated
# file in the folder of the pages, and the function that returns the text of the generated file.
INCLUDED = (
    (PINS, "pin_map.csv", pin_map),
    (PINS, "board.html", board_figure),
    (TABLE, "live_frames.html", live_frames),
    (EXAMPLE_TEST, "example_test.cpp", first_test),
    (EXAMPLE_FIXTURE, "example_fixture.cpp", fixture),
    (SCENARIO, "example.scenario", lambda root: (root / SCENARIO).read_text("utf-8")),
    (CHANGES, "changes.md", lambda root: sections(root, CHANGES)),
    (CONTRIBUTING, "contributing.md", lambda root: sections(root, CONTRIBUTING)),
    (README, "folders.md", folder_table),
    (TOOLCHAIN, "compiler_options.txt", compiler_options),
    *TABLES,
)
FRAME = "frame.txt"  # file with the layout and the navigation that surround each body
INDEX = "search_index.js"
BODIES = "_bodies"  # folder below the pages: bodies from templates, without the layout
# Matches XML elements that Doxygen writes and that Breathe does not support.
UNKNOWN_TO_BREATHE = re.compile(r"\s*<(satisfies|verifies|innerclass)\b.*?</\1>", re.DOTALL)


def write_sources(portal: Portal, pages: Path) -> set[str]:
    """Writes the files that Sphinx reads. Returns the names of the pages among these files."""
    shown = [m for m in portal.designs if doxygen_file(portal, m)]
    current = copy_docs(portal.root / "docs", pages / "docs") | write_members(shown, pages)
    remove_others(pages, "*.rst", [f"{name}.rst" for name in current])
    write_included(portal, pages / "_generated")
    # This file changes often. Sphinx then reads only the page that includes it.
    write_changed(pages / "_measures" / "measures.inc", measures_table(portal.metrics))
    copy_doxygen(portal, shown, pages / "_doxygen")
    write_changed(pages / NAMES, json.dumps(search.inventory(search.entries(portal))))
    write_changed(pages / "links.json", json.dumps(search.targets(portal), sort_keys=True))
    write_changed(pages / "_static" / "portal.js", search.script(portal))
    return current


def copy_docs(docs: Path, target: Path) -> set[str]:
    current = {path.relative_to(docs) for path in docs.rglob("*") if path.is_file()}
    for path in current:
        write_changed(target / path, (docs / path).read_bytes())
    remove_others(target, "*", map(str, current))
    return {f"docs/{path.with_suffix('')}" for path in current if path.suffix == ".rst"}


def write_members(modules: list[Module], pages: Path) -> set[str]:
    """Writes a source file for each module. From this file, Breathe generates a section for the
    module's page. The section lists the members of the class."""
    for module in modules:
        write_changed(
            pages / "modules" / f"{module.name}.rst",
            ".. container:: api\n\n"
            f"   .. doxygenclass:: {module.qualified}\n"
            "      :members:\n"
            "      :protected-members:\n",
        )
    return {f"modules/{module.name}" for module in modules}


def write_included(portal: Portal, target: Path) -> None:
    """Writes the files that hand-written pages include, and the drawing of the packages."""
    root = portal.root
    if PACKAGES in portal.drawn:
        write_changed(target / f"{PACKAGES}.svg", portal.drawn[PACKAGES])
    for source, name, text_of in INCLUDED:
        if (root / source).exists():
            write_changed(target / name, text_of(root))
    for name, text in frame_tables(root).items():
        write_changed(target / name, text)


def copy_doxygen(portal: Portal, modules: list[Module], target: Path) -> None:
    """Writes the input of Breathe: the classes of the modules, without elements that Breathe does
    not support.

    Breathe reads a class again if its file is newer. Therefore only changed files are replaced."""
    compounds = []
    for module in modules:
        if path := doxygen_file(portal, module):
            text = UNKNOWN_TO_BREATHE.sub("", path.read_text(encoding="utf-8"))
            write_changed(target / path.name, text)
            name = f"<name>{module.qualified}</name>"
            compounds.append(f'<compound refid="{path.stem}" kind="class">{name}</compound>')
    index = f"<doxygenindex version='1.9.8'>{''.join(compounds)}</doxygenindex>"
    write_changed(target / "index.xml", index)


class GeneratedPages:
    """The pages whose bodies come from templates. Sphinx inserts each body into the layout.

    The page of a module also contains the members of its class, which Breathe generates. ``made()``
    waits until the folder ``bodies`` contains all bodies. Then ``made()`` returns the pages."""

    def __init__(
        self, bodies: Path, frame: str, site: Path, made: Callable[[], list[Page]]
    ) -> None:
        self.bodies = bodies
        self.frame = bodies / FRAME
        self.site = site
        self.made = made
        self.pages: dict[str, Page] = {}
        write_changed(self.frame, frame)

    def changed(self, _app: Sphinx, env: BuildEnvironment) -> list[str]:
        """Returns the pages of modules that Sphinx must write again, because their body or layout
        is newer than the written page."""
        self.pages = {page.name: page for page in self.made()}
        return [name for name in self.pages if name in env.found_docs and self.is_old(name)]

    def is_old(self, name: str) -> bool:
        page = self.site / f"{name}.html"
        parts = (self.frame, body_file(self.bodies, name))
        newest = max(part.stat().st_mtime_ns for part in parts)
        return not page.exists() or page.stat().st_mtime_ns < newest

    def others(self, app: Sphinx) -> Iterator[tuple[str, dict[str, Any], str]]:
        for name in self.pages:
            if name not in app.env.found_docs and self.is_old(name):
                yield name, {"body": ""}, "page.html"

    def fill(
        self, _app: Sphinx, name: str, _template: str, context: dict[str, Any], _tree: object
    ) -> None:
        if page := self.pages.get(name):
            text = body_file(self.bodies, name).read_text(encoding="utf-8")
            body = text.replace(MEMBERS, context["body"]).replace(
                f'"{ROOT}', f'"{depth_prefix(name)}'
            )
            meta = {"nav": page.nav, "wide": page.wide, "bare": page.bare, "prose": False}
            context |= {"title": escape(page.title, quote=False), "body": body, "meta": meta}


def body_file(bodies: Path, name: str) -> Path:
    return bodies / f"{name}.html"


def run_sphinx(
    portal: Portal, pages: Path, site: Path, made: Callable[[], list[Page]]
) -> list[Finding]:
    cache = portal.root / "build" / "pages-cache"
    # Contains the hash of the pages and of the code that builds them, if Sphinx read all pages
    # without a warning.
    sound = cache / "sound-docs"
    docs = hash_of(pages, files_below(pages, ("docs", "_generated", "links.json")))
    docs += hash_of(SITE, files_below(SITE, ("portal",), (".py",)))
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
                "root_doc": portal.docs[0].id,
                "read_all_docs": not sound.exists() or sound.read_text() != docs,
            },
        )
        frame = (SITE / "theme" / "layout.html").read_text(encoding="utf-8")
        frame += json.dumps(portal.navigation.data())
        generated = GeneratedPages(pages / BODIES, frame, site, made)
        app.connect("env-get-updated", generated.changed)
        app.connect("html-collect-pages", generated.others)
        app.connect("html-page-context", generated.fill)
        app.build()
    write_changed(site / "_static" / INDEX, search.index_script(portal, pages / BODIES, site))
    findings = collector.findings()
    write_changed(sound, "" if findings else docs)
    return findings
