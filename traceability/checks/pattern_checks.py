"""pattern-*: each application of a pattern assigns modules to all roles of the pattern, and the
code has the structure that the clauses of the pattern demand."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from traceability.checks.pattern_clauses import CLAUSES, Shape
from traceability.model.design_model import Model
from traceability.reading.declared import ClauseText, KnownApplication
from traceability.reading.source_facts import Facts
from traceability.schema import Clause, Finding, PatternApplication, Place, RoleBinding
from traceability.sources import DESIGN

ABSTRACTIONS = (
    *("State", "Strategy", "Component", "Decorator", "Command", "Abstract Class", "Builder"),
    *("Singleton", "Serializable", "Reader", "Writer"),
)
# The roles of the classes whose comments may contain @patternapp. This tag declares a pattern
# application. Usually the comment of the abstract class (for example the Strategy) contains the
# tag. If the pattern is applied several times to one abstract class, each subclass has its own tag.
DECLARING = (*ABSTRACTIONS, "Concrete Command", "Concrete Decorator", "Concrete Builder")
# The roles that a subclass can have. The role Decorator is in this list and in ABSTRACTIONS,
# because a Decorator derives from its Component and also has subclasses.
SUBCLASS_ROLES = (
    *("Concrete State", "Concrete Strategy", "Concrete Component", "Decorator"),
    *("Concrete Decorator", "Concrete Command", "Concrete Class", "Concrete Builder"),
    *("Concrete Reader", "Concrete Writer", "Concrete Element"),
)
EXTENDED = ("Concrete Component", "Decorator", "Concrete Decorator")
ALTERNATIVES = ("State", "Strategy", "Abstract Class")


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    for find in (_roles, _declared_once, _heirs, _undeclared, _lost):
        yield from find(model, facts)
    for find_declared in (_required, _counts, _undecided):
        yield from find_declared(facts)
    for application in model.patterns.values():
        yield from _known(application, facts)
        yield from _missing_roles(application, model, facts)


def decide(model: Model, facts: Facts) -> tuple[dict[str, list[Clause]], list[Finding]]:
    """Checks for every pattern application whether the code fulfils each clause of the pattern.
    Returns a map from the id of each application to its clauses, and a finding for each
    violation."""
    parts = {name: _clauses(pattern, model, facts) for name, pattern in model.patterns.items()}
    clauses = {name: clauses for name, (clauses, _) in parts.items()}
    return clauses, [finding for _, findings in parts.values() for finding in findings]


def _known(application: PatternApplication, facts: Facts) -> Iterator[Finding]:
    for text, fix in _problems(application, facts):
        yield Finding(application.place, "pattern-known", text, fix)


def _problems(item: PatternApplication, facts: Facts) -> Iterator[tuple[str, str]]:
    """Yields the faults of the tag @patternapp. Each fault has a text and a fix."""
    declared = facts.declared.applications.get(item.id)
    if declared is None:
        yield f"there is no application {item.id}", "correct the id"
    elif declared.pattern != item.pattern:
        text = f"{item.id} is an application of {declared.pattern}, not of {item.pattern}"
        yield text, "correct the pattern"
    if not any(b.module == item.module and b.role in DECLARING for b in item.roles):
        text = f"{item.module} is not the abstract class of {item.id}"
        yield text, "write the tag @patternapp above the abstract class"
    if not item.title:
        text = f"the application {item.id} has no title"
        yield text, "write the title as the third argument of the tag @patternapp"
    for tag, text in (("@why", item.why), ("@changes", item.changes)):
        if not text:
            yield f"the application {item.id} has no {tag}", f"write {tag} below @patternapp"


def _declared_once(model: Model, facts: Facts) -> Iterator[Finding]:
    first: dict[str, str] = {}
    for module in model.modules.values():
        for tag in facts.comment_of(module.name).of("patternapp"):
            name = tag.argument
            if name in first:
                words = f"{name} is already declared above {first[name]}"
                yield Finding(tag.place, "pattern-known", words, "remove one of the two tags")
            first.setdefault(name, module.name)


def _roles(model: Model, facts: Facts) -> Iterator[Finding]:
    for module in model.modules.values():
        seen: set[tuple[str, str]] = set()
        for binding in module.roles:
            problem = _role_problem(binding, model, facts)
            if problem is None and (binding.application, binding.role) in seen:
                again = f"{module.name} has two tags for {binding.role} in {binding.application}"
                problem = again, "remove one of the two tags"
            seen.add((binding.application, binding.role))
            if problem:
                text, fix = problem
                yield Finding(binding.place, "pattern-role-unknown", text, fix)


def _lost(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds @patternapp and @role tags that are not above a module. The documents would not show
    these tags."""
    above = {(b.place.file, b.place.line) for m in model.modules.values() for b in m.roles}
    above |= {(pattern.place.file, pattern.place.line) for pattern in model.patterns.values()}
    checks = {"role": "pattern-role-unknown", "patternapp": "pattern-known"}
    for comment in facts.comments.below(DESIGN):
        for tag in comment.tags:
            if tag.name in checks and (tag.place.file, tag.place.line) not in above:
                text = f"this @{tag.name} is not above a module"
                yield Finding(tag.place, checks[tag.name], text, "write it above the class")


