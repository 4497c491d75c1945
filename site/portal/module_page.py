"""The page of a module."""

from __future__ import annotations

from pathlib import Path

from markupsafe import Markup

from portal import calls
from portal.portal import Page, Portal
from portal.verification_views import coverage_of
from traceability.schema import Method, Module

FIRST_TESTS = 12  # number of tests that the page of a module shows without a click
XML = "build/model/xml"
# In the page, this HTML comment is replaced by the documentation of the members from Breathe.
MEMBERS = "<!-- members -->"


def module_page(portal: Portal, module: Module) -> Page:
    rows = portal.calls.rows(module)
    logic = portal.model.logic_modules.get(module.logic)
    first_tests = portal.own_tests(module)[:FIRST_TESTS]
    specified = [m for m in module.methods if m.access == "public"]
    files = [path for path in (module.header, module.source) if path]
    on_board = portal.model.board_lines or {}
    return portal.page(
        f"modules/{module.name}",
        module.name,
        "structure",
        "module",
        module=module,
        members=Markup(MEMBERS) if doxygen_file(portal, module) else None,
        logic=logic,
        rows=rows,
        drawing=calls.draw(rows),
        methods=specified,
        hidden=[m for m in module.methods if m.access != "public"],
        inherited=inherited_methods(portal, module),
        first_tests=first_tests,
        other_tests=[test for test in portal.tests_of(module) if test not in first_tests],
        through=requirement_methods(portal, module),
        siblings=[name for name in (logic.modules if logic else []) if name != module.name],
        ancestors=portal.links.ancestors(module.name),
        bars=[(path, bars_of(portal, path)) for path in files if path in portal.hits],
        covered=coverage_of(portal.model, module.name, files),
        changes=portal.changes_of(module.name),
        in_paper=portal.in_paper(module.name),
        on_board=[hit for path in files for hit in on_board.get(path, {}).values()],
    )


def doxygen_file(portal: Portal, module: Module) -> Path | None:
    """Returns the path of the XML file that Doxygen wrote for the class of a module, or ``None`` if
    there is no such file."""
    path = portal.root / XML / f"class{module.qualified.replace('::', '_1_1')}.xml"
    return path if path.is_file() else None


def inherited_methods(portal: Portal, module: Module) -> list[Method]:
    """Returns the public methods that the module inherits and does not override."""
    overridden = {m.name for m in module.methods}
    methods: list[Method] = []
    for base in portal.links.ancestors(module.name):
        for method in portal.model.modules[base].methods if base in portal.model.modules else []:
            skip = method.kind == "constructor" or method.name.startswith(("~", "operator"))
            if method.access == "public" and not skip and method.name not in overridden:
                overridden.add(method.name)
                methods.append(method)
    return methods


def requirement_methods(portal: Portal, module: Module) -> dict[str, list[str]]:
    """For each requirement of a module, returns the methods of the module that satisfy this
    requirement. The list is empty if the module is in the tree of the requirement, but has no such
    method.
    """
    return {
        identifier: list(dict.fromkeys(m.name for m in module.methods if identifier in m.satisfies))
        for identifier in portal.model.requirements
        if identifier in module.requirements or module.name in portal.impacts.trees[identifier]
    }


def bars_of(portal: Portal, path: str) -> list[str]:
    """Returns the kind of each source line of a file: executed, missed, or without code."""
    hits = portal.hits[path]
    return [line_kind(hits.get(number)) for number in range(1, portal.length(path) + 1)]


def line_kind(hit: bool | None) -> str:
    if hit is None:
        return "z"
    return "h" if hit else "m"
