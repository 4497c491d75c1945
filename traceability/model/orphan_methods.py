"""The methods and tests that serve no requirement."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from traceability.model.design_model import Model
from traceability.reading.traces import nodes_of
from traceability.schema import Justified, Method, Module, Test

# Some code needs a justification of one of these kinds. This code is found by the checks, and not
# by this module.
JUSTIFIED_BY_CHECKS = ("uncalled", "loop")


def serving_methods(model: Model) -> set[str]:
    """Returns the methods that serve a requirement. A method serves a requirement if it has a
    ``@satisfies`` tag, or if an invocation tree contains it.

    A virtual method and all methods that override it belong together: if one of them serves a
    requirement, all of them do. If a method of a class serves a requirement, the constructors of
    the class also serve a requirement."""
    methods = {item.id: item for item in model.methods}
    served = {item.id for item in methods.values() if item.satisfies}
    for requirement in model.requirements.values():
        served |= {node.resolved for node in nodes_of(requirement.tree) if node.resolved}
    above = {item.id: item.overrides for item in methods.values() if item.overrides}

    def top(name: str) -> str:
        return top(above[name]) if name in above else name

    serving = {top(name) for name in served}
    served |= {name for name in methods if top(name) in serving}
    for module in model.modules.values():
        if any(item.id in served for item in module.methods):
            served |= {item.id for item in module.methods if item.kind == "constructor"}
    return served


def methods_without(model: Model) -> list[tuple[Module, Method]]:
    """Returns the public methods of the design modules. Methods that serve a requirement are left
    out."""
    serving = serving_methods(model)
    return [
        (module, method)
        for module in model.modules.values()
        if not module.datatype
        for method in module.methods
        if method.access == "public" and method.id not in serving
    ]


def tests_without(model: Model) -> list[Test]:
    return [test for test in model.tests.values() if not test.verifies]


def justify(model: Model, declared: Iterable[Justified]) -> Model:
    """Records in each justification the names of the methods and tests that need it. If the tests
    of a method's requirements do not execute some source lines of the method, also records the
    reason from the justification."""
    methods = [method.id for _, method in methods_without(model)]
    tests = tests_without(model)
    reasons: dict[str, str] = {}
    justified: list[Justified] = []
    for item in declared:
        if item.kind == "method":
            covers = [name for name in methods if name in item.names]
        elif item.kind in JUSTIFIED_BY_CHECKS:
            covers = list(item.names)
        elif item.kind == "line":
            covers = [gap.method for gap in model.line_gaps if gap.method in item.names]
            reasons |= dict.fromkeys(covers, item.why)
        else:
            places = tuple(name for name in item.names if "/" in name)
            covers = [
                test.id
                for test in tests
                if test.id in item.names or test.place.file.startswith(places)
            ]
        justified.append(replace(item, covers=covers))
    gaps = [replace(gap, reason=reasons.get(gap.method, "")) for gap in model.line_gaps]
    return replace(model, justified=justified, line_gaps=gaps)
