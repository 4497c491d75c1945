"""Puts the model together from its sources."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from traceability.model.annotations import Annotations, MemberText, Text, read_annotations
from traceability.model.declared import Declared, read_declared
from traceability.model.results import (
    Result,
    bindings_of,
    read_coverage,
    read_driver_faults,
    read_results,
    read_results_hash,
    read_sizes,
)
from traceability.model.schema import (
    BINDINGS,
    HOST,
    BindingResult,
    Call,
    Function,
    LogicModule,
    Method,
    Model,
    Module,
    Param,
    PatternApplication,
    Place,
    Requirement,
    RoleBinding,
    Test,
    TreeNode,
    TreeRun,
    Use,
)
from traceability.model.syntax import (
    BodyFact,
    ClassFact,
    MethodFact,
    Syntax,
    is_board,
    read_syntax,
)
from traceability.model.traces import (
    Row,
    Traces,
    embed,
    excerpt,
    nodes_of,
    read_traces,
    recorded_nodes,
)
from traceability.sources import files_below, source_hash

BOARD_TESTS = "tests/sim/k64/"
TEST_MACRO = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)")


@dataclass
class Facts:
    """What the model was made from. Checks that need more than the model read it here."""

    root: Path
    annotations: Annotations
    syntax: Syntax
    declared: Declared
    heirs: dict[str, list[str]]  # class -> all classes below it
    overriders: dict[str, list[str]]  # method -> all methods that override it
    bodies: dict[str, list[BodyFact]]
    classes: dict[str, ClassFact]

    def targets(self, method: str, virtual: bool) -> list[str]:
        """The methods that a call can reach."""
        return [method, *self.overriders.get(method, [])] if virtual else [method]

    def method(self, owner: str, name: str) -> MethodFact | None:
        """The method that ``owner`` has or inherits."""
        fact = self.classes.get(owner)
        if fact is None:
            return None
        for method in fact.methods:
            if method.name == name:
                return method
        for base in fact.bases:
            found = self.method(base, name)
            if found is not None:
                return found
        return None


def build(root: Path) -> Model:
    build_folder = root / "build" / "model"
    annotations = read_annotations(root, build_folder)
    syntax = read_syntax(root, build_folder / "cache")
    facts = _facts(root, annotations, syntax, read_declared(root))
    model = Model(
        commit=_commit(root),
        version=_version(root),
        sources_hash=source_hash(root),
        results_hashes={},
    )
    _add_logic_modules(model, facts)
    _add_modules(model, facts)
    _add_calls(model, facts)
    _add_patterns(model, facts)
    _add_requirements(model, facts)
    _add_uses(model, facts)
    model.machines = facts.declared.machines
    model.architecture = facts.declared.architecture
    model.allowed_uses = facts.declared.allowed
    traces = read_traces(root, build_folder)
    called = {call.target for body in syntax.bodies for call in body.calls}
    for recordings in traces.values():
        recordings.vectors = set(model.functions) - called
    _add_tests(model, facts)
    _add_board_findings(model, facts)
    _add_executed_modules(model, traces)
    _add_measures(model, root)
    _add_trees(model, facts, traces)
    _set_states(model)
    model.files = source_files(root)
    model.facts = facts
    return model


def source_files(root: Path) -> list[str]:
    suffixes = (".hpp", ".cpp", ".h", ".dox", ".toml", ".tree", ".S", ".ld")
    paths = files_below(root, ("src", "sim", "tests", "requirements", "design"), suffixes)
    return [str(path.relative_to(root)) for path in paths]


def _facts(root: Path, annotations: Annotations, syntax: Syntax, declared: Declared) -> Facts:
    classes = {fact.name: fact for fact in syntax.classes}
    heirs: dict[str, list[str]] = {}
    overriders: dict[str, list[str]] = {}
    methods = {method.id: method for fact in syntax.classes for method in fact.methods}
    for fact in syntax.classes:
        above, known = list(fact.bases), set()
        while above:
            base = above.pop()
            if base in known:
                continue
            known.add(base)
            heirs.setdefault(base, []).append(fact.name)
            above += classes[base].bases if base in classes else []
    for method in methods.values():
        upper = method.overrides
        while upper is not None:
            overriders.setdefault(upper, []).append(method.id)
            upper = methods[upper].overrides if upper in methods else None
    bodies: dict[str, list[BodyFact]] = {}
    for body in syntax.bodies:
        bodies.setdefault(body.id, []).append(body)
    return Facts(root, annotations, syntax, declared, heirs, overriders, bodies, classes)


def _git(root: Path, *arguments: str) -> str:
    run = subprocess.run(
        ["git", "-C", str(root), *arguments], capture_output=True, text=True, check=False
    )
    return run.stdout.strip() if run.returncode == 0 else ""


def _commit(root: Path) -> str:
    return _git(root, "rev-parse", "--short=10", "HEAD") if (root / ".git").exists() else ""


def _version(root: Path) -> str:
    path = root / "CMakeLists.txt"
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    match = re.search(r"project\([^)]*VERSION\s+([\d.]+)", text)
    return match[1] if match else ""


def camel(folder: str) -> str:
    return "".join(word.capitalize() for word in folder.rsplit("/", maxsplit=1)[-1].split("_"))


def _add_logic_modules(model: Model, facts: Facts) -> None:
    folders = {str(Path(place.file).parent) for place in _places(facts)}
    for folder in {str(up) for path in folders for up in (Path(path), *Path(path).parents)}:
        logic = folder.removeprefix("src/")
        if folder not in ("src", "."):
            model.logic_modules[logic] = _logic_module(facts, folder, str(Path(folder).parent))
    model.logic_modules = dict(sorted(model.logic_modules.items()))
    for logic_module in model.logic_modules.values():
        if logic_module.parent:
            model.logic_modules[logic_module.parent].children.append(logic_module.id)


def _places(facts: Facts) -> list[Place]:
    """Where classes and functions stand: a folder may hold functions only."""
    classes = [fact.place for fact in facts.syntax.classes]
    return classes + [body.place for body in facts.syntax.bodies]


def _logic_module(facts: Facts, folder: str, parent: str) -> LogicModule:
    described = facts.annotations.folders.get(folder)
    text = described.text if described else Text()
    place = Place(f"{folder}/module.dox", 1)
    if not (facts.root / place.file).exists():
        first = min(place.file for place in _places(facts) if place.file.startswith(folder))
        place = Place(first, 1)
    return LogicModule(
        id=folder.removeprefix("src/"),
        name=camel(folder),
        parent=None if parent == "src" else parent.removeprefix("src/"),
        brief=text.brief,
        function=text.one("Function"),
        secret=text.one("Secret"),
        place=place,
    )


def _add_modules(model: Model, facts: Facts) -> None:
    sources = {str(path.relative_to(facts.root)) for path in files_below(facts.root, ("src",))}
    for fact in facts.syntax.classes:
        described = facts.annotations.classes.get(fact.qualified)
        text = described.text if described else Text()
        if not fact.place.file.endswith(".hpp"):
            continue
        nested = "::" in fact.name
        if not text.datatype and (nested or fact.kind in ("enum", "alias")):
            continue
        logic = str(Path(fact.place.file).parent).removeprefix("src/")
        source = fact.place.file.removesuffix(".hpp") + ".cpp"
        module = Module(
            name=fact.name,
            qualified=fact.qualified,
            logic=logic,
            abstract=fact.abstract,
            datatype=text.datatype,
            brief=text.brief,
            function=text.one("Function"),
            secret=text.one("Secret"),
            place=Place(fact.place.file, fact.place.line, fact.end),
            header=fact.place.file,
            source=source if source in sources else None,
            bases=fact.bases,
            heirs=sorted(facts.heirs.get(fact.name, [])),
        )
        module.roles = [
            RoleBinding(application, role, fact.name, place)
            for (application, role), place in zip(
                text.roles, comment_places(facts.root, fact.place, r"[@\\]role\{"), strict=False
            )
        ]
        module.registers = [b.name for b in facts.declared.blocks if fact.name in b.owners]
        members = described.members if described else []
        module.methods = [
            _method(method, _member_text(method, members), facts)
            for method in fact.methods
            if not method.deleted
            and not method.name.startswith("~")
            and not (method.defaulted and method.kind == "constructor")
        ]
        model.modules[fact.name] = module
        if logic in model.logic_modules and not module.datatype:
            model.logic_modules[logic].modules.append(fact.name)
    for module in model.modules.values():
        for method in module.methods:
            _inherit_specification(method, model)


def comment_places(root: Path, place: Place, pattern: str) -> list[Place]:
    """The lines of the comment above a declaration that match."""
    lines = (root / place.file).read_text(encoding="utf-8").splitlines()
    number = place.line - 1
    while number > 0 and not lines[number - 1].lstrip().startswith(("///", "*", "/*")):
        if lines[number - 1].rstrip().endswith((";", "}")):
            return []
        number -= 1
    found: list[Place] = []
    while number > 0 and lines[number - 1].lstrip().startswith(("///", "*", "/*")):
        found += [Place(place.file, number) for _ in re.findall(pattern, lines[number - 1])]
        number -= 1
    return found[::-1]


def _member_text(method: MethodFact, members: list[MemberText]) -> MemberText | None:
    near = [
        member
        for member in members
        if member.name == method.name
        and member.place.file == method.place.file
        and abs(member.place.line - method.place.line) <= 3
    ]
    return min(near, key=lambda item: abs(item.place.line - method.place.line), default=None)


def _method(fact: MethodFact, member: MemberText | None, facts: Facts) -> Method:
    text = member.text if member else Text()
    bodies = facts.bodies.get(fact.id, [])
    body = _body_of(fact, bodies)
    return Method(
        id=fact.id,
        module=fact.owner,
        name=fact.name,
        signature=fact.signature,
        access=fact.access,
        kind=fact.kind,
        place=fact.place,
        body=Place(body.place.file, body.place.line, body.end) if body else None,
        brief=text.brief,
        details=text.details,
        params=[Param(name, kind, text.params.get(name, "")) for name, kind in fact.params],
        returns=text.returns,
        pre=text.pre,
        post=text.post,
        errors=text.one("Errors"),
        interrupt=text.one("Interrupt"),
        satisfies=member.satisfies if member else [],
        documented=bool(text.brief),
        overrides=fact.overrides,
    )


def _body_of(fact: MethodFact, bodies: list[BodyFact]) -> BodyFact | None:
    """The body of this very overload when it stands in the class, else the first one."""
    for body in bodies:
        if body.place.file == fact.place.file and body.place.line == fact.place.line:
            return body
    return bodies[0] if bodies else None


def _inherit_specification(method: Method, model: Model) -> None:
    if method.documented:
        return
    upper = method.overrides
    while upper is not None:
        owner = model.modules.get(upper.rsplit("::", 1)[0])
        above = next((item for item in owner.methods if item.id == upper), None) if owner else None
        if above is None:
            return
        if above.brief and above.inherited_from is None:
            names = [item.name for item in method.params]
            method.params = [
                Param(names[i] or item.name, item.type, item.text)
                for i, item in enumerate(above.params)
                if i < len(names)
            ]
            method.brief, method.details = above.brief, above.details
            method.returns, method.errors = above.returns, above.errors
            method.pre, method.post = above.pre, above.post
            method.interrupt = above.interrupt
            method.documented = True
            method.inherited_from = upper
            return
        upper = above.overrides


def _add_calls(model: Model, facts: Facts) -> None:
    methods: dict[str, list[Method]] = {}
    for module in model.modules.values():
        for method in module.methods:
            methods.setdefault(method.id, []).append(method)
    for body in facts.syntax.bodies:
        calls = [
            Call(call.target, call.virtual, call.place, facts.targets(call.target, call.virtual))
            for call in body.calls
        ]
        folder = model.logic_modules.get(logic_of(body.place.file))
        if not body.owner and folder is not None and not folder.modules:
            model.functions[body.id] = Function(body.id, body.place, calls)
        for method in methods.get(body.id, []):
            if method.body and (method.body.file, method.body.line) == (
                body.place.file,
                body.place.line,
            ):
                method.calls = calls
        for target in {target for call in calls for target in call.targets}:
            for method in methods.get(target, []):
                if body.id not in method.called_by and body.id != target:
                    method.called_by.append(body.id)
    _add_users(model, facts)


def _add_users(model: Model, facts: Facts) -> None:
    for named in facts.syntax.names:
        user, used = named.by.split("::")[0], named.target.split("::")[0]
        if user not in model.modules or used not in model.modules or user == used:
            continue
        if model.modules[used].datatype or model.modules[user].datatype:
            continue
        if used not in model.modules[user].uses:
            model.modules[user].uses.append(used)
            model.modules[used].used_by.append(user)


def _add_patterns(model: Model, facts: Facts) -> None:
    for module in model.modules.values():
        described = facts.annotations.classes.get(module.qualified)
        text = described.text if described else Text()
        ids = text.all("Application")
        places = comment_places(facts.root, module.place, r"[@\\]patternapp\{")
        for number, name in enumerate(ids):
            after = _sections_after(text, number)
            model.patterns[name] = PatternApplication(
                id=name,
                pattern=after.get("Pattern", ""),
                title=after.get("Title", ""),
                why=after.get("Why", ""),
                changes=after.get("Changes", ""),
                module=module.name,
                place=places[number] if number < len(places) else module.place,
            )
    for module in model.modules.values():
        for binding in module.roles:
            if binding.application in model.patterns:
                model.patterns[binding.application].roles.append(binding)
    model.patterns = dict(sorted(model.patterns.items()))


def _sections_after(text: Text, number: int) -> dict[str, str]:
    """The paragraphs that belong to the n-th application in a comment."""
    found: dict[str, str] = {}
    seen = -1
    for title, words in text.sections:
        if title == "Application":
            seen += 1
        if seen == number:
            found.setdefault(title, words)
    return found


def requirement_key(name: str) -> tuple[str, int]:
    kind, _, number = name.partition("-")
    return (kind, int(number) if number.isdigit() else 0)


def _add_requirements(model: Model, facts: Facts) -> None:
    for item in facts.annotations.requirements.values():
        model.requirements[item.id] = Requirement(
            id=item.id,
            text=item.title,
            section=facts.annotations.pages.get(item.place.file, ""),
            place=item.place,
            rationale=item.text.one("Rationale"),
            source=item.text.one("Source"),
            verification=item.text.one("Verification"),
            priority=item.text.one("Priority"),
        )
    model.requirements = dict(
        sorted(model.requirements.items(), key=lambda entry: requirement_key(entry[0]))
    )
    for module in model.modules.values():
        for method in module.methods:
            for name in method.satisfies:
                requirement = model.requirements.get(name)
                if requirement is None:
                    continue
                if method.id not in requirement.satisfied_by:
                    requirement.satisfied_by.append(method.id)
                if name not in module.requirements:
                    module.requirements.append(name)
        module.requirements.sort(key=requirement_key)


def logic_of(file: str) -> str:
    return str(Path(file).parent).removeprefix("src/")


def _add_uses(model: Model, facts: Facts) -> None:
    found: dict[tuple[str, str], list[Place]] = {}
    folders = {fact.name: logic_of(fact.place.file) for fact in facts.syntax.classes}
    for include in facts.syntax.includes:
        pair = (logic_of(include.place.file), logic_of(include.target))
        found.setdefault(pair, []).append(include.place)
    for body in facts.syntax.bodies:
        for call in body.calls:
            owner = call.target.rsplit("::", 1)[0]
            target = logic_of(call.declared) if call.declared else folders.get(owner)
            if target is not None:
                pair = (logic_of(body.place.file), target)
                places = found.setdefault(pair, [])
                if not places:
                    places.append(call.place)
    for (source, target), places in sorted(found.items()):
        if source != target and source.startswith(tuple(model.logic_modules)):
            model.uses.append(Use(source, target, places))


def _add_tests(model: Model, facts: Facts) -> None:
    """Each test with its results. A binding that has tests is to have results of these sources."""
    results = {binding: read_results(facts.root, binding) for binding in BINDINGS}
    tested = {
        binding for member in facts.annotations.tests for binding in bindings_of(member.place.file)
    }
    for binding in BINDINGS:
        if binding in tested or binding == HOST:
            model.results_hashes[binding] = read_results_hash(facts.root, binding)
    lines: dict[str, list[str]] = {}
    for member in facts.annotations.tests:
        file = member.place.file
        if file not in lines:
            lines[file] = (facts.root / file).read_text(encoding="utf-8").splitlines()
        macro = _test_name(lines[file], member.place.line)
        if macro is None:
            continue
        suite, case = macro
        model.tests[f"{suite}.{case}"] = Test(
            id=f"{suite}.{case}",
            suite=suite,
            name=case,
            brief=member.text.brief,
            place=member.place,
            verifies=member.verifies,
            results={
                binding: _result_of(results[binding].get(f"{suite}.{case}"), model, binding)
                for binding in bindings_of(file)
            },
        )
    for test in model.tests.values():
        for name in test.verifies:
            if name in model.requirements:
                model.requirements[name].verified_by.append(test.id)


def _result_of(found: Result | None, model: Model, binding: str) -> BindingResult:
    stale = model.stale_on(binding)
    if found is None:
        return BindingResult(stale=stale)
    milliseconds = round(found.milliseconds, 3)
    return BindingResult(found.result, milliseconds, found.message, stale, found.recordings)


def _test_name(lines: list[str], line: int) -> tuple[str, str] | None:
    match = TEST_MACRO.match(" ".join(lines[line - 1 : line + 2]))
    return (match[1], match[2]) if match else None


def _add_board_findings(model: Model, facts: Facts) -> None:
    """A test of the virtual board makes a finding when its text names the id."""
    model.board_findings = facts.declared.board_findings
    model.driver_faults = read_driver_faults(facts.root, model.sources_hash)
    lines: dict[str, list[str]] = {}
    tests = [test for test in model.tests.values() if test.place.file.startswith(BOARD_TESTS)]
    for test in tests:
        file = test.place.file
        if file not in lines:
            lines[file] = (facts.root / file).read_text(encoding="utf-8").splitlines()
        starts = [other.place.line for other in tests if other.place.file == file]
        end = min((line for line in starts if line > test.place.line), default=None)
        body = "\n".join(lines[file][test.place.line - 1 : end and end - 1])
        for finding in model.board_findings.values():
            if f'"{finding.id}"' in body:
                finding.tests.append(test.id)


def _add_executed_modules(model: Model, recordings: dict[str, Traces]) -> None:
    for test in model.tests.values():
        classes = {Path(test.place.file).stem.removesuffix("Test")}
        for binding, result in test.results.items():
            for name in recordings[binding].tests.intersection(result.recordings):
                called = recordings[binding].methods(name)
                classes |= {method.split("::")[0] for method in called}
        test.modules = sorted(
            name for name in classes if name in model.modules and not model.modules[name].datatype
        )
        for name in test.modules:
            model.modules[name].tests.append(test.id)


def _add_measures(model: Model, root: Path) -> None:
    coverage = read_coverage(root)
    sizes = read_sizes(root)
    for module in model.modules.values():
        if module.datatype:
            continue
        for file in (module.header, module.source):
            if file is None or file not in coverage:
                continue
            measured = coverage[file]
            module.line_hits[file] = measured.lines
            module.lines_total = (module.lines_total or 0) + len(measured.lines)
            hit = sum(1 for hits in measured.lines.values() if hits)
            module.lines_covered = (module.lines_covered or 0) + hit
            taken = sum(branch[0] for branch in measured.branches.values())
            module.branches_covered = (module.branches_covered or 0) + taken
            total = sum(branch[1] for branch in measured.branches.values())
            module.branches_total = (module.branches_total or 0) + total
        if module.name in sizes:
            module.flash_bytes, module.ram_bytes = sizes[module.name]


def _add_trees(model: Model, facts: Facts, recordings: dict[str, Traces]) -> None:
    known = {
        method.id
        for fact in facts.syntax.classes
        for method in fact.methods
        if (top := model.modules.get(fact.name.split("::")[0])) and not top.datatype
    }
    runs = [Run(binding, traces, facts, known) for binding, traces in recordings.items()]
    for name, (_, tree) in facts.declared.trees.items():
        requirement = model.requirements.get(name)
        if requirement is None or tree is None:
            continue
        requirement.tree = tree
        _resolve(tree, facts)
        _reach(tree, facts)
        for run in runs:
            _execute(model, requirement, run)


def _resolve(tree: TreeNode, facts: Facts) -> None:
    for node in nodes_of(tree):
        owner, _, name = node.label.rpartition("::")
        method = facts.method(owner, name)
        node.resolved = method.id if method else None
        if method is not None and not node.children:
            node.outside = [one for one in BINDINGS if not accepted_on(one, node, facts)]


def accepted(node: TreeNode, facts: Facts) -> set[str]:
    """The methods whose call counts as the node: its own, or an overrider when it has no body."""
    if node.resolved is None:
        return set()
    if node.resolved in facts.bodies:
        return {node.resolved}
    return set(facts.overriders.get(node.resolved, []))


def accepted_on(binding: str, node: TreeNode, facts: Facts) -> set[str]:
    """Those of them that a binding has: methods of the K64 are not on the host."""
    return {
        method
        for method in accepted(node, facts)
        if binding != HOST or not all(is_board(b.place.file) for b in facts.bodies.get(method, []))
    }


def _bodies_of(node: TreeNode, facts: Facts) -> list[BodyFact]:
    return [body for method in accepted(node, facts) for body in facts.bodies.get(method, [])]


def _reach(tree: TreeNode, facts: Facts) -> None:
    tree.reachable = tree.resolved is not None
    for node in nodes_of(tree):
        targets = {
            target
            for body in _bodies_of(node, facts)
            for call in body.calls
            for target in facts.targets(call.target, call.virtual)
        }
        for child in node.children:
            wanted = accepted(child, facts) | {child.resolved or ""}
            if child.kind == "post":
                child.reachable = "ControlThread::post" in targets and _is_activated(wanted, facts)
            else:
                child.reachable = bool(wanted & targets)


def _is_activated(wanted: set[str], facts: Facts) -> bool:
    """A thread executes a command: the body is one, or a command calls it."""
    commands = set(facts.overriders.get("Command::execute", []))
    called = {
        target
        for command in commands
        for body in facts.bodies.get(command, [])
        for call in body.calls
        for target in facts.targets(call.target, call.virtual)
    }
    return bool(wanted & (commands | called))


@dataclass
class Run:
    """What the recordings of a binding are searched with."""

    binding: str
    traces: Traces
    facts: Facts
    known: set[str]  # methods of design modules
    read: dict[str, list[Row]] = field(default_factory=dict)

    def rows(self, recording: str) -> list[Row]:
        if recording not in self.read:
            self.read[recording] = self.traces.rows(recording, self.known.__contains__)
        return self.read[recording]

    def accepts(self, node: TreeNode) -> set[str]:
        return accepted_on(self.binding, node, self.facts)


def _execute(model: Model, requirement: Requirement, run: Run) -> None:
    """Looks for the tree in the recordings of passing tests, the shortest first."""
    tree = requirement.tree
    passing = {
        recording: name
        for name in requirement.verified_by
        if run.binding in model.tests[name].gave("passed")
        for recording in model.tests[name].results[run.binding].recordings
        if recording in run.traces.tests
    }
    if tree is None or not passing:
        return
    nodes = nodes_of(tree)
    order = {id(node): number for number, node in enumerate(nodes)}
    furthest = 0
    for name in sorted(passing, key=lambda one: (run.traces.file(one).stat().st_size, one)):
        rows = run.rows(name)
        found = embed(tree, rows, run.accepts)
        if found.failed is None:
            shown, start, numbers = excerpt(rows, sorted(found.rows.values()))
            places = [numbers.get(found.rows.get(id(node), -1)) for node in nodes]
            requirement.runs[run.binding] = TreeRun(passing[name], shown, start, places)
            furthest = len(nodes)
            break
        furthest = max(furthest, order[id(found.failed)])
    for node in recorded_nodes(tree, run.binding):
        node.executed[run.binding] = order[id(node)] < furthest


def _set_states(model: Model) -> None:
    for requirement in model.requirements.values():
        requirement.reasons = _reasons(model, requirement)
        if any(model.tests[name].gave("failed") for name in requirement.verified_by):
            requirement.state = "failed"
        elif requirement.reasons:
            requirement.state = "unverified"
        else:
            requirement.state = "stale" if model.results_stale else "verified"


def _reasons(model: Model, requirement: Requirement) -> list[str]:
    """Why a requirement is not verified."""
    reasons: list[str] = []
    if not requirement.satisfied_by:
        reasons.append("no method satisfies it")
    if not requirement.verified_by:
        reasons.append("no test verifies it")
    for result, words in (("failed", "failed"), ("skipped", "skipped"), (None, "did not run")):
        for binding in BINDINGS:
            tests = [n for n in requirement.verified_by if binding in model.tests[n].gave(result)]
            if tests:
                reasons.append(f"{words} on the {binding}: {', '.join(tests)}")
    if requirement.tree is None:
        return [*reasons, "it has no tree of invocations"]
    nodes = nodes_of(requirement.tree)
    reasons += [f"no call reaches {node.label}" for node in nodes if not node.reachable]
    if not requirement.runs:
        reasons.append("no passing test executed its tree")
    return reasons
