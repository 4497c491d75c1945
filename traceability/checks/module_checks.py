"""module-*: each design module has its own header, one function, one secret and a complete
description of its interface."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from traceability.checks.register_checks import REGISTERS
from traceability.model.design_model import Model
from traceability.model.dictionary import unit_text
from traceability.reading.ast_facts import BodyFact
from traceability.reading.comments import Comment
from traceability.reading.graphs import descendants
from traceability.reading.products import LIST as PRODUCT_LIST
from traceability.reading.products import listed
from traceability.reading.source_facts import Facts, is_constructor
from traceability.schema import Finding, Method, Module, Place, is_extension
from traceability.sources import DESIGN, SRC, text_of

FEWEST_WORDS = 3  # smallest number of words of a useful sentence
FEWEST_OF_BRIEF = 2  # smallest number of words of a brief: a verb and its object
NUMBER = re.compile(r"\b(u?int\d+_t|size_t|int|unsigned|short|long|float|double)\b")
# A description of a number must contain one of these words. They show the meaning of the number: a
# unit, a count, the number of an item, bytes, or the value of a field.
MEANING = re.compile(
    r"\[.+?\]|\bunit\b|\bnumbers?\b|\bbytes?\b|\bfields?\b|\bcount|\bhow many\b|\bsteps?\b"
    r"|\bfactor\b|\braw\b|\bcheck sum\b|\bits value\b|\bidentif",
    re.IGNORECASE,
)


# Types of values with a unit. The description of such a value must state the unit, or must state
# that the value has no meaning.
QUANTITY = re.compile(
    r"(const )?(std::optional<)?(Velocity|Tension|Current|Angle|StepRate|DutyCycle|Microseconds)\b"
)
UNIT = re.compile(r"\[.+?\]|\bnot used\b|\bno meaning\b")
UNITS = re.compile(r"\[([^\]]+)\]")
ASSERTIONS = "AssertId"  # enumeration of the assertions
PROMISE = re.compile(r"\b(to be (written|done|defined|decided)|TODO|TBD|FIXME)\b", re.IGNORECASE)
INTERRUPT = re.compile(r"(yes|no)$|depends on ")  # the permitted texts of @isr


def check(model: Model, facts: Facts) -> list[Finding]:
    findings: list[Finding] = []
    secrets: dict[str, str] = {}
    functions: dict[str, str] = {}
    for module in model.modules.values():
        if module.datatype:
            continue
        comment = facts.comment_of(module.name)
        findings += _place_and_name(module, facts)
        findings += _function(module, comment, functions)
        findings += _secret(module, comment, secrets)
        for method in module.methods:
            if method.access == "public":
                findings += _specification(method)
    general = (_folders, _written, _products, _unused, _unused_parts)
    for find in (*general, _assertions, _behaviour, _units):
        findings += find(model, facts)
    findings += _nested(facts)
    return [*findings, *_silent(facts, findings)]


def _unused(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds modules that are part of no product. The search starts at the compositions of the
    products. From there, it follows the names of classes in the code, and the base classes."""
    # Module -> classes that its code names. The key "" contains the classes that the compositions
    # name.
    named: dict[str, set[str]] = {}
    for name in facts.syntax.names:
        user = facts.user(name.by, name.place)
        owner = user if user in model.modules else ""
        named.setdefault(owner, set()).add(name.target.split("::")[0])
    used = descendants("", named)
    for module in model.modules.values():
        if not module.datatype and module.name not in used and named.get(""):
            text = (
                f"no composition uses {module.name}, directly or through other modules, so no "
                "product contains it"
            )
            yield Finding(module.place, "module-used", text)


