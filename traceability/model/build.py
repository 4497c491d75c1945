"""Puts the model together from its sources."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from typing import NamedTuple

from traceability.model.architecture import add_connections
from traceability.model.design_model import Model
from traceability.model.dictionary import add_dictionary
from traceability.model.evidence import read_evidence
from traceability.model.execution import add_execution
from traceability.model.likely_changes import add_changes
from traceability.model.metrics import read_measured
from traceability.model.orphan_methods import justify
from traceability.model.reviews import add_reviews
from traceability.model.safety_case import add_safety
from traceability.model.stack import prove
from traceability.model.state_machines import add_machines
from traceability.model.tests import add_board_findings, add_executed_modules, add_tests
from traceability.model.trees import add_trees
from traceability.model.verification import add_verification
from traceability.reading.ast_facts import BodyFact, CallFact, ClassFact, MethodFact
from traceability.reading.bench_record import read_bench, read_paper_bench
from traceability.reading.closed_loop_record import read_closed_loop
from traceability.reading.comments import NO_COMMENT, Comment
from traceability.reading.coverage import Coverage, read_coverage
from traceability.reading.declared import read_declared
from traceability.reading.declared_safety import read_sources, words_of
from traceability.reading.doxygen_run import doxygen_beside
from traceability.reading.mutation_record import read_mutation
from traceability.reading.products import read_products
from traceability.reading.results import read_sizes
from traceability.reading.seeded_fault_record import read_record
from traceability.reading.seeded_faults import read_faults
from traceability.reading.source_facts import Facts, gather_facts
from traceability.reading.syntax import read_syntax
from traceability.reading.traces import Traces, read_traces
from traceability.schema import (
    HOST,
    VIRTUAL_K64,
    Call,
    Constant,
    Function,
    LogicModule,
    Method,
    Module,
    Param,
    PatternApplication,
    Place,
    Requirement,
    RoleBinding,
    Use,
)
from traceability.sources import DESIGN, SRC, files_below, source_hash

DRIVERS = f"{SRC}/k64/"


class Built(NamedTuple):
    """The model for pages and exports, and the facts that it is made from, for the checks."""

    model: Model
    facts: Facts


def build(root: Path) -> Built:
    build_folder = root / "build" / "model"
    with doxygen_beside(root, build_folder) as doxygen:
        syntax = read_syntax(root, build_folder / "cache")
        declared = read_declared(root)
        traces = read_traces(root, build_folder)
        coverage = read_coverage(root, build_folder)
        facts = gather_facts(root, syntax, declared)
        model = _assemble(root, build_folder, facts, traces, coverage)
        facts.warnings = doxygen.warnings()
    return Built(model, facts)


def _assemble(
    root: Path,
    build_folder: Path,
    facts: Facts,
    traces: dict[str, Traces],
    coverage: dict[str, Coverage],
) -> Model:
    model = Model(
        commit=commit(root),
        version=_version(root),
        sources_hash=source_hash(root),
        results_hashes={},
    )
    if facts.declared.entries.unreadable:
        return model
    _add_logic_modules(model, facts)
    _add_modules(model, facts)
    _add_calls(model, facts)
    _add_constants(model, facts)
    _add_patterns(model, facts)
    _add_requirements(model, facts)
    _add_uses(model, facts)
    model.machines = facts.declared.machines
    names = facts.declared.names
    model.designed_modules = [name for folder in names for name in names[folder]]
    model.designed_applications = {
        item.id: item.pattern for item in facts.declared.applications.values()
    }
    model.architecture = facts.declared.architecture
    model.allowed_uses = facts.declared.allowed
    model.allowed_cycles = facts.declared.cycles
    model.kept_apart = facts.declared.apart
    called = {call.target for body in facts.syntax.bodies for call in body.calls}
    for recordings in traces.values():
        recordings.vectors = set(model.functions) - called
    add_tests(model, facts)
    add_board_findings(model, facts)
    model.closed_loop = read_closed_loop(root, facts.declared.entries)
    add_executed_modules(model, traces)
    add_machines(model, facts, traces, build_folder / "cache")
    add_execution(model, facts)
    model.stack = prove(root, model, facts)
    add_connections(model, facts)
    add_dictionary(model, facts)
    _add_measures(model, root, coverage)
    add_trees(model, facts, traces, build_folder / "cache")
    add_verification(model, facts, coverage)
    model.mutation = read_mutation(root, model.sources_hash)
    justify(model, facts.declared.justified)
    add_reviews(model, root, facts.declared.entries)
    add_safety(model, facts)
    model.paper = facts.declared.concordance.entries
    model.paper_places = facts.declared.concordance.places
    add_changes(model, facts.declared.changes)
    model.files = source_files(root)
    model.bench, model.bench_paper = read_bench(root), read_paper_bench(root)
    model.products = read_products(root)
    model.faults, model.outcomes = read_faults(root), read_record(root)
    model.measured = read_measured(root, model)
    return model


def source_files(root: Path) -> list[str]:
    suffixes = (".hpp", ".cpp", ".h", ".dox", ".toml", ".tree", ".S", ".ld")
    paths = files_below(root, (*DESIGN, "sim", "tests", "requirements", "design"), suffixes)
    return [str(path.relative_to(root)) for path in paths]


def _git(root: Path, *arguments: str) -> str:
    run = subprocess.run(
        ["git", "-C", str(root), *arguments], capture_output=True, text=True, check=False
    )
    return run.stdout.strip() if run.returncode == 0 else ""


def commit(root: Path) -> str:
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
        logic = folder.removeprefix(f"{SRC}/")
        if folder not in (SRC, "."):
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
    comment = facts.folders.get(folder, NO_COMMENT)
    place = Place(f"{folder}/module.dox", 1)
    if not (facts.root / place.file).exists():
        first = min(place.file for place in _places(facts) if place.file.startswith(folder))
        place = Place(first, 1)
    return LogicModule(
        id=folder.removeprefix(f"{SRC}/"),
        name=camel(folder),
        parent=None if parent in (SRC, ".") else parent.removeprefix(f"{SRC}/"),
        brief=comment.brief,
        function=comment.one("function"),
        secret=comment.one("secret"),
        hides=comment.all("hides"),
        place=place,
    )


def _add_modules(model: Model, facts: Facts) -> None:
    sources = {str(path.relative_to(facts.root)) for path in files_below(facts.root, DESIGN)}
    for fact in facts.syntax.classes:
        if not fact.place.file.endswith(".hpp"):
            continue
        comment = facts.comment(fact)
        datatype = bool(comment.of("datatype"))
        nested = "::" in fact.name
        if not datatype and (nested or fact.local or fact.kind in ("enum", "alias")):
            continue
        logic = logic_of(fact.place.file)
        source = fact.place.file.removesuffix(".hpp") + ".cpp"
        module = Module(
            name=fact.name,
            qualified=fact.qualified,
            logic=logic,
            abstract=fact.abstract or _for_heirs_only(fact),
            datatype=datatype,
            brief=comment.brief,
            function=comment.one("function"),
            secret=comment.one("secret"),
            hides=comment.all("hides"),
            place=Place(fact.place.file, fact.place.line, fact.end),
            header=fact.place.file,
            source=source if source in sources else None,
            bases=fact.bases,
            heirs=sorted(facts.heirs.get(fact.name, [])),
        )
        module.roles = [
            RoleBinding(tag.argument, tag.arguments[-1], fact.name, tag.place)
            for tag in comment.of("role")
        ]
        module.registers = [b.name for b in facts.declared.blocks if fact.name in b.owners]
        module.methods = [
            _method(method, facts)
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


def _for_heirs_only(fact: ClassFact) -> bool:
    """Whether only heirs can make one: all its constructors are protected."""
    made = [m.access for m in fact.methods if m.kind == "constructor" and not m.deleted]
    return bool(made) and set(made) == {"protected"}


def _method(fact: MethodFact, facts: Facts) -> Method:
    comment = facts.comment(fact)
    params = comment.texts("param")
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
        brief=comment.brief,
        details=comment.details,
        params=[Param(name, kind, params.get(name, "")) for name, kind in fact.params],
        returns=comment.one("return"),
        pre=comment.all("pre"),
        post=comment.all("post"),
        errors=comment.one("errors"),
        interrupt=comment.one("isr"),
        satisfies=comment.words("satisfies"),
        documented=bool(comment.brief),
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
            own = method.params
            method.params = [
                Param(own[i].name or item.name, item.type, own[i].text or item.text)
                for i, item in enumerate(above.params)
                if i < len(own)
            ]
            method.brief, method.details = above.brief, above.details
            method.returns = method.returns or above.returns
            method.errors = method.errors or above.errors
            method.pre, method.post = method.pre or above.pre, method.post or above.post
            method.interrupt = method.interrupt or above.interrupt
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
            # Each product has a composition of its own: the first one is that of the robot itself.
            model.functions.setdefault(body.id, Function(body.id, body.place, calls))
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


def _add_constants(model: Model, facts: Facts) -> None:
    """The constants by their names, without names that stand for several numbers."""
    found: dict[str, list[Constant]] = {}
    for fact in facts.syntax.values:
        if fact.place.file.startswith(tuple(f"{name}/" for name in DESIGN)):
            one = Constant(fact.number, fact.unit, fact.place)
            found.setdefault(fact.name, []).append(one)
    for name, ones in sorted(found.items()):
        if len({(one.number, one.unit) for one in ones}) == 1:
            model.constants[name] = ones[0]


def _add_users(model: Model, facts: Facts) -> None:
    for named in facts.syntax.names:
        user, used = facts.user(named.by, named.place), named.target.split("::")[0]
        if user not in model.modules or used not in model.modules or user == used:
            continue
        if model.modules[used].datatype or model.modules[user].datatype:
            continue
        if used not in model.modules[user].uses:
            model.modules[user].uses.append(used)
            model.modules[used].used_by.append(user)


def _add_patterns(model: Model, facts: Facts) -> None:
    for module in model.modules.values():
        for part in facts.comment_of(module.name).parts("patternapp"):
            tag = part.tags[0]
            name, pattern, title = [*tag.arguments, "", "", ""][:3]
            model.patterns[name] = PatternApplication(
                id=name,
                pattern=pattern,
                title=title,
                why=part.one("why"),
                changes=part.one("changes"),
                module=module.name,
                place=tag.place,
            )
    for module in model.modules.values():
        for binding in module.roles:
            if binding.application in model.patterns:
                model.patterns[binding.application].roles.append(binding)
    model.patterns = dict(sorted(model.patterns.items()))


def requirement_key(name: str) -> tuple[str, int]:
    kind, _, number = name.partition("-")
    return (kind, int(number) if number.isdigit() else 0)


def _add_requirements(model: Model, facts: Facts) -> None:
    sections: dict[str, str] = {}
    for comment in facts.comments.below(("requirements",)):
        for tag in comment.of("page"):
            sections[tag.place.file] = tag.source.splitlines()[0].split(maxsplit=2)[-1]
        for part in comment.parts("requirement"):
            _add_requirement(model, part, sections)
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


def _add_requirement(model: Model, part: Comment, sections: dict[str, str]) -> None:
    tag = part.tags[0]
    requirement = Requirement(
        id=tag.argument,
        text=tag.text,
        section=sections.get(tag.place.file, ""),
        place=tag.place,
        rationale=part.one("rationale"),
        source=part.one("source"),
        priority=part.one("priority"),
        level=part.one("level"),
        products=words_of(part.all("product")),
        method=part.one("method"),
        partly=part.one("partly"),
        goals=words_of(part.all("goal")),
        sources=read_sources(part.one("source")),
        evidence=[read_evidence(text, tag.place) for text in part.all("evidence")],
    )
    model.requirements.setdefault(tag.argument, requirement)


def logic_of(file: str) -> str:
    """The id of the logic module of a file: its folder, without ``src/``."""
    return str(Path(file).parent).removeprefix(f"{SRC}/")


def _add_uses(model: Model, facts: Facts) -> None:
    found: dict[tuple[str, str], list[Place]] = {}
    others: dict[tuple[str, str], Place] = {}  # the first call or name, where nothing is included
    folders = {fact.name: logic_of(fact.place.file) for fact in facts.syntax.classes}
    for include in facts.syntax.includes:
        pair = (logic_of(include.place.file), logic_of(include.target))
        found.setdefault(pair, []).append(include.place)
    for body in facts.syntax.bodies:
        for call in body.calls:
            owner = call.target.rsplit("::", 1)[0]
            declared = _declared_in(call, facts)
            target = logic_of(declared) if declared else folders.get(owner)
            if target is not None:
                others.setdefault((logic_of(body.place.file), target), call.place)
    for name in facts.syntax.names:
        target = logic_of(name.file) if name.file else folders.get(name.target)
        if target is not None:
            others.setdefault((logic_of(name.place.file), target), name.place)
    found = {pair: [place] for pair, place in others.items()} | found
    for (source, target), places in sorted(found.items()):
        if source != target and source.startswith(tuple(model.logic_modules)):
            model.uses.append(Use(source, target, places))


def _declared_in(call: CallFact, facts: Facts) -> str:
    """The file of a function outside classes; a declaration beside the call does not count."""
    written = {body.place.file for body in facts.bodies.get(call.target, [])}
    if call.declared.endswith(".cpp") and written and call.declared not in written:
        return min(written)
    return call.declared


def _add_measures(model: Model, root: Path, coverage: dict[str, Coverage]) -> None:
    whole, covered = coverage[HOST].whole, coverage[HOST].all()
    model.board_lines = _board_lines(model, coverage[VIRTUAL_K64])
    sizes = read_sizes(root)
    for module in model.modules.values():
        if module.datatype:
            continue
        for file in (module.header, module.source):
            if file is None or file not in whole.lines:
                continue
            lines, hit = whole.lines[file], covered.lines.get(file, set())
            branches, taken = whole.branches[file], covered.branches.get(file, set())
            module.line_hits[file] = {line: int(line in hit) for line in sorted(lines)}
            module.lines_total = (module.lines_total or 0) + len(lines)
            module.lines_covered = (module.lines_covered or 0) + len(lines & hit)
            module.branches_total = (module.branches_total or 0) + len(branches)
            module.branches_covered = (module.branches_covered or 0) + len(branches & taken)
        if module.name in sizes:
            module.flash_bytes, module.ram_bytes = sizes[module.name]


def _board_lines(model: Model, coverage: Coverage) -> dict[str, dict[int, bool]] | None:
    """The lines of the drivers, which this machine does not run."""
    if model.stale_on(VIRTUAL_K64) or not coverage.recordings:
        return None
    covered = coverage.all()
    return {
        file: {line: line in covered.lines.get(file, set()) for line in sorted(lines)}
        for file, lines in sorted(coverage.whole.lines.items())
        if file.startswith(DRIVERS)
    }
