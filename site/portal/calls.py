"""The module diagram of a module: its callers and the modules that it calls."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from portal.links import Links
from traceability.model.design_model import Model
from traceability.schema import Call, Method, Module

ROW = 26
GROUP_GAP = 12
LEFT, RIGHT = 296, 560
BOX_LEFT, BOX_RIGHT = 340, 516
TOP = 74
# Greatest number of callers, and greatest number of callees, that the diagram shows next to a
# method. The list below the diagram shows all calls.
MOST = 12


@dataclass
class End:
    """A caller or a callee of a method of the module. ``virtual`` is true if the call is virtual.
    If the object of the call is not known, ``through`` is the called abstract method."""

    method: str
    virtual: bool
    link: str | None
    through: str = ""


@dataclass
class Row:
    """A method of the module with its callers and callees."""

    name: str
    link: str | None
    callers: list[End] = field(default_factory=list)
    callees: list[End] = field(default_factory=list)


@dataclass
class Text:
    x: int
    y: float
    method: str
    link: str | None
    end: bool


@dataclass
class Wire:
    path: str
    virtual: bool


@dataclass
class Drawing:
    height: float
    box_bottom: float
    names: list[tuple[str, str | None, float]]
    texts: list[Text]
    wires: list[Wire]
    hidden: int


class CallGraph:
    """Callers of each method. A caller of an abstract method is also recorded as a caller of each
    override that can be executed."""

    def __init__(self, model: Model, links: Links) -> None:
        self.links = links
        self.callers: dict[str, list[End]] = {}
        self.callees: dict[str, list[Method]] = {}  # caller -> the methods that it calls
        for method in model.methods:
            self._add(method.id, method.calls, links.method(method.id))
        for function in model.functions.values():
            self._add(function.id, function.calls, links.source(function.place))
        for method in model.methods:
            self._add_nested(method, model)

    def _add(self, caller: str, calls: Iterable[Call], link: str | None) -> None:
        for call in calls:
            for target in {call.target, *call.targets}:
                ends = self.callers.setdefault(target, [])
                if all(end.method != caller for end in ends):
                    ends.append(End(caller, call.virtual, link))

    def _add_nested(self, method: Method, model: Model) -> None:
        """Adds the callers of a method that are not methods of a module. They are nested classes,
        and constants that are initialised by a call of the method.
        """
        for caller in method.called_by:
            self.callees.setdefault(caller, []).append(method)
        ends = self.callers.setdefault(method.id, [])
        known = {end.method for end in ends}
        ends += [
            End(without_constructor(caller), False, self.links.method(caller))
            for caller in method.called_by
            if caller not in known and caller.partition("::")[0] in model.modules
        ]

    def rows(self, module: Module) -> list[Row]:
        rows: dict[str, Row] = {}
        for method in module.methods:
            row = rows.setdefault(method.name, Row(method.name, self.links.method(method.id)))
            self._fill(row, module, method)
        nested = [self._nested_row(name, module) for name in self._nested_methods(module)]
        return [row for row in rows.values() if row.callers or row.callees] + nested

    def _nested_methods(self, module: Module) -> list[str]:
        """Returns the methods of nested classes, if other modules call these methods. Constructors
        are left out."""
        outside = f"{module.name}::"
        return [
            name
            for name, callers in sorted(self.callers.items())
            if name.startswith(outside)
            and name.count("::") == outside.count("::") + 1
            and without_constructor(name) == name
            and any(not caller.method.startswith(outside) for caller in callers)
        ]

    def _nested_row(self, name: str, module: Module) -> Row:
        outside = f"{module.name}::"
        callees = self.callees.get(name, [])
        called = {method.id for method in callees}
        return Row(
            name.removeprefix(outside),
            None,
            [end for end in self.callers[name] if not end.method.startswith(outside)],
            [
                End(method.id, method.kind == "pure", self.links.method(method.id))
                for method in callees
                if not method.id.startswith(outside) and method.overrides not in called
            ],
        )

    def _fill(self, row: Row, module: Module, method: Method) -> None:
        outside = f"{module.name}::"
        methods = {end.method for end in row.callers}
        row.callers += [
            replace(end, through=method.called_by.get(end.method, ""))
            for end in self.callers.get(method.id, [])
            if not end.method.startswith(outside)
            and end.method not in methods
            and not is_heir_constructor(module, method, end.method)
        ]
        methods = {end.method for end in row.callees}
        for call in method.calls:
            inside = call.target.startswith(outside) or is_base_constructor(module, call.target)
            if not inside and call.target not in methods and self.links.find_method(call.target):
                methods.add(call.target)
                row.callees.append(End(call.target, call.virtual, self.links.method(call.target)))


def without_constructor(caller: str) -> str:
    """If the caller is the constructor of a nested class, returns the name of this class.
    Otherwise, returns the name of the caller."""
    owner, _, name = caller.rpartition("::")
    return owner if owner.endswith(f"::{name}") else caller


def is_base_constructor(module: Module, method: str) -> bool:
    owner, _, name = method.partition("::")
    return owner == name and owner in module.bases


def is_heir_constructor(module: Module, method: Method, caller: str) -> bool:
    owner, _, name = caller.partition("::")
    return method.kind == "constructor" and owner == name and owner in module.subclasses


def draw(rows: list[Row]) -> Drawing:
    """Returns the drawing with three columns: callers, methods of the module, callees. The callers
    and the callees of a method are vertically centred at the method."""
    drawing = Drawing(0, 0, [], [], [], 0)
    y = float(TOP)
    for row in rows:
        callers, callees = row.callers[:MOST], row.callees[:MOST]
        drawing.hidden += len(row.callers) + len(row.callees) - len(callers) - len(callees)
        height = max(len(callers), len(callees), 1) * ROW
        middle = y + height / 2
        drawing.names.append((row.name, row.link, middle))
        for ends, x, is_caller in ((callers, LEFT, True), (callees, RIGHT, False)):
            first = middle - (len(ends) - 1) * ROW / 2
            for number, end in enumerate(ends):
                at = first + number * ROW
                drawing.texts.append(Text(x, at, end.method, end.link, is_caller))
                drawing.wires.append(Wire(curve(at, middle, is_caller), end.virtual))
        y += height + GROUP_GAP
    drawing.box_bottom = y
    drawing.height = y + 34
    return drawing


def curve(outer: float, middle: float, is_caller: bool) -> str:
    start, end = (LEFT + 6, BOX_LEFT - 7) if is_caller else (BOX_RIGHT, RIGHT - 9)
    first, last = (outer, middle) if is_caller else (middle, outer)
    return f"M{start} {first:g}C{start + 21} {first:g} {end - 21} {last:g} {end} {last:g}"