def _unused_parts(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds unused members that are objects of a design module: the code constructs such a member,
    but no function uses the member, and no other object gets a reference to it."""
    used = {place for flow in facts.syntax.flows for place in flow.sources}
    for body in facts.syntax.bodies:
        used |= {f"field {member}" for member in body.touches}
        used |= {place for call in body.calls for place in call.on}
        used |= {place for call in body.calls for argument in call.args for place in argument}
    for owner in facts.syntax.classes:
        for part in owner.fields if owner.place.file.startswith(DESIGN) else ():
            modules = [model.modules[name] for name in part.classes if name in model.modules]
            behaves = any(not module.datatype for module in modules)
            own = not (part.refers or part.static)
            if behaves and own and f"field {owner.name}::{part.name}" not in used:
                text = f"{owner.name}::{part.name} is constructed, but no other object uses it"
                yield Finding(part.place, "module-used", text, "pass it on, or remove it")


def _assertions(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds methods with a wrong assertion in @errors: neither the method nor a called function
    contains this assertion."""
    named = {
        value.name for one in facts.syntax.classes if one.name == ASSERTIONS for value in one.values
    }
    overriding: dict[str, list[str]] = {}
    for body in facts.syntax.bodies:
        overriding.setdefault(body.overrides or "", []).append(body.id)
    for module in model.modules.values():
        # An overriding method has the documentation of the overridden method.
        for method in (one for one in module.methods if one.kind != "override"):
            whole = f"{module.name}::{method.name}"
            promised = named.intersection(re.findall(r"\w+", method.errors))
            start = list(filter(facts.robot.own_bodies, (whole, *overriding.get(whole, []))))
            if not promised or not start:
                continue
            reached = facts.robot.reached(start, {}, [])
            bodies = [body for name in reached for body in facts.robot.own_bodies(name)]
            found = {name for body in bodies for name in _asserted(facts, body)}
            for name in sorted(promised - found):
                said = f"@errors of {whole} names {name}"
                text = f"{said}, but neither the method nor a called function has this assertion"
                yield Finding(method.place, "module-errors", text)


def _asserted(facts: Facts, body: BodyFact) -> list[str]:
    lines = text_of(facts.root / body.place.file).splitlines()
    return re.findall(rf"{ASSERTIONS}::(\w+)", "\n".join(lines[body.place.line - 1 : body.end]))


def _products(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds names in design/products.toml for which no module exists, and modules of the extensions
    that this file does not list."""
    file = str(PRODUCT_LIST)
    products = listed(facts.root) if (facts.root / PRODUCT_LIST).exists() else []
    place = Place(file, 1)
    named = {name for product in products for name in product.has}
    for module in model.modules.values() if products else ():
        concrete = not module.abstract and not module.datatype
        extends = module.header.startswith("extensions/") and concrete
        if extends and module.name not in named:
            text = f"{file} does not list {module.name}"
            yield Finding(module.place, "module-used", text, "add the module to a part")
    for name in sorted(named - model.modules.keys()):
        text = f"{file} lists {name}, which is not a module"
        line = facts.line_in(place, f'"{name}"')
        yield Finding(line, "module-used", text, "correct the name")


def _behaviour(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds conditions and loops in methods of data types."""
    for body in facts.syntax.bodies:
        if (module := model.modules.get(body.owner)) and module.datatype and body.branches:
            text = f"{body.id} has a condition or a loop, but {body.owner} is a data type"
            yield Finding(body.place, "module-data", text)


def _place_and_name(module: Module, facts: Facts) -> Iterator[Finding]:
    folder = Path(module.header).parent
    if not (facts.root / folder / "module.dox").exists() or str(folder) in DESIGN:
        text = f"{module.name} is in {folder}, which is not the folder of a logic module"
        yield Finding(module.place, "module-logic", text)
    if Path(module.header).stem != module.name:
        text = f"the module {module.name} is in {Path(module.header).name}"
        yield Finding(module.place, "module-name", text)
    names = facts.declared.names
    if names and not module.extension and module.name not in names.get(module.logic, []):
        text = f"{module.name} is not a module of {module.logic} in design/modules.toml"
        yield Finding(module.place, "module-count", text)


def _written(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds names in design/modules.toml for which the code has no module. Also reports if the
    number of listed modules differs from the number in the paper."""
    names = facts.declared.names
    written = {name: str(Path(fact.place.file).parent) for name, fact in facts.classes.items()}
    for logic, place in facts.declared.name_places.items():
        folder = folder_of(logic)
        for name in names[logic]:
            if written.get(name) != folder:
                text = f"there is no module {name} in {folder}"
                fix = f"write {folder}/{name}.hpp, or correct design/modules.toml"
                yield Finding(place, "module-count", text, fix)
    for module in model.modules.values():
        if module.datatype and module.name in names.get(module.logic, []):
            logic = module.logic
            text = f"{module.name} has a @datatype, but the design lists it as a module of {logic}"
            yield Finding(module.place, "module-count", text)
    listed = [name for folder in names for name in names[folder]]
    different, total = len(set(listed)), facts.declared.total
    if total is not None and {len(listed), different} != {total}:
        text = (
            f"the design lists {len(listed)} modules with {different} different names, but the "
            f"paper has {total} modules"
        )
        yield Finding(Place("design/modules.toml", 1), "module-count", text)


def _function(module: Module, comment: Comment, functions: dict[str, str]) -> Iterator[Finding]:
    count = len([words for words in comment.all("function") if words])
    if not module.brief:
        wrong = f"{module.name} has no @brief"
    elif count != 1:
        wrong = f"{module.name} has {count or 'no'} @function"
    elif words_of(module.function) in functions:
        wrong = f"{module.name} states the same function as {functions[words_of(module.function)]}"
    else:
        functions[words_of(module.function)] = module.name
        return
    yield Finding(module.place, "module-function", wrong)


def says(text: str) -> bool:
    """Returns whether a text is long enough for a sentence and contains no placeholder such as
    TODO."""
    return len(text.split()) >= FEWEST_WORDS and not PROMISE.search(text)


def words_of(text: str) -> str:
    """Returns the text in lower case, without punctuation."""
    return " ".join(re.findall(r"\w+", text.casefold()))


def _nested(facts: Facts) -> Iterator[Finding]:
    """Finds public nested classes without a @brief."""
    modules = facts.modules
    for fact in facts.syntax.classes:
        public = fact.access == "public" and fact.name.split("::")[0] in modules
        if public and not facts.comment(fact).brief:
            yield Finding(fact.place, "module-spec", f"{fact.name} is public, but has no @brief")


def _silent(facts: Facts, findings: list[Finding]) -> Iterator[Finding]:
    """In headers, finds public declarations without a comment. Registers need no comment, because
    the manual of the microcontroller describes them."""
    spec = [finding.place for finding in findings if finding.check == "module-spec"]
    seen = {(place.file, place.line) for place in spec}
    for declaration in facts.syntax.silent:
        place = declaration.place
        if (place.file, place.line) in seen or place.file == REGISTERS:
            continue
        if place.end is None or not _has_words(place, facts):
            # A constructor needs no brief, but its parameters need descriptions.
            tag = "@param" if is_constructor(declaration.name.split("<")[0]) else "@brief"
            yield Finding(place, "module-spec", f"{declaration.name} is public, but has no {tag}")
    for fact in facts.syntax.classes:
        described = facts.comment(fact).words("tparam")
        for name in fact.parameters if described else ():
            if name not in described:
                text = f"the template parameter {name} of {fact.name} has no @tparam"
                yield Finding(fact.place, "module-spec", text)


def _units(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds a parameter, a result or a data member if the unit in its description differs from the
    unit of its type."""
    # each element: place, name, type, description
    texts: list[tuple[Place, str, str, str]] = []
    for module in model.modules.values():
        for method in module.methods:
            texts += [
                (method.place, f"{param.name} of {method.id}", param.type, param.text)
                for param in method.params
            ]
            result = _result_of(method).rpartition(" ")[0]
            texts.append((method.place, f"the result of {method.id}", result, method.returns))
    for fact in facts.classes.values():
        texts += [
            (field.place, f"{fact.name}::{field.name}", field.type, facts.comment(field).brief)
            for field in fact.fields
        ]
    for place, name, kind, text in texts:
        said = UNITS.findall(text)
        unit = UNITS.findall(unit_text(kind, model)) if said else []
        if unit and unit[0].split(" since ")[0] not in said:
            wrong = f"the text of {name} has the unit [{said[0]}], but its type has [{unit[0]}]"
            yield Finding(place, "module-spec", wrong)


def _has_words(place: Place, facts: Facts) -> bool:
    """Returns whether a declaration has a comment. An object that is declared as ``extern`` needs
    no comment."""
    if facts.comments.at(place.file, place.end or 0).tags:
        return True
    above, line = facts.lines_of(place.file)[max(0, place.line - 2) : place.line]
    return above.strip().startswith("//") or "//" in line or line.startswith("extern ")


def _secret(module: Module, comment: Comment, secrets: dict[str, str]) -> Iterator[Finding]:
    count = len([secret for secret in comment.all("secret") if says(secret)])
    secret = words_of(module.secret)
    if count != 1:
        wrong = f"{module.name} has {count or 'no'} {'secrets' if count else 'secret'}"
    elif secret in (words_of(module.function), words_of(module.brief)):
        wrong = f"the secret of {module.name} repeats its public texts"
    elif secret in secrets:
        wrong = f"{module.name} states the same secret as {secrets[secret]}"
    else:
        secrets[secret] = module.name
        return
    yield Finding(module.place, "module-secret", wrong)


def _specification(method: Method) -> Iterator[Finding]:
    missing: list[str] = []
    # A constructor that only stores its arguments needs no brief.
    needs_brief = method.kind != "constructor" or method.brief
    if needs_brief and len(method.brief.split()) < FEWEST_OF_BRIEF:
        missing.append("@brief")
    missing += [f"name for a {param.type} parameter" for param in method.params if not param.name]
    missing += [f"@param {param.name}" for param in method.params if param.name and not param.text]
    missing += [
        f"text with the unit or meaning of the number {param.name}"
        for param in method.params
        if param.text and NUMBER.search(param.type) and not MEANING.search(param.text)
    ]
    missing += [
        f"text with the unit of {param.name}"
        for param in method.params
        if param.text and QUANTITY.match(param.type) and not UNIT.search(param.text)
    ]
    if _gives_result(method):
        if not method.returns:
            missing.append("@return")
        elif NUMBER.search(_result_of(method)) and not MEANING.search(method.returns):
            missing.append("text with the unit or meaning of the result")
    if method.kind != "constructor" and not INTERRUPT.match(method.interrupt):
        missing.append("@isr{yes} or @isr{no}")
    for what in missing:
        yield Finding(method.place, "module-spec", f"{method.id} has no {what}")


def _gives_result(method: Method) -> bool:
    if method.kind == "constructor":
        return False
    words = _result_of(method)
    return not words.startswith("void ") and " " in words


def _result_of(method: Method) -> str:
    """Returns the beginning of the signature: the type of the result and the name of the method."""
    return method.signature.split("(")[0].removeprefix("virtual ").removeprefix("static ")


def folder_of(logic: str) -> str:
    return logic if is_extension(logic) else f"{SRC}/{logic}"


def _folders(model: Model, facts: Facts) -> Iterator[Finding]:
    secrets: dict[str, str] = {}
    for logic in model.logic_modules.values():
        if logic.id not in facts.folders and not logic.place.file.endswith(".dox"):
            missing = ["@dir"]
        else:
            texts = {"@brief": logic.brief, "@function": logic.function, "@secret": logic.secret}
            missing = [name for name, text in texts.items() if not text]
            if not missing and not says(logic.secret):
                missing = ["@secret with a text of its own"]
            secret = words_of(logic.secret)
            if not missing and secret in (words_of(logic.function), words_of(logic.brief)):
                missing = ["@secret that differs from its public description"]
            elif not missing and secrets.setdefault(secret, logic.id) != logic.id:
                missing = [f"@secret of its own, because {secrets[secret]} has the same"]
        for name in missing:
            text = f"the logic module {logic.id} has no {name}"
            yield Finding(logic.place, "module-folder", text)
