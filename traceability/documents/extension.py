"""The Sphinx extension of the portal: generated pages, and roles for hand-written ones."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers import Parser
from docutils.parsers.rst import Parser as RstParser
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util import logging
from sphinx.util.docutils import SphinxRole

from traceability.documents.links import ROOT, depth_prefix

LOGGER = logging.getLogger(__name__)
API_MARK = "<!-- what Doxygen says -->"


class PageParser(Parser):
    """Reads a generated page: a line of facts, then HTML."""

    supported = ("page",)

    def parse(self, inputstring: str, document: nodes.document) -> None:
        facts, _, body = inputstring.partition("\n")
        environment: BuildEnvironment = document.settings.env
        values = json.loads(facts)
        environment.metadata[environment.docname].update(values, orphan="")
        before, _, after = body.partition(API_MARK)
        document += nodes.raw("", before, format="html")
        if values["api"]:
            self.add_api(values["api"], document)
        if after:
            document += nodes.raw("", after, format="html")

    def add_api(self, name: str, document: nodes.document) -> None:
        """What Doxygen says of a class, as Breathe shows it."""
        text = f".. doxygenclass:: {name}\n   :members:\n   :protected-members:\n"
        RstParser().parse(text, document)


class NameRole(SphinxRole):
    """A role such as ``:module:`RC```: the name of an element, linked to its page."""

    def __init__(self, targets: dict[str, str]) -> None:
        super().__init__()
        self.targets = targets

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        known = self.targets.get(self.text.removesuffix("()"))
        if known is None:
            text = f"unknown target: there is no {self.name} {self.text!r}"
            LOGGER.warning(text, location=self.get_location())
            return [nodes.literal(self.rawtext, self.text)], []
        html = known.replace(f'"{ROOT}', f'"{depth_prefix(self.env.docname)}')
        return [nodes.raw(self.rawtext, html, format="html")], []


def load(app: Sphinx) -> None:
    links = Path(app.srcdir) / "links.json"
    for kind, targets in json.loads(links.read_text(encoding="utf-8")).items():
        app.add_role(kind, NameRole(targets), override=True)
    # Only builders of HTML have it, and no other one is used.
    app.builder.search = False  # type: ignore[attr-defined]


def hand_written(_app: Sphinx, env: BuildEnvironment, *_changed: set[str]) -> list[str]:
    """These are read in each run, so that each run reports all their warnings."""
    return [name for name in env.found_docs if name.startswith("docs/")]


def mark_hand_written(app: Sphinx, doctree: nodes.document) -> None:
    name = app.env.docname
    if name.startswith("docs/"):
        title = next(iter(doctree.findall(nodes.title)), None)
        facts = {
            "title": title.astext() if title else name,
            "nav": name,
            "prose": True,
            "orphan": "",
        }
        app.env.metadata[name].update(facts)


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_source_suffix(".page", "page")
    app.add_source_parser(PageParser)
    app.connect("builder-inited", load)
    app.connect("env-get-outdated", hand_written)
    app.connect("doctree-read", mark_hand_written)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
