"""The addresses of the pages that show the elements of the model. An address starts with ``@/``,
which means the root folder of the site."""

from __future__ import annotations

import re
from collections.abc import Container
from functools import partial
from pathlib import PurePosixPath

from traceability.model.design_model import Model
from traceability.schema import Method, Place

ROOT = "@/"
TWO_HUMPS = re.compile(r"\b[A-Z][a-z0-9]+(?:[A-Z][a-z0-9]*)+\b")
ID_OR_CODE = re.compile(r"<code>([^<]*)</code>|\b(?:FR|NFR|SG|HZ|AU)-\d+\b|" + TWO_HUMPS.pattern)


def slug(name: str) -> str:
    """Returns a name in a form that an address may contain. Letters, digits, ``_``, ``.`` and ``-``
    do not change. Any other character becomes a hyphen and its code in hexadecimal digits."""
    return re.sub(r"[^A-Za-z0-9_.-]", lambda hit: f"-{ord(hit.group()):x}", name)


def paper_anchor(name: str) -> str:
    """Returns the anchor of a name on the page Concordance."""
    return slug(name.replace(" ", "-"))


def depth_prefix(page: str) -> str:
    """Returns the relative path from a page to the root of the site."""
    return "../" * (len(PurePosixPath(page).parts) - 1)


def address_in(pages: Container[str], address: str, identifier: str) -> str | None:
    """Returns the address of an element, or ``None`` if the element has no page."""
    return ROOT + address.format(slug(identifier)) if identifier in pages else None


class Links:
    """Addresses of elements. An element without a page has the address ``None``."""

    def __init__(self, model: Model, checks: set[str]) -> None:
        self.model = model
        self.checks = checks
        self.files = set(model.files)
        self.methods = {method.id: method for method in model.methods}
        self.requirement = partial(address_in, model.requirements, "requirements/{}.html")
        self.pattern = partial(address_in, model.patterns, "patterns/{}.html")
        self.change = partial(address_in, model.changes, "changes/{}.html")
        self.machine = partial(address_in, model.machines, "machines.html#{}")
        self.test = partial(address_in, model.tests, "tests.html#{}")
        self.check = partial(address_in, checks, "checks/{}.html")

    def module(self, name: str) -> str | None:
        module = self.model.modules.get(name)
        if module is None:
            return None
        page = f"datatypes.html#{name}" if module.datatype else f"modules/{name}.html"
        return f"{ROOT}{page}"

    def method(self, identifier: str) -> str | None:
        method = self.find_method(identifier)
        if method is None:
            return self.module(identifier.partition("::")[0])
        page = self.module(method.module)
        if self.model.modules[method.module].datatype and method.access != "public":
            return page  # the data dictionary shows only public methods
        return page and f"{page.partition('#')[0]}#{self.method_anchor(method)}"

    def find_method(self, identifier: str) -> Method | None:
        """Returns the method with this identifier. If the module does not declare the method,
        returns the method that the module inherits."""
        name, _, method = identifier.partition("::")
        names = (f"{owner}::{method}" for owner in (name, *self.ancestors(name)))
        return next((self.methods[name] for name in names if name in self.methods), None)

    def ancestors(self, module: str) -> list[str]:
        """Returns the direct base classes, and then the indirect base classes."""
        names: list[str] = []
        pending = [module]
        while pending:
            owner = self.model.modules.get(pending.pop(0))
            new = [base for base in (owner.bases if owner else []) if base not in names]
            names += new
            pending += new
        return names

    def method_anchor(self, method: Method) -> str:
        module = self.model.modules[method.module]
        scope = f"{method.module}-" if module.datatype else "m-"
        return scope + slug(method.name)

    def safety(self, identifier: str) -> str | None:
        """Returns the address of a safety goal, hazard or assumption of use. A goal has a page; a
        hazard or an assumption is a section of a page."""
        case = self.model.safety
        return (
            address_in(case.goals, "safety/{}.html", identifier)
            or address_in(case.hazards, "safety/hazards.html#{}", identifier)
            or address_in(case.assumptions, "safety/index.html#{}", identifier)
        )

    def logic(self, identifier: str) -> str | None:
        has_page = identifier in self.model.logic_modules
        return f"{ROOT}structure.html#{logic_anchor(identifier)}" if has_page else None

    def source(self, place: Place) -> str | None:
        if place.file not in self.files:
            return None
        line = f"#L{place.line}" if place.line else ""
        return f"{ROOT}source/{place.file}.html{line}"

    def file(self, path: str) -> str | None:
        return self.source(Place(path, 0))


def logic_anchor(identifier: str) -> str:
    return identifier.replace("/", ".")
