"""Builds the model from its sources."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from traceability import schema
from traceability.model.architecture import connections_of
from traceability.model.design_model import Model, requirement_key
from traceability.model.dictionary import with_dictionary
from traceability.model.evidence import read_evidence
from traceability.model.execution import with_execution
from traceability.model.image_code import read_image_code
from traceability.model.likely_changes import changes_of
from traceability.model.made_changes import made
from traceability.model.metrics import read_measured
from traceability.model.orphan_methods import justify
from traceability.model.pattern_price import prices
from traceability.model.promela import proofs_of
from traceability.model.response_times import prove_times
from traceability.model.reviews import with_reviews
from traceability.model.safety_case import safety_of
from traceability.model.stack import prove
from traceability.model.state_machines import machines_of
from traceability.model.tests import with_board_findings, with_executed_modules, with_tests
from traceability.model.trees import with_trees
from traceability.model.verification import with_verification
from traceability.reading.ast_facts import BodyFact, CallFact, MethodFact, Syntax
from traceability.reading.baseline_record import read_parts
from traceability.reading.bench_record import PAPER_BENCH, read_bench
from traceability.reading.build_evidence import git, read_build
from traceability.reading.change_kits import read_record as read_kit_record
from traceability.reading.closed_loop_record import read_closed_loop
from traceability.reading.comments import NO_COMMENT, Comment
from traceability.reading.comparison_record import read_comparison
from traceability.reading.coverage import Coverage, read_coverage
from traceability.reading.declared import read_declared
from traceability.reading.declared_safety import read_sources, words_of
from traceability.reading.doxygen_run import doxygen_beside
from traceability.reading.mutation_record import last_mutation, read_mutation
from traceability.reading.plain_constants import plain_constants, unambiguous
from traceability.reading.ports import read_ports
from traceability.reading.products import read_products
from traceability.reading.published import last_score, read_campaigns
from traceability.reading.results import read_branches, read_sizes
from traceability.reading.seeded_faults import last_seeded, read_faults, read_record
from traceability.reading.source_facts import Facts, gather_facts
from traceability.reading.syntax import read_syntax
from traceability.reading.traces import Traces, read_traces
from traceability.schema import HOST, VIRTUAL_K64, Place
from traceability.sources import DESIGN, SRC, files_below, source_hash, text_of

DRIVERS = f"{SRC}/k64/"


class Built(NamedTuple):
    """The model, from which pages and exports are made, and the facts about the sources. The checks
    read both."""

    model: Model
    facts: Facts


def build(root: Path) -> Built:
    root = root.resolve()
    build_folder = root / "build" / "model"
    with doxygen_beside(root, build_folder) as doxygen:
        syntax = read_syntax(root, build_folder / "cache")
        declared = read_declared(root, {**plain_constants(root), **_constants(syntax)})
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
    declared = facts.declared
    model = Model(commit(root), _version(root), source_hash(root), {})
    if declared.entries.unreadable:
        return model
    model = replace(
        model,
        modules=_modules(facts),
        constants=_constants(facts.syntax),
        tuned=declared.tuned,
        designed_modules=[name for names in declared.names.values() for name in names],
        designed_applications={item.id: item.pattern for item in declared.applications.values()},
        architecture=declared.architecture,
        groups=declared.groups,
        allowed_uses=declared.allowed,
        allowed_cycles=declared.cycles,
        kept_apart=declared.apart,
        paper=declared.concordance.entries,
        statements=declared.concordance.statements,
        paper_places=declared.concordance.places,
        closed_loop=read_closed_loop(root, declared.entries),
        equivalents=declared.equivalents,
        mutation=read_mutation(root, model.sources_hash),
        files=source_files(root),
        bench=read_bench(root),
        bench_paper=read_bench(root, PAPER_BENCH),
        products=read_products(root),
        faults=read_faults(root),
        outcomes=read_record(root),
        last=_last(root, model.sources_hash),
        campaigns=read_campaigns(root),
        build=read_build(root),
        proofs=proofs_of(root, declared),
        ports=read_ports(root, declared.entries),
        comparison=read_comparison(root),
        baseline_parts=read_parts(root, declared.entries),
    )
    model = replace(model, logic_modules=_logic_modules(model, facts))
    model = _with_calls(model, facts)
    model = replace(model, patterns=_patterns(model, facts), uses=_uses(model, facts))
    model = _with_requirements(model, facts)
    called = {call.target for body in facts.syntax.bodies for call in body.calls}
    for recordings in traces.values():
        recordings.vectors = set(model.functions) - called
    model = with_board_findings(with_tests(model, facts), facts)
    model = with_executed_modules(model, traces)
    model = replace(model, machines=machines_of(model, facts, traces, build_folder / "cache"))
    model = with_execution(model, facts)
    image = read_image_code(root)
    model = replace(
        model, stack=prove(root, model, facts, image), connections=connections_of(model, facts)
    )
    model = _with_measures(with_dictionary(model, facts), root, coverage)
    model = replace(model, times=prove_times(root, model, facts, image))
    model = replace(model, prices=prices(root, model, facts, image))
    model = with_trees(model, facts, traces, build_folder / "cache")
    model = justify(with_verification(model, facts, coverage), declared.justified)
    model = replace(model, safety=safety_of(model, facts))
    model = with_reviews(model, facts)
    examples = {name: particular.examples for name, particular in declared.particulars.items()}
    done = made(model, declared.kits, read_kit_record(root), examples)
    model = replace(model, changes=changes_of(model, declared, done))
    return replace(model, measured=read_measured(root, model))


def _last(root: Path, sources: str) -> dict[str, schema.LastRecord]:
    """Some tests do not run in each build, because they take too long. Returns the last records of
    these tests."""
    records = {
        "mutation": last_mutation(root, sources),
        "drift": last_seeded(root),
        "release": last_score(root, "release"),
    }
    return {name: record for name, record in records.items() if record}


def source_files(root: Path) -> list[str]:
    suffixes = (".hpp", ".cpp", ".h", ".dox", ".toml", ".tree", ".pml", ".S", ".ld", ".scenario")
    folders = (*DESIGN, "changes", "ports", "sim", "tests", "requirements", "design")
    paths = files_below(root, folders, suffixes)
    return [str(path.relative_to(root)) for path in paths]


def commit(root: Path) -> str:
    inside = (root / ".git").exists()
    return git(root, "rev-parse", "--short=10", "HEAD").strip() if inside else ""


def _version(root: Path) -> str:
    text = text_of(root / "CMakeLists.txt")
    match = re.search(r"project\([^)]*VERSION\s+([\d.]+)", text)
    return match[1] if match else ""


def camel(folder: str) -> str:
    return "".join(word.capitalize() for word in folder.rsplit("/", maxsplit=1)[-1].split("_"))


def _logic_modules(model: Model, facts: Facts) -> dict[str, schema.LogicModule]:
    folders = {str(Path(place.file).parent) for place in _places(facts)}
    every = {str(up) for path in folders for up in (Path(path), *Path(path).parents)}
    made = [_logic_module(model, facts, folder) for folder in every - {SRC, "."}]
    by_id = {module.id: module for module in sorted(made, key=lambda module: module.id)}
    children = {
        name: [module.id for module in by_id.values() if module.parent == name] for name in by_id
    }
    return {name: replace(module, children=children[name]) for name, module in by_id.items()}


def _places(facts: Facts) -> list[Place]:
    """Returns the places in the sources where a class or a function is defined. The functions are
    included, because some folders contain functions but no class."""
    classes = [fact.place for fact in facts.syntax.classes]
    return classes + [body.place for body in facts.syntax.bodies]


def _logic_module(model: Model, facts: Facts, folder: str) -> schema.LogicModule:
    parent = str(Path(folder).parent)
    logic = folder.removeprefix(f"{SRC}/")
    comment = facts.folders.get(folder, NO_COMMENT)
    place = Place(f"{folder}/module.dox", 1)
    if not (facts.root / place.file).exists():
        first = min(place.file for place in _places(facts) if place.file.startswith(folder))
        place = Place(first, 1)
    return schema.LogicModule(
        id=logic,
        name=camel(folder),
        parent=None if parent in (SRC, ".") else parent.removeprefix(f"{SRC}/"),
        brief=comment.brief,
        function=comment.one("function"),
        secret=comment.one("secret"),
        hides=comment.all("hides"),
        place=place,
        modules=[m.name for m in model.modules.values() if m.logic == logic and not m.datatype],
    )


def _modules(facts: Facts) -> dict[str, schema.Module]:
    modules: dict[str, schema.Module] = {}
    sources = {str(path.relative_to(facts.root)) for path in files_below(facts.root, DESIGN)}
    for fact in facts.syntax.classes:
        if not fact.place.file.endswith(".hpp"):
            continue
        comment = facts.comment(fact)
        datatype = bool(comment.of("datatype"))
        nested = "::" in fact.name
        if not datatype and (nested or fact.local or fact.kind in ("enum", "alias")):
            continue
        source = fact.place.file.removesuffix(".hpp") + ".cpp"
        modules[fact.name] = schema.Module(
            name=fact.name,
            qualified=fact.qualified,
            logic=logic_of(fact.place.file),
            abstract=fact.only_base,
            datatype=datatype,
            brief=comment.brief,
            function=comment.one("function"),
            secret=comment.one("secret"),
            hides=comment.all("hides"),
            place=Place(fact.place.file, fact.place.line, fact.end),
            header=fact.place.file,
            source=source if source in sources else None,
            bases=fact.bases,
            subclasses=sorted(facts.subclasses.get(fact.name, [])),
            roles=[
                schema.RoleBinding(tag.argument, tag.arguments[-1], fact.name, tag.place)
                for tag in comment.of("role")
            ],
            registers=[b.name for b in facts.declared.blocks if fact.name in b.owners],
            methods=[
                _method(method, facts)
                for method in fact.methods
                if not method.deleted
                and not method.name.startswith("~")
                and not (method.defaulted and method.kind == "constructor")
            ],
        )
    return {
        name: replace(module, methods=[_specified(method, modules) for method in module.methods])
        for name, module in modules.items()
    }


def _method(fact: MethodFact, facts: Facts) -> schema.Method:
    comment = facts.comment(fact)
    params = comment.texts("param")
    bodies = facts.bodies.get(fact.id, [])
    body = _body_of(fact, bodies)
    return schema.Method(
        id=fact.id,
        module=fact.owner,
        name=fact.name,
        signature=fact.signature,
        access=fact.access,
        kind=fact.kind,
        place=fact.place,
        body=body.place if body else None,
        brief=comment.brief,
        details=comment.details,
        params=[schema.Param(name, kind, params.get(name, "")) for name, kind in fact.params],
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
    """Returns the body of the overload that ``fact`` declares. ``bodies`` contains the bodies of
    all overloads of the method. If a body begins on the source line of the declaration, returns
    this body. Otherwise, returns the first body in ``bodies``, or None if ``bodies`` is empty."""
    for body in bodies:
        if body.place.file == fact.place.file and body.place.line == fact.place.line:
            return body
    return bodies[0] if bodies else None


def _specified(method: schema.Method, modules: dict[str, schema.Module]) -> schema.Method:
    """Returns the method with its specification. If the method has no comment, the specification is
    the comment of the overridden method. If that method has no comment either, the search continues
    in the next base class."""
    upper = None if method.documented else method.overrides
    while upper is not None:
        owner = modules.get(upper.rsplit("::", 1)[0])
        above = next((item for item in owner.methods if item.id == upper), None) if owner else None
        if above is None:
            break
        if above.brief:
            return replace(
                method,
                params=[
                    schema.Param(own.name or item.name, item.type, own.text or item.text)
                    for own, item in zip(method.params, above.params, strict=False)
                ],
                brief=above.brief,
                details=above.details,
                returns=method.returns or above.returns,
                errors=method.errors or above.errors,
                pre=method.pre or above.pre,
                post=method.post or above.post,
                interrupt=above.interrupt,
                documented=True,
                inherited_from=upper,
            )
        upper = above.overrides
    return method


def _with_calls(model: Model, facts: Facts) -> Model:
    functions: dict[str, schema.Function] = {}
    # (method, file of its function body, first source line of this body) -> calls in the body
    made: dict[tuple[str, str, int], list[schema.Call]] = {}
    # method -> its callers -> the abstract method that the caller calls, if the object of this call
    # is not known
    callers: dict[str, dict[str, str]] = {}
    for body in facts.syntax.bodies:
        calls = [_call(call, body, facts) for call in body.calls]
        caller = body.id
        if not body.owner:
            module = facts.user("", body.place)
            caller = f"{module}::{body.id}" if module else body.id
            # The compositions of several products contain functions with the same name. Only the
            # function of the product ``DEFAULT`` is stored.
            stored = body.id in functions and not facts.robot.contains(body.place.file)
            if not module and logic_of(body.place.file) in model.logic_modules and not stored:
                functions[body.id] = schema.Function(body.id, body.place, calls)
        made[body.id, body.place.file, body.place.line] = calls
        for call in calls:
            for target in call.targets:
                if target != body.id:
                    through = "" if call.wired or target == call.target else call.target
                    before = callers.setdefault(target, {}).get(caller, through)
                    callers[target][caller] = before and through
    for fact in facts.syntax.initial:
        callers.setdefault(fact.target, {})[fact.name] = ""

    def called(method: schema.Method) -> schema.Method:
        calls = made[method.id, method.body.file, method.body.line] if method.body else []
        return replace(method, calls=calls, called_by=callers.get(method.id, {}))

    uses, used_by, named_by = _users(model, facts)
    modules = {
        name: replace(
            module,
            methods=[called(method) for method in module.methods],
            uses=list(uses.get(name, {})),
            used_by=list(used_by.get(name, {})),
            named_by=list(named_by.get(name, {})),
        )
        for name, module in model.modules.items()
    }
    return replace(model, modules=modules, functions=functions)


def _call(call: CallFact, body: BodyFact, facts: Facts) -> schema.Call:
    targets, wired = facts.targets_in_products(call, body.owner)
    return schema.Call(call.target, call.virtual, call.place, targets, wired)


def _constants(syntax: Syntax) -> dict[str, schema.Constant]:
    folders = tuple(f"{name}/" for name in DESIGN)
    constants = unambiguous(
        (fact.name, schema.Constant(fact.number, fact.unit, fact.place))
        for fact in syntax.values
        if fact.place.file.startswith(folders)
    )
    return dict(sorted(constants.items()))


Named = dict[str, dict[str, None]]  # module -> other modules, in the order of their first use


def _users(model: Model, facts: Facts) -> tuple[Named, Named, Named]:
    """Returns three maps. The first map contains for each module the modules that it names. The
    second map contains for each module the modules that name it. Both maps leave out value types.
    The third map is the second map with the value types."""
    uses: Named = {}
    used_by: Named = {}
    named_by: Named = {}
    for named in facts.syntax.names:
        user, used = facts.user(named.by, named.place), named.target.split("::")[0]
        if user not in model.modules or used not in model.modules or user == used:
            continue
        named_by.setdefault(used, {})[user] = None
        if model.modules[used].datatype or model.modules[user].datatype:
            continue
        uses.setdefault(user, {})[used] = None
        used_by.setdefault(used, {})[user] = None
    return uses, used_by, named_by


def _patterns(model: Model, facts: Facts) -> dict[str, schema.PatternApplication]:
    bindings = [binding for module in model.modules.values() for binding in module.roles]
    applications: dict[str, schema.PatternApplication] = {}
    for module in model.modules.values():
        for part in facts.comment_of(module.name).parts("patternapp"):
            tag = part.tags[0]
            name, pattern, title = [*tag.arguments, "", "", ""][:3]
            applications[name] = schema.PatternApplication(
                id=name,
                pattern=pattern,
                title=title,
                why=part.one("why"),
                changes=part.one("changes"),
                module=module.name,
                place=tag.place,
                roles=[binding for binding in bindings if binding.application == name],
            )
    return dict(sorted(applications.items()))


def _with_requirements(model: Model, facts: Facts) -> Model:
    sections: dict[str, str] = {}
    by_id: dict[str, schema.Requirement] = {}
    for comment in facts.comments.below(("requirements",)):
        for tag in comment.of("page"):
            sections[tag.place.file] = tag.source.splitlines()[0].split(maxsplit=2)[-1]
        for part in comment.parts("requirement"):
            by_id.setdefault(part.tags[0].argument, _requirement(part, sections))
    methods: dict[str, dict[str, None]] = {}
    modules: dict[str, schema.Module] = {}
    for name, module in model.modules.items():
        tagged = [(id_, method) for method in module.methods for id_ in method.satisfies]
        for id_, method in tagged:
            methods.setdefault(id_, {})[method.id] = None
        ids = {id_ for id_, _ in tagged if id_ in by_id}
        modules[name] = replace(module, requirements=sorted(ids, key=requirement_key))
    requirements = {
        name: replace(by_id[name], satisfied_by=list(methods.get(name, {})))
        for name in sorted(by_id, key=requirement_key)
    }
    return replace(model, modules=modules, requirements=requirements)


def _requirement(part: Comment, sections: dict[str, str]) -> schema.Requirement:
    tag = part.tags[0]
    return schema.Requirement(
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


def logic_of(file: str) -> str:
    """Returns the id of the logic module that contains a file. The id is the path of the folder of
    this file, without ``src/`` at its beginning."""
    return str(Path(file).parent).removeprefix(f"{SRC}/")


def _uses(model: Model, facts: Facts) -> list[schema.Use]:
    # (folder that uses, folder that is used) -> the places of the #include directives
    use_places: dict[tuple[str, str], list[Place]] = {}
    # the same pairs of folders -> the place of a call or of a name, for pairs without an #include
    others: dict[tuple[str, str], Place] = {}
    folders = {fact.name: logic_of(fact.place.file) for fact in facts.syntax.classes}
    for include in facts.syntax.includes:
        pair = (logic_of(include.place.file), logic_of(include.target))
        use_places.setdefault(pair, []).append(include.place)
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
    use_places = {pair: [place] for pair, place in others.items()} | use_places
    return [
        schema.Use(source, target, places)
        for (source, target), places in sorted(use_places.items())
        if source != target and source.startswith(tuple(model.logic_modules))
    ]


def _declared_in(call: CallFact, facts: Facts) -> str:
    """Returns the file that declares a called function outside classes. A ``.cpp`` file can declare
    a function that another file defines. In this case, returns the file that defines the function.
    """
    written = {body.place.file for body in facts.bodies.get(call.target, [])}
    if call.declared.endswith(".cpp") and written and call.declared not in written:
        return min(written)
    return call.declared


def _with_measures(model: Model, root: Path, coverage: dict[str, Coverage]) -> Model:
    sizes = read_sizes(root)
    modules: dict[str, schema.Module] = {}
    for name, module in model.modules.items():
        flash, ram = sizes.get(name, (None, None))
        modules[name] = (
            module if module.datatype else replace(module, flash_bytes=flash, ram_bytes=ram)
        )
    branches = {} if model.stale_on(HOST) else read_branches(root)
    return replace(
        model,
        modules=modules,
        host_files=host_files_of(coverage[HOST], branches),
        board_lines=_board_lines(model, coverage[VIRTUAL_K64]),
    )


def host_files_of(
    coverage: Coverage, branches: dict[str, tuple[int, int]]
) -> dict[str, schema.FileCoverage]:
    whole, covered = coverage.whole, coverage.all
    files: dict[str, schema.FileCoverage] = {}
    for file, lines in sorted(whole.lines.items()):
        hit = covered.lines.get(file, set())
        missed = whole.branches[file] - covered.branches.get(file, set())
        files[file] = schema.FileCoverage(
            {line: line in hit for line in sorted(lines)},
            sorted({branch[0] for branch in missed}),
            branches.get(file),
        )
    return files


def _board_lines(model: Model, coverage: Coverage) -> dict[str, dict[int, bool]] | None:
    """Returns a value for each source line of the K64 drivers: true if the tests on the virtual K64
    executed the line, and otherwise false. Returns None if these tests did not run with the present
    sources.
    """
    if model.stale_on(VIRTUAL_K64) or not coverage.recordings:
        return None
    covered = coverage.all
    return {
        file: {line: line in covered.lines.get(file, set()) for line in sorted(lines)}
        for file, lines in sorted(coverage.whole.lines.items())
        if file.startswith(DRIVERS)
    }
