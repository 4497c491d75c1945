"""Computes the possible effects of a change: the affected modules with their distance from the
change, and the requirements, patterns, tests and safety goals to review again.

A change of a module or value type may affect the modules and value types that name it, call it or
derive from it. In the same way, each affected module may affect further modules. If a module names
only an abstract base class of a changed module, it is not regarded as affected. If such a module
can call a method of the changed module through the base class, it is listed in ``callers``."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from traceability.model.design_model import Model
from traceability.reading.traces import nodes_of
from traceability.schema import Requirement, TreeNode
from traceability.sources import FRAMES


@dataclass
class Reached:
    """An affected element and the reason why it is affected. The distance of a changed module is 0.
    If a module B depends directly on an affected module A, the distance of B is the distance of A
    plus 1."""

    id: str
    distance: int
    because: str


@dataclass
class Impact:
    subject: str
    kind: str  # kind of the subject: "module", "requirement", "file" or "commits"
    says: str
    modules: list[Reached] = field(default_factory=list)
    # modules that call a changed module only through an abstract base class
    callers: list[Reached] = field(default_factory=list)
    requirements: list[Reached] = field(default_factory=list)
    patterns: list[Reached] = field(default_factory=list)
    tests: list[Reached] = field(default_factory=list)
    goals: list[Reached] = field(default_factory=list)  # safety goals
    python_tests: list[Reached] = field(default_factory=list)  # files with tests of the tools
    # changed files for which the model contains no affected element
    unfollowed: list[str] = field(default_factory=list)

    def is_empty(self) -> bool:
        return not (self.modules or self.requirements or self.tests)

    def at(self, distance: int) -> list[Reached]:
        return [module for module in self.modules if module.distance == distance]


class UnknownSubjectError(Exception):
    """The argument of ``./wr impact`` is not a file, a module or a requirement of the model."""


class Impacts:
    """A calculator for the effects of changes. The constructor collects the dependencies between
    the modules once for all changes."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.affected = {name: self._next(name) for name in model.modules}
        overriding = overriding_modules(model)
        self.trees = {
            name: modules_of(requirement.tree, overriding) if requirement.tree else {}
            for name, requirement in model.requirements.items()
        }

    def _next(self, name: str) -> dict[str, str]:
        """Returns the modules that a change of the module ``name`` may affect directly, with the
        reason for each module."""
        module = self.model.modules[name]
        reasons: dict[str, str] = {}
        for subclass in module.subclasses:
            if name in self._bases(subclass):
                reasons[subclass] = f"derives from {name}"
        for method in module.methods:
            for caller in method.called_by:
                owner = caller.partition("::")[0]
                if owner in self.model.modules and self._calls(owner, method.id):
                    reasons.setdefault(owner, f"calls {method.id}")
        for user in module.named_by:
            reasons.setdefault(user, f"names {name}")
        reasons.pop(name, None)
        return {each: why for each, why in reasons.items() if each in self.model.modules}

    def _bases(self, name: str) -> Sequence[str]:
        return self.model.modules[name].bases if name in self.model.modules else []

    def _calls(self, owner: str, method: str) -> bool:
        """Returns true if the module ``owner`` calls exactly this method. If the method overrides
        an abstract method, calls of the abstract method are ignored."""
        calls = (call for method in self.model.modules[owner].methods for call in method.calls)
        return any(call.target == method for call in calls)

    def of(self, subject: str) -> Impact:
        if subject in self.model.modules:
            module = self.model.modules[subject]
            return self._from(Impact(subject, "module", module.brief), {subject: "changed"})
        if subject in self.model.requirements:
            return self._of_requirement(self.model.requirements[subject])
        path = subject.removeprefix("./")
        if path in self.model.files:
            return self._of_file(path)
        raise UnknownSubjectError(self._unknown(subject))

    def _unknown(self, subject: str) -> str:
        names = [*self.model.modules, *self.model.requirements, *self.model.files]
        near = difflib.get_close_matches(subject, names, 3, 0.6)
        short = {path.rpartition("/")[2]: path for path in self.model.files}
        if subject.rpartition("/")[2] in short:
            near.insert(0, short[subject.rpartition("/")[2]])
        hint = f"; did you mean {' or '.join(dict.fromkeys(near))}?" if near else ""
        return f"{subject} is not a file, a module or a requirement of the model{hint}"

    def _of_requirement(self, requirement: Requirement) -> Impact:
        start = {
            method.partition("::")[0]: f"satisfies it in {method}"
            for method in requirement.satisfied_by
        }
        for node in nodes_of(requirement.tree):
            if node.module in self.model.modules:
                start.setdefault(node.module, f"its tree calls {node.label}")
        impact = Impact(requirement.id, "requirement", requirement.text)
        impact.requirements.append(Reached(requirement.id, 0, "changed"))
        return self._from(impact, start)

    def _of_file(self, path: str) -> Impact:
        model = self.model
        start = {
            module.name: f"is written in {path}"
            for module in model.modules.values()
            if path in (module.header, module.source)
        }
        for machine in model.machines.values():
            if machine.place.file == path:
                start |= dict.fromkeys(machine.states.values(), f"is a state of {machine.id}")
        if path == FRAMES[0]:
            start["FieldName"] = f"its enumerators name the fields of {path}"
        impact = Impact(path, "file", "")
        for requirement in model.requirements.values():
            tree = requirement.tree
            if requirement.place.file == path:
                impact.requirements.append(Reached(requirement.id, 0, f"is written in {path}"))
            elif tree is not None and tree.place.file == path:
                impact.requirements.append(Reached(requirement.id, 0, f"its tree is in {path}"))
        for test in model.tests.values():
            if test.place.file == path:
                impact.tests.append(Reached(test.id, 0, f"is written in {path}"))
                impact.requirements += [
                    Reached(name, 0, f"{test.id} verifies it") for name in test.verifies
                ]
        return self._from(impact, start)

    def of_files(self, subject: str, paths: Sequence[str]) -> Impact:
        """Returns the effects of a change of several files. ``unfollowed`` lists the files for
        which the model contains no affected element."""
        joined = Impact(subject, "commits" if ".." in subject else "file", "")
        parts = [self._of_file(path) for path in paths if path in self.model.files]
        followed = {part.subject for part in parts if not part.is_empty()}
        joined.unfollowed = [path for path in paths if path not in followed]
        for name in ("modules", "callers", "requirements", "patterns", "tests", "goals"):
            reached = [item for part in parts for item in getattr(part, name)]
            setattr(joined, name, first_of_each(by_distance(reached)))
        near = {module.id for module in joined.modules if module.distance <= 1}
        joined.callers = [caller for caller in joined.callers if caller.id not in near]
        return joined

    def _from(self, impact: Impact, start: dict[str, str]) -> Impact:
        modules = set(start) & set(self.model.modules)
        impact.modules = [Reached(name, 0, why) for name, why in start.items() if name in modules]
        for reached in impact.modules:  # The loop appends to this list.
            for name, why in sorted(self.affected.get(reached.id, {}).items()):
                if name not in modules:
                    modules.add(name)
                    impact.modules.append(Reached(name, reached.distance + 1, why))
        near = [module for module in impact.modules if module.distance <= 1]
        callers = self._callers(impact.at(0), {module.id for module in near})
        impact.callers = first_of_each(callers)
        impact.requirements = first_of_each([*impact.requirements, *self._requirements(near)])
        impact.patterns = first_of_each(self._patterns(near))
        impact.goals = by_distance(first_of_each(self._goals(impact.requirements)))
        impact.tests = by_distance(first_of_each([*impact.tests, *self._tests(impact)]))
        return impact

    def _callers(self, changed: list[Reached], near: set[str]) -> Iterator[Reached]:
        """Yields the modules that can call a changed module and are not in ``near``: they call it
        only through an abstract base class."""
        for item in changed:
            for method in self.model.modules[item.id].methods:
                for caller in method.called_by:
                    owner = caller.partition("::")[0]
                    if owner in self.model.modules and owner not in near:
                        yield Reached(owner, 1, f"{caller} can call {method.id}")

    def _requirements(self, near: list[Reached]) -> Iterator[Reached]:
        for item in near:
            for name in self.model.modules[item.id].requirements:
                yield Reached(name, item.distance, f"{item.id} satisfies it")
            for name, modules in self.trees.items():
                if item.id in modules:
                    yield Reached(name, item.distance, modules[item.id])

    def _goals(self, requirements: list[Reached]) -> Iterator[Reached]:
        """Yields the safety goals that the affected requirements serve."""
        for item in requirements:
            requirement = self.model.requirements.get(item.id)
            for name in requirement.goals if requirement else []:
                yield Reached(name, item.distance, f"{item.id} serves it")

    def _patterns(self, near: list[Reached]) -> Iterator[Reached]:
        for item in near:
            for binding in self.model.modules[item.id].roles:
                why = f"{item.id} is its {binding.role}"
                yield Reached(binding.application, item.distance, why)

    def _tests(self, impact: Impact) -> Iterator[Reached]:
        """Yields the tests of the affected requirements, and the tests that execute a changed
        module."""
        for item in impact.requirements:
            requirement = self.model.requirements.get(item.id)
            for name in requirement.verified_by if requirement else []:
                yield Reached(name, item.distance, f"verifies {item.id}")
        for item in impact.at(0) if impact.kind != "requirement" else []:
            for name in self.model.modules[item.id].tests:
                yield Reached(name, 1, f"executes {item.id}")


