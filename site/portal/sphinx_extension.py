"""The Sphinx extension of the portal: roles and an inventory for the elements of the model."""

from __future__ import annotations

import json
from collections.abc import Iterator, Set
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.domains import Domain, ObjType
from sphinx.environment import BuildEnvironment
from sphinx.util import logging
from sphinx.util.docutils import SphinxRole

from portal.glossary_links import GLOSSARY, GlossaryLinks
from portal.links import ROOT, depth_prefix
from portal.names import unbroken_options

LOGGER = logging.getLogger(__name__)
# File in the source folder of Sphinx. It contains the kind, name and address of each element.
NAMES = "names.json"


class NameRole(SphinxRole):
    """A role such as ``:module:`RC```: the name of an element, linked to its page."""

    def __init__(self, targets: dict[str, str]) -> None:
        super().__init__()
        self.targets = targets

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        name = " ".join(self.text.split())  # a formula may be longer than a line
        target = self.targets.get(name.removesuffix("()"))
        if target is None:
            text = f"unknown target: there is no {self.name} {self.text!r}"
            LOGGER.warning(text, location=self.get_location())
            return [nodes.literal(self.rawtext, self.text)], []
        html = target.replace(f'"{ROOT}', f'"{depth_prefix(self.env.docname)}')
        return [nodes.raw(self.rawtext, html, format="html")], []


class DesignDomain(Domain):
    """The elements of the design. Sphinx writes these elements to ``objects.inv``. The
    documentation of other projects can then link to the elements."""

    name = "design"
    label = "Design"
    object_types = {  # noqa: RUF012 - as Sphinx declares it
        kind: ObjType(kind)
        for kind in ("module", "method", "pattern", "requirement", "safety", "test", "check")
    }

    def get_objects(self) -> Iterator[tuple[str, str, str, str, str, int]]:
        names = Path(self.env.srcdir) / NAMES
        for kind, name, address in json.loads(names.read_text(encoding="utf-8")):
            page, _, anchor = address.partition("#")
            yield name, name, kind, page.removesuffix(".html"), anchor, 1

    def merge_domaindata(self, docnames: Set[str], otherdata: dict[str, Any]) -> None:
        """Does nothing, because the domain stores no data in the environment of Sphinx."""


def link_targets(app: Sphinx) -> dict[str, dict[str, str]]:
    """Returns the HTML of each name of each role."""
    text = (Path(app.srcdir) / "links.json").read_text(encoding="utf-8")
    targets: dict[str, dict[str, str]] = json.loads(text)
    return targets


def load(app: Sphinx) -> None:
    for kind, targets in link_targets(app).items():
        app.add_role(kind, NameRole(targets), override=True)
    # The portal has its own search. Only HTML builders have this attribute; Sphinx uses no other
    # builder here.
    app.builder.search = False  # type: ignore[attr-defined]  # of the HTML builder


def hand_written(app: Sphinx, env: BuildEnvironment, *_changed: set[str]) -> list[str]:
    """Returns the hand-written pages that Sphinx must read again: all of them if a page changed, or
    if the last build had a warning. A change of a page can break a link on another page."""
    names = [name for name in env.found_docs if name.startswith("docs/")]
    return names if app.config.read_all_docs else []


def mark(app: Sphinx, _doctree: nodes.document) -> None:
    """Passes the navigation entry of a page to its layout."""
    name = app.env.docname
    app.env.metadata[name].update(nav=name, prose=True, orphan="")


def link_terms(
    app: Sphinx, name: str, _template: str, context: dict[str, Any], doctree: nodes.document | None
) -> None:
    """Adds links from the terms on a hand-written page to the glossary, and marks options. This was
    already done for generated pages."""
    if doctree is not None and name.startswith("docs/") and name != GLOSSARY.id:
        glossary = GlossaryLinks(Path(app.srcdir), link_targets(app)["constant"])
        context["body"] = unbroken_options(glossary.link(context["body"], depth_prefix(name)))


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_domain(DesignDomain)
    app.add_config_value("read_all_docs", True, "")
    app.connect("builder-inited", load)
    app.connect("env-get-outdated", hand_written)
    app.connect("doctree-read", mark)
    app.connect("html-page-context", link_terms)
    return {"version": "3", "parallel_read_safe": True, "parallel_write_safe": True}
