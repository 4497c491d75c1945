"""The content of the pages: the model, the links to its elements, and values that are computed from
the model and the links."""

from __future__ import annotations

import functools
import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemBytecodeCache
from markupsafe import Markup

from portal import diagrams, names
from portal.answers import linked_questions, questions_of, with_metrics
from portal.calls import CallGraph
from portal.constant_texts import constant_links
from portal.glossary_links import GlossaryLinks
from portal.highlight import Highlighter
from portal.links import Links, paper_anchor, slug
from portal.navigation import Navigation, hand_written
from portal.package_diagram import package_diagrams
from portal.templates import environment
from portal.tours import tours_of
from portal.tuned_values import chosen_values, constant_named, other_lines
from traceability.checks.registry import Check
from traceability.model.design_model import Model
from traceability.model.execution import INTERRUPT, START
from traceability.model.impact import Impacts
from traceability.model.metrics import metrics
from traceability.model.not_shown import targets_of
from traceability.model.report import Report
from traceability.reading.last_changes import changed_since, last_changes
from traceability.reading.products import CALLS_SUFFIX
from traceability.reading.results import LIVE_MODULE
from traceability.reading.seeded_faults import Fault, Outcome
from traceability.schema import (
    HOST,
    ExecutionContext,
    Finding,
    Method,
    Module,
    PaperElement,
    Place,
    Requirement,
    SharedPipe,
    SourceReference,
    Test,
    Transition,
    TreeNode,
)

OPERATION_STATES, READING_MODES = "operation-states", "reading-modes"
# The drawing of the first page marks a connection while one of these modules is called.
CONNECTING = (
    *("OrderMessage", "ReportMessage", "RcBuffer", "FirstTimer", "WheelSystem", "DirSystem"),
    *("Wheel", "SteeringDevice", "VelSensor", "CntSensor", "DirSensor", "WheelController"),
    *("DirController", "MainController", "Mode", "OperationState"),
)
# Templates of the pages on which no term is linked to the glossary.
WITHOUT_TERMS = ("source_file", "home")
# These checks need the warnings of Sphinx or the finished site. Their results are therefore unknown
# while the pages are written.
LATER = {"doc-warning", "link-doc", "link-site"}
# The states of a check when the pages are written.
HOLDS, FOUND, STALE, AFTER = "holds", "with findings", "no fresh results", "after the pages"
# These checks need test results of the present sources.
DYNAMIC = {"tree-dynamic", "req-passed", "req-line", "fsm-seen", "hazard-scenario"}


@dataclass
class Page:
    """A page of the site. ``nav`` names its entry in the navigation."""

    name: str  # path without .html
    title: str
    body: str
    nav: str
    wide: bool = False
    bare: bool = False  # true: the page is shown without the side navigation