def first_of_each(elements: Iterable[Reached]) -> list[Reached]:
    """Returns the first record of each affected element. This record has the shortest distance."""
    first: dict[str, Reached] = {}
    for item in elements:
        first.setdefault(item.id, item)
    return list(first.values())


def by_distance(elements: Iterable[Reached]) -> list[Reached]:
    return sorted(elements, key=lambda item: item.distance)


def overriding_modules(model: Model) -> dict[str, list[str]]:
    """Returns a map from each abstract method to the modules that override it."""
    modules: dict[str, list[str]] = {m.id: [] for m in model.methods if m.kind == "pure"}
    for method in model.methods:
        if method.overrides in modules:
            modules[method.overrides].append(method.module)
    return modules


def modules_of(tree: TreeNode, overriding: Mapping[str, list[str]]) -> dict[str, str]:
    """Returns the modules of an invocation tree, each with the reason. A call of an abstract method
    executes a method that overrides it. Therefore the modules of these methods belong to the tree,
    too.
    """
    reasons: dict[str, str] = {}
    above: dict[str, str] = {}
    for node in nodes_of(tree):
        method = node.resolved or node.label
        for name in (node.module, method.partition("::")[0]):
            reasons[name] = f"its tree contains {name}"
        for name in overriding.get(method, []):
            above.setdefault(name, f"its tree contains {method}, which {name} overrides")
    return above | reasons