def _role_problem(binding: RoleBinding, model: Model, facts: Facts) -> tuple[str, str] | None:
    declared = facts.declared.applications.get(binding.application)
    if declared is None:
        return f"there is no application {binding.application}", "correct the id"
    if binding.role not in declared.roles:
        roles = ", ".join(declared.roles)
        return f"{binding.application} has no role '{binding.role}'", f"use one of: {roles}"
    added = model.modules[binding.module].extension
    if binding.module not in declared.roles[binding.role] and not added:
        role = f"the role {binding.role} of {binding.application}"
        text = f"design/applications.toml does not assign {binding.module} to {role}"
        return text, "correct the role, or change design/applications.toml"
    if binding.application not in model.patterns:
        text = f"the application {binding.application} is not declared"
        return text, "declare the application with the tag @patternapp above its abstract class"
    return None


def _undeclared(model: Model, facts: Facts) -> Iterator[Finding]:
    for item in facts.declared.applications.values():
        if item.id not in model.patterns:
            text = f"no module declares the application {item.id}"
            fix = "write the tag @patternapp of the application above its abstract class"
            yield Finding(item.place, "pattern-known", text, fix)


def _undecided(facts: Facts) -> Iterator[Finding]:
    """Finds clauses in design/clauses.toml that have no function in pattern_clauses.py. In
    pattern_clauses.py, finds functions that have no clause."""
    clauses = facts.declared.clauses
    if not clauses:
        return
    for name in CLAUSES.keys() - clauses.keys():
        text = f"the clause {name} is not declared, so its function is never used"
        place = Place("design/clauses.toml", 1)
        yield Finding(place, "pattern-known", text, "write a clause with this id")
    for clause in clauses.values():
        for text, word, fix in _clause_problems(clause, facts):
            yield Finding(facts.line_in(clause.place, word), "pattern-known", text, fix)


def _clause_problems(clause: ClauseText, facts: Facts) -> Iterator[tuple[str, str, str]]:
    """Yields the faults of a clause. Each fault has a text, the word to which the finding points,
    and a fix."""
    if clause.id not in CLAUSES:
        fix = "correct the id, or write its function in traceability/checks/pattern_clauses.py"
        yield f"no function decides the clause {clause.id}", clause.id, fix
    if not clause.id.startswith(f"pattern-{clause.pattern.split()[0].lower()}-"):
        text = f"{clause.id} is not a clause of the pattern {clause.pattern}"
        yield text, clause.pattern, "correct the pattern"
        return
    roles = {pattern.name: pattern.roles for pattern in facts.declared.patterns}
    for role in clause.about:
        if role not in roles.get(clause.pattern, []):
            yield f"{role} is not a role of {clause.pattern}", role, "correct the role"


def _counts(facts: Facts) -> Iterator[Finding]:
    """Finds patterns whose number of applications differs from the number in the paper."""
    patterns = Counter(item.pattern for item in facts.declared.applications.values())
    for pattern in facts.declared.patterns:
        count, expected = patterns[pattern.name], pattern.applications
        if count != expected:
            text = f"the design has {count} applications of {pattern.name}, not {expected}"
            yield Finding(pattern.place, "pattern-count", text)


def _required(facts: Facts) -> Iterator[Finding]:
    """Finds pattern applications in the design with wrong roles: a role has no module, a role is
    unknown, or the module of a role does not exist."""
    patterns = {pattern.name: pattern.roles for pattern in facts.declared.patterns}
    for item in facts.declared.applications.values():
        for text, word in _wrong_roles(item, patterns, facts):
            yield Finding(facts.line_in(item.place, word), "pattern-role-required", text)


