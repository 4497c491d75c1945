"""The frame of a page: bar, navigation and foot. Sphinx uses the same template."""

from __future__ import annotations

from html import escape

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from traceability.documents.links import ROOT, depth_prefix
from traceability.documents.navigation import Navigation
from traceability.documents.portal import SITE, Page


class Layout:
    """Puts the body of a page into the frame."""

    def __init__(self, navigation: Navigation) -> None:
        environment = Environment(
            loader=FileSystemLoader(SITE / "theme"),
            autoescape=False,  # as Sphinx reads it
            undefined=StrictUndefined,
        )
        self.template = environment.get_template("layout.html")
        self.groups = navigation.data()

    def html(self, page: Page) -> str:
        """The whole page, with links that fit its place."""
        return self.template.render(
            meta={"nav": page.nav, "wide": page.wide, "prose": False},
            groups=self.groups,
            pagename=page.name,
            title=escape(page.title, quote=False),
            body=page.body.replace(f'"{ROOT}', f'"{depth_prefix(page.name)}'),
        )