def heading_anchor(title: str) -> str:
    """Returns the anchor that Sphinx makes from a heading."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


class Portal:
    """All values that a template may use."""

    def __init__(self, root: Path, model: Model, report: Report, checks: list[Check]) -> None:
        self.root = root
        self.model = model
        self.report = report
        self.checks = {check.id: check for check in checks}
        self.links = Links(model, set(self.checks))
        self.names = names.Names(model, self.links)
        self.calls = CallGraph(model, self.links)
        self.code = Highlighter(root, root / "build" / "pages-cache" / "code")
        self.impacts = Impacts(model)
        self.constants = constant_links(model, self.links, root)
        self.glossary = GlossaryLinks(root, self.constants)
        self.docs = hand_written(root / "docs")
        self.metrics = metrics(model, report)
        self.questions = [with_metrics(one, self.metrics) for one in questions_of(root)]
        self.tours = tours_of(root)
        self.navigation = Navigation(
            model, self.docs, len(self.checks), len(model.faults), len(self.questions)
        )
        self.designs = [m for m in model.modules.values() if not m.datatype]
        self.top_logic_modules = [m for m in model.logic_modules.values() if m.parent is None]
        self.diagrams = self._diagrams()
        finished = diagrams.draw(self.diagrams, root / "build" / "diagrams")
        self.drawn = {name: Markup(svg) for name, svg in finished.items()}
        self.templates = self._environment()
        self.row_of = functools.cache(self._row_of)

    def _diagrams(self) -> list[diagrams.Diagram]:
        return [
            *(
                diagrams.pattern_diagram(self.model, application, self.links)
                for application in self.model.patterns.values()
            ),
            *([diagrams.high_level_diagram(self.model, self.links)] if self.model.groups else []),
            *(
                diagrams.machine_diagram(machine, self.links, self.model.stale_on(HOST))
                for machine in self.model.machines.values()
            ),
            *package_diagrams(self.root),
        ]

    def _environment(self) -> Environment:
        compiled = self.root / "build" / "pages-cache" / "templates"
        compiled.mkdir(parents=True, exist_ok=True)
        templates = environment()
        templates.bytecode_cache = FileSystemBytecodeCache(str(compiled))
        templates.filters["text"] = self.names.text
        templates.filters["gist"] = names.gist
        templates.filters["changed_words"] = names.changed_words
        templates.filters["file_name"] = names.file_name
        templates.filters["anchor"] = slug
        templates.filters["bold"] = Markup("<b>{}</b>").format
        for kind in ("mod", "meth", "logic", "pat", "req", "src", "change", "check"):
            templates.filters[kind] = getattr(self.names, kind)
        templates.globals.update(
            model=self.model,
            report=self.report,
            portal=self,
            n=self.names,
            links=self.links,
            views=names.VIEWS,
            glyph=names.glyph,
            family=diagrams.role_family,
            linked_questions=functools.partial(linked_questions, self.questions),
            located=lambda svg, requirement: Markup(diagrams.located(svg, requirement)),
            chosen_values=functools.partial(chosen_values, self.root, self.model),
            other_lines=functools.partial(other_lines, self.root),
            constant_named=functools.cache(
                functools.partial(constant_named, self.root, self.model)
            ),
        )
        return templates

    def page(self, name: str, title: str, nav: str, template: str, **values: Any) -> Page:
        wide, bare = values.pop("wide", False), values.pop("bare", False)
        body = self.templates.get_template(f"{template}.html").render(**values)
        if template not in WITHOUT_TERMS:
            body = self.glossary.link(body)
        return Page(name, title, names.unbroken_options(body), nav, wide, bare)

    def view(self, name: str, values: Callable[[Portal], dict[str, Any]]) -> Page:
        """Returns the page of a navigation entry. ``values`` computes the values for the template
        of this page."""
        entry = self.navigation.entries[name]
        page = entry.address.removesuffix(".html")
        return self.page(page, entry.title, name, name, **values(self))

    def _row_of(self, test: str) -> Markup:
        """Returns the row of a test in a table. ``row_of`` stores the result, because many pages
        show the same row."""
        template = self.templates.get_template("test_row.html")
        return Markup(template.render(test=self.model.tests[test]))

    @functools.cached_property
    def runs_live(self) -> bool:
        """Returns true if the WebAssembly module was built. This module runs firmware images in a
        page."""
        return (self.root / LIVE_MODULE).exists()

    # ---- derived facts --------------------------------------------------------

    @property
    def clauses(self) -> int:
        return sum(clause.holds for clauses in self.report.clauses.values() for clause in clauses)

    def flat(self, node: TreeNode, depth: int = 0) -> list[tuple[int, TreeNode]]:
        """Returns the nodes of an invocation tree with their depths. The root is the first node."""
        below = [pair for child in node.children for pair in self.flat(child, depth + 1)]
        return [(depth, node), *below]

    def nodes(self, requirement: Requirement) -> list[tuple[int, TreeNode]]:
        """Returns the nodes of the invocation tree of a requirement, if there is a tree."""
        return self.flat(requirement.tree) if requirement.tree else []

    def element_targets(self) -> dict[str, str]:
        """Returns an address for each element of the architecture: the page of the first module
        that implements the element. The address is "" if the model contains no such module."""
        modules = self.model.modules
        return {
            element.id: next(
                (self.links.module(m) or "" for m in element.modules if m in modules), ""
            )
            for element in self.model.architecture
            if element.modules
        }

    def drawn_modules(self) -> list[str]:
        """Returns the modules of the states, and the modules in ``CONNECTING``. On the first page,
        the live view marks these modules in the drawing."""
        states = [
            module
            for name in (OPERATION_STATES, READING_MODES)
            if name in self.model.machines
            for module in self.model.machines[name].states.values()
        ]
        names = dict.fromkeys([*states, *CONNECTING])
        return [name for name in names if name in self.model.modules]

    def executed(self, requirement: Requirement) -> str:
        """Returns "ok" if a test executed the invocation tree, "bad" if no recorded test executed
        it, and "none" if no test was recorded."""
        if requirement.runs:
            return "ok"
        measured = requirement.tree is not None and requirement.tree.ran is not None
        return "bad" if measured else "none"

    def met_evidence(self, requirement: Requirement) -> int:
        """Returns the number of metrics that are evidence of a requirement and within their
        bounds."""
        measured = self.report.measured
        return sum(evidence.holds(measured[evidence.figure]) for evidence in requirement.evidence)

    def showing(self, step: Transition) -> list[str]:
        """Returns the tests in which a transition occurred. Tests that verify a requirement of the
        transition are first."""
        tests = self.model.tests
        return sorted(
            (name for name in step.tests if name in tests),
            key=lambda name: set(tests[name].verifies).isdisjoint(step.requirements),
        )

    def modules_of(self, context: ExecutionContext) -> list[str]:
        """Returns the modules of the design whose methods a context may execute."""
        names = dict.fromkeys(method.partition("::")[0] for method in context.methods)
        return [name for name in names if not self.model.modules[name].datatype]

    def interrupts_of(self, pipe: SharedPipe) -> list[str]:
        """Returns the interrupts that write or read a pipe."""
        users = [*pipe.writers.values(), *pipe.readers.values()]
        used_by = dict.fromkeys(name for contexts in users for name in contexts)
        return [name for name in used_by if self.model.contexts[name].kind == INTERRUPT]

    def contexts_of(self, module: Module) -> list[str]:
        """Returns the interrupts and threads that may run methods of a module."""
        begin = f"{module.name}::"
        return [
            context.id
            for context in self.model.contexts.values()
            if context.kind != START and any(m.startswith(begin) for m in context.methods)
        ]

    def stack_of(self, module: Module) -> tuple[int, str] | None:
        """Computes the stack bytes that the methods of a module use in the deepest chain of calls
        of each context. Returns the greatest number, and the name of its context."""
        begin = f"{module.name}::"
        stack = self.model.stack
        shares = [
            (sum(call.bytes for call in context.chain if call.name.startswith(begin)), context.name)
            for context in (stack.contexts if stack else ())
        ]
        return max((share for share in shares if share[0]), default=None)

    @functools.cached_property
    def _last_changes(self) -> dict[str, str]:
        return last_changes(self.root)

    def last_change_of(self, module: Module) -> str:
        """Returns the date and the hash of the last commit that changed a file of a module."""
        return self.last_change([file for file in (module.header, module.source) if file])

    def last_change(self, files: Sequence[str]) -> str:
        """Returns the date and the hash of the last commit that changed one of these files."""
        changes = self._last_changes.items()
        return next((commit for file, commit in changes if file in files), "")

    def changed_since(self, commit: str) -> int | None:
        return changed_since(self.root, commit)

    def path_of(self, module: Module) -> list[str]:
        """Returns the logic modules from the top to the logic module of this module."""
        path: list[str] = []
        logic = self.model.logic_modules.get(module.logic)
        while logic is not None:
            path.insert(0, logic.id)
            logic = self.model.logic_modules.get(logic.parent or "")
        return path

    def body_lines(self, place: Place | None) -> list[tuple[int, Markup]]:
        """Returns the source lines of a place as highlighted HTML, each with its line number.
        Returns an empty list if there is no place."""
        if place is None:
            return []
        lines = self.code.lines(place.file)
        last = place.end or place.line
        return [
            (number, Markup(lines[number - 1]))
            for number in range(place.line, min(last, len(lines)) + 1)
        ]

    @functools.cached_property
    def marks(self) -> dict[str, dict[int, list[str]]]:
        """Returns the methods and tests that begin at each source line, by file and line."""
        marks: dict[str, dict[int, list[str]]] = {}

        def add(place: Place, name: str) -> None:
            names = marks.setdefault(place.file, {}).setdefault(place.line, [])
            if name not in names:
                names.append(name)

        for method in self.model.methods:
            for place in (method.place, method.body):
                if place:
                    add(place, method.id)
        for test in self.model.tests.values():
            add(test.place, test.id)
        return marks

    @functools.cached_property
    def hits(self) -> dict[str, Mapping[int, bool]]:
        """For each measured source line, returns whether a test executed the line. The keys are the
        file and the line. The drivers are measured on the virtual K64, and the other files on the
        host."""
        on_host = {path: file.lines for path, file in self.model.host_files.items()}
        return {**on_host, **(self.model.board_lines or {})}

    def length(self, path: str) -> int:
        return len(self.code.lines(path))

    def tests_of(self, module: Module) -> list[Test]:
        return [self.model.tests[name] for name in module.tests if name in self.model.tests]

    def own_tests(self, module: Module) -> list[Test]:
        """Returns the tests to read first: the tests in the test file of the module, then the tests
        of the requirements that the module satisfies."""
        file = f"tests/{module.logic}/{module.name}Test.cpp"
        satisfied = {identifier for method in module.methods for identifier in method.satisfies}
        tests = sorted(self.tests_of(module), key=lambda test: test.place.file != file)
        return [t for t in tests if t.place.file == file or satisfied.intersection(t.verifies)]

    def source_of(self, source: SourceReference) -> Markup:
        """Returns the document or safety goal from which a requirement was derived. The result is a
        link if the portal has a page for this document or goal."""
        if not source.kind:
            return self.names.text(source.name)
        if source.kind == "goal":
            return Markup("safety goal {}").format(self.names.safety(source.name))
        if source.kind == "paper":
            places = self.model.paper_places
            place = next((one for one in places if one.id == source.name), None)
            address = f"@/concordance.html#{paper_anchor(source.name)}" if place else None
            title = f": {place.title}" if place else ""
            return Markup("paper, {}{}").format(names.anchor(address, source.name), title)
        if source.kind == "protocol":
            address = f"@/docs/protocol.html#{heading_anchor(source.name)}"
            return Markup("protocol, {}").format(names.anchor(address, source.name))
        return Markup("{}: {}").format(source.kind, self.names.text(source.name))

    def targets_of(self, requirement: Requirement) -> str:
        """Returns each target with at least one passed test of the requirement in this run."""
        none = "none in this run" if requirement.verified_by else "no test, see Evidence"
        targets = ", ".join(targets_of(self.model, requirement)) or none
        return f"{targets}; real board: none yet"

    def passed(self, tests: list[Test]) -> int | None:
        """Returns the number of test runs that passed. Returns ``None`` if there are no results of
        the present sources."""
        runs = [run for test in tests for run in test.results.values()]
        if self.model.results_stale or not any(run.result for run in runs):
            return None
        return sum(run.result == "passed" for run in runs)

    def share_of(self, requirement: Requirement, binding: str) -> str:
        """Returns two numbers for a requirement on a target: the passed tests, and all tests. A
        stale result does not count as passed."""
        tests = [self.model.tests[name] for name in requirement.verified_by]
        runs = [test.results[binding] for test in tests if binding in test.results]
        if not runs:
            return "\N{EN DASH}"
        passed = sum(run.result == "passed" and not run.stale for run in runs)
        return f"{passed}/{len(runs)}"

    def passed_on(self, binding: str) -> tuple[int | None, int]:
        """Returns the number of passed tests and the number of all tests on a target. The first
        number is ``None`` if the results are stale."""
        runs = [t.results[binding] for t in self.model.tests.values() if binding in t.results]
        is_fresh = not self.model.stale_on(binding)
        return sum(run.result == "passed" for run in runs) if is_fresh else None, len(runs)

    def executed_count(self, binding: str) -> int:
        return sum(binding in requirement.runs for requirement in self.model.requirements.values())

    def runs(self, tests: Iterable[Test]) -> int:
        """Returns the number of runs of the tests. A test has one run on each target for which it
        is built."""
        return sum(len(test.results) for test in tests)

    def callers(self, method: Method) -> list[Markup]:
        """Returns links to the callers of a method. A caller can also be a nested class, the
        initialiser of a constant, or a function outside classes. If the object of the call is not
        known, the link to the called abstract method follows."""
        callers = []
        for name, through in method.called_by.items():
            module, _, rest = name.partition("::")
            end = Markup(" (through {})").format(self.names.meth(through)) if through else ""
            if name in self.links.methods or name in self.model.functions:
                callers.append(self.names.meth(name) + end)
            elif module in self.model.modules:
                callers.append(Markup("{} ({}){}").format(self.names.mod(module), rest, end))
        return callers

    def computed_from(self, constant: str) -> list[Markup]:
        """Returns links to the methods and constants that use a constant. The constant is the
        result of a method, and ``constant`` is the id of this method."""
        methods = self.model.methods
        return next((self.callers(method) for method in methods if method.id == constant), [])

    def changes_of(self, module: str) -> list[str]:
        """Returns the likely changes that a module hides. A module can also implement one variant
        of a likely change. The result contains this likely change too."""
        return [
            change.application
            for change in self.model.changes.values()
            if module in (change.hidden_by, *change.altered)
        ]

    def in_paper(self, name: str) -> list[PaperElement]:
        """Returns the names that the paper uses for a module and its methods, or for a pattern
        application."""
        return [
            element
            for element in self.model.paper
            if element.where
            and any(target.split(":", 1)[1].split("::")[0] == name for target in element.here)
        ]

    def is_later(self, check: str) -> bool:
        """Returns true if the result of a check is still unknown while the pages are written. If
        the check already has a finding, its result is known."""
        return check in LATER and not self.findings_of(check)

    def verdict_of(self, check: str) -> Markup:
        """Returns the result of a check at the time when the pages are written."""
        state = self._state_of(check)
        if state == FOUND:
            return names.glyph("bad", f"{len(self.findings_of(check))} found")
        return names.glyph("ok" if state == HOLDS else "none", state)

    def _state_of(self, check: str) -> str:
        if self.findings_of(check):
            return FOUND
        if self.is_later(check):
            return AFTER
        return STALE if check in DYNAMIC and self.model.results_stale else HOLDS

    def checks_by_state(self) -> dict[str, int]:
        """Returns the number of checks in each state. A state without checks is left out."""
        counts = Counter(map(self._state_of, self.checks))
        return {state: counts[state] for state in (HOLDS, FOUND, STALE, AFTER) if counts[state]}

    def unrecorded_faults(self) -> int:
        """Returns the number of listed seeded faults that are missing in the last record. A
        published record contains the number of its faults, but not their names. With such a record,
        the result is the smallest possible number."""
        faults, last = self.model.faults, self.model.last.get("drift")
        if self.model.outcomes is not None:
            return sum(self.outcome_of(fault) is None for fault in faults)
        return max(0, len(faults) - last.tried) if last else 0

    def recorded_images(self, tests: Iterable[Test]) -> list[str]:
        """Returns the firmware images on which the tests ran. Only images for recordings are in the
        result."""
        images = {image for test in tests for run in test.results.values() for image in run.images}
        return sorted(image for image in images if image.endswith(CALLS_SUFFIX))

    def outcome_of(self, fault: Fault) -> Outcome | None:
        """Returns the result of the run with a seeded fault. Returns ``None`` if the fault was not
        tried with the present sources."""
        outcomes = self.model.outcomes or []
        return next((outcome for outcome in outcomes if outcome.name == fault.name), None)

    def verdict_on(self, fault: Fault) -> Markup:
        """Returns the verdict on a seeded fault: whether the expected check found the fault, and
        whether the compiler behaved as the fault declares."""
        outcome = self.outcome_of(fault)
        if outcome is None:
            return names.glyph("none", "not seeded")
        if outcome.compiles != fault.compiles:
            return names.glyph("bad", "does not compile" if fault.compiles else "compiles")
        return names.glyph("ok", "found") if outcome.caught else names.glyph("bad", "missed")

    def findings_of(self, check: str) -> list[Finding]:
        return [finding for finding in self.report.findings if finding.check == check]