def _wrong_roles(
    item: KnownApplication, patterns: dict[str, list[str]], facts: Facts
) -> Iterator[tuple[str, str]]:
    """Yields the faults in the roles of a pattern application. Each fault has a text, and the word
    to which the finding points."""
    if item.pattern not in patterns:
        yield f"there is no pattern {item.pattern} ({item.id})", "pattern"
    roles = patterns.get(item.pattern, list(item.roles))
    for role in roles:
        if not item.roles.get(role):
            yield f"{item.id} assigns no module to the role {role}", "roles"
    for role, modules in item.roles.items():
        if role not in roles:
            yield f"{role} is not a role of {item.pattern} ({item.id})", role
        for module, count in Counter(modules).items():
            if count > 1:
                yield f"{item.id} assigns {module} to the role {role} twice", f'"{module}"'
            if module not in facts.classes:
                assigned = f"to which the design assigns the role {role} in {item.id}"
                yield f"there is no module {module}, {assigned}", module


def _missing_roles(
    application: PatternApplication, model: Model, facts: Facts
) -> Iterator[Finding]:
    declared = facts.declared.applications.get(application.id)
    bound = {(item.role, item.module) for item in application.roles}
    for role, modules in (declared.roles if declared else {}).items():
        for module in modules:
            if module in model.modules and (role, module) not in bound:
                text = f"{module} has no @role as {role} in {application.id}"
                yield Finding(model.modules[module].place, "pattern-role-missing", text)


def _heirs(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds subclasses that have no role although their base class has one. A Command that is
    nested in a module needs no role, because it contains only the code of a thread."""
    findings: dict[str, Finding] = {}
    for application in model.patterns.values():
        for binding in application.roles:
            if binding.role not in ABSTRACTIONS:
                continue
            for subclass in facts.subclasses.get(binding.module, []):
                fact = facts.classes[subclass]
                body = binding.role == "Command" and "::" in subclass and not fact.local
                if body or _has_subclass_role(subclass, binding, model, facts):
                    continue
                text = (
                    f"{subclass} has no role of a subclass, but derives from {binding.module}, "
                    f"which is {binding.role} in {application.id}"
                )
                finding = Finding(fact.place, "pattern-subclass-unbound", text)
                findings.setdefault(subclass, finding)
    yield from findings.values()


def _has_subclass_role(subclass: str, binding: RoleBinding, model: Model, facts: Facts) -> bool:
    """Returns whether a class has the role of a subclass in this pattern application, or in another
    application that is sufficient.

    For most patterns, a role in any application of one of the base classes is sufficient. Each
    subclass of a Command or of a Builder, for example, has its own application. For State, Strategy
    and Abstract Class, the role must belong to this application. There is one exception: Decorators
    and their components need no second role.
    """
    module = model.modules.get(subclass)
    for role in module.roles if module else []:
        if role.role not in SUBCLASS_ROLES or role.application not in model.patterns:
            continue
        above = {
            binding.module
            for binding in model.patterns[role.application].roles
            if binding.role in ABSTRACTIONS and subclass in facts.subclasses.get(binding.module, [])
        }
        whole = binding.role not in ALTERNATIVES or role.role in EXTENDED
        if above and (whole or role.application == binding.application):
            return True
    return False


def _clauses(
    application: PatternApplication, model: Model, facts: Facts
) -> tuple[list[Clause], list[Finding]]:
    """Checks whether a pattern application fulfils each clause of its pattern. Returns the clauses
    with their results, and a finding for each violation."""
    clauses: list[Clause] = []
    findings: list[Finding] = []
    shape = Shape(application, facts)
    for clause in facts.declared.clauses.values():
        if clause.pattern != application.pattern or clause.id not in CLAUSES:
            continue
        broken = list({(p.file, p.line, t): (p, t) for p, t in CLAUSES[clause.id](shape)}.values())
        places = [place for place, _ in broken] or _about(application, clause, model)
        clauses.append(Clause(clause.id, clause.says, not broken, places))
        findings += [
            Finding(place, clause.id, f"{text} ({application.id})", clause.fix)
            for place, text in broken
        ]
    return clauses, findings


def _about(application: PatternApplication, clause: ClauseText, model: Model) -> list[Place]:
    """Returns the places of the modules whose roles the clause mentions."""
    return [
        model.modules[binding.module].place
        for binding in application.roles
        if binding.role in clause.about and binding.module in model.modules
    ]
