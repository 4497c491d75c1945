"""req-* and suspect-*: each requirement is satisfied by code, and is verified by passed tests or by
metrics.

Also checks that the texts on which a requirement depends are unchanged since the baseline, and that
each recorded review is valid.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

from traceability.model.design_model import Model
from traceability.model.evidence import CHECKS, reasons
from traceability.model.metrics import METHODS
from traceability.model.orphan_methods import methods_without, tests_without
from traceability.model.reviews import BASELINE, NAMES_OF_TEXTS
from traceability.reading.ast_facts import ANY_CLASS, BodyFact
from traceability.reading.gtest_cases import empty_loops, read_tests, unknown_macros
from traceability.reading.products import DIFFERENT, HAS, PRODUCTS
from traceability.reading.results import TOTALS, read_image
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import headings, texts_below
from traceability.schema import (
    HOST,
    SOURCE_KINDS,
    Evidence,
    Finding,
    Justified,
    Place,
    Requirement,
    Suspicion,
)
from traceability.sources import DESIGN, text_of

TAGGED = ("src", "extensions", "tests")
TEST_BUILD = "tests/CMakeLists.txt"
CONFORMING = "patterns.conforming"
DISABLED, SKIPS = "DISABLED_", "GTEST_SKIP("
PRIORITIES = ("high", "medium", "low")
LEVELS = ("system", "software", "driver")
_VERBS = {"method": "satisfies", "test": "verifies"}
# Kind of a changed text -> end of the name of the check (suspect-...) that reports the change.
_LINKS = {
    **dict.fromkeys(("requirement", "tree", "goal", "transition"), "requirement"),
    **dict.fromkeys(("method", "body", "constants"), "method"),
    **dict.fromkeys(("test", "support", "justification"), "test"),
}


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    of_model = (_texts, _attributes, _tags, _requirements, _stale, _results, _without, _unneeded)
    for find in (*of_model, _lines, _suspects, _reviews):
        yield from find(model)
    of_facts = (_unknown, _tagged, _switched_off, _sources, _uncalled, _equivalents, _unbuilt)
    for find_in in (*of_facts, _old_image, _elsewhere):
        yield from find_in(model, facts)
    yield from _twice(facts)
    yield from _macros(facts)


def _texts(model: Model) -> Iterator[Finding]:
    """Finds requirements whose text contains no "shall", and requirements with a missing attribute
    such as the rationale."""
    for requirement in model.requirements.values():
        parts = {
            "sentence with 'shall'": " shall " in requirement.text,
            "@rationale": requirement.rationale,
            "@source": requirement.source,
            f"@priority ({', '.join(PRIORITIES)})": requirement.priority in PRIORITIES,
        }
        for part, there in parts.items():
            if not there:
                yield Finding(requirement.place, "req-text", f"{requirement.id} has no {part}")


def _attributes(model: Model) -> Iterator[Finding]:
    """Finds requirements whose level, product or method of verification has a wrong value."""
    for requirement in model.requirements.values():
        wrong = []
        if requirement.level not in LEVELS:
            wrong.append(f"no valid @level ({', '.join(LEVELS)})")
        if requirement.method not in METHODS:
            wrong.append(f"no valid @method ({', '.join(METHODS)})")
        elif not _has_way(requirement):
            way = "test" if requirement.method == "test" else "@evidence"
            wrong.append(f"the @method {requirement.method}, but no {way}")
        if not requirement.products:
            wrong.append("no @product (all, or names of products)")
        unknown = set(requirement.products) - {"all", *PRODUCTS}
        wrong += [f"a @product {name}, which does not exist" for name in sorted(unknown)]
        wrong += _wrong_products(requirement)
        for words in wrong:
            text = f"{requirement.id} has {words}"
            yield Finding(requirement.place, "req-attribute", text)


def _wrong_products(requirement: Requirement) -> list[str]:
    """Returns the errors in the products of a functional requirement. The modules that satisfy the
    requirement determine the products."""
    modules = {method.split("::")[0] for method in requirement.satisfied_by}
    if not modules or not requirement.id.startswith("FR-") or not requirement.products:
        return []
    named = set(PRODUCTS) if "all" in requirement.products else set(requirement.products)
    contained = {name: {m for m in modules if m not in DIFFERENT or m in HAS[name]} for name in HAS}
    return [
        f"no @product {name}, but this product contains all modules that satisfy "
        f"{requirement.id}; add it to @product"
        for name in sorted(HAS.keys() - named)
        if contained[name] == modules
    ] + [
        f"the @product {name}, but this product contains no module that satisfies "
        f"{requirement.id}; remove it from @product"
        for name in sorted(HAS.keys() & named)
        if not contained[name]
    ]


def _has_way(requirement: Requirement) -> bool:
    ways = {"test": requirement.verified_by, "inspection": ["a person"]}
    return bool(ways.get(requirement.method, requirement.evidence))


def _sources(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds requirements whose @source has no known kind, or names something that does not exist (a
    place of the paper, a goal, a chapter or a data sheet)."""
    protocol = facts.root / "docs" / "protocol.rst"
    names = {
        "paper": {place.id for place in model.paper_places},
        "goal": set(model.safety.goals),
        "protocol": set(headings(protocol)),
        "data sheet": set(model.safety.data_sheets),
    }
    for requirement in model.requirements.values():
        for source in requirement.sources:
            if not source.kind:
                text = f"the source '{source.name}' of {requirement.id} has no kind"
                fix = f"begin the source with one of: {':, '.join(SOURCE_KINDS)}:"
            elif source.kind in names and source.name not in names[source.kind]:
                named = f"{source.kind}: {source.name}"
                text = f"{requirement.id} has the source {named}, which does not exist"
                fix = "correct the name"
            elif source.kind == "goal" and source.name not in requirement.goals:
                text = f"{requirement.id} has the source {source.name}, but no @goal {source.name}"
                fix = f"write the tag @goal {source.name}, or remove the source"
            else:
                continue
            yield Finding(requirement.place, "req-source", text, fix)


def _without(model: Model) -> Iterator[Finding]:
    """Finds methods and tests that serve no requirement and have no entry in
    design/justified.toml."""
    justified = {name for item in model.justified for name in item.covers}
    for _, method in methods_without(model):
        if method.id not in justified:
            yield Finding(method.place, "req-method", f"{method.id} serves no requirement")
    for test in tests_without(model):
        if test.id not in justified:
            yield Finding(test.place, "req-test", f"{test.id} verifies no requirement")


def _elsewhere(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds tags @satisfies that are not at a method of a module. No page shows such a tag."""
    methods = [method for name in model.modules for method in facts.classes[name].methods]
    places = {facts.comment(method).place for method in methods}
    for comment in facts.comments.below(DESIGN):
        for tag in comment.of("satisfies") if comment.place not in places else ():
            text = f"@satisfies {tag.argument} is not in the comment of a method of a module"
            fix = "move the tag to a method of the module, or remove it"
            yield Finding(tag.place, "req-method", text, fix)


def _uncalled(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds public methods that no code of the firmware calls and that design/justified.toml does
    not list."""
    called = {
        target
        for body in facts.syntax.bodies
        for call in body.calls
        for target in facts.targets(call.target, call.virtual)
    }
    called |= {f"{name.target}::{name.member}" for name in facts.syntax.names if name.member}
    spare = {
        method.id: method
        for module in model.modules.values()
        for method in module.methods
        if method.access == "public" and method.kind != "constructor" and not module.datatype
        if not {method.id, f"{ANY_CLASS}::{method.name}"} & called and method.name.isidentifier()
    }
    entries = [entry for entry in facts.declared.justified if entry.kind == "uncalled"]
    named = {name for entry in entries for name in entry.names}
    for name, method in spare.items():
        if name not in named:
            yield Finding(method.place, "req-caller", f"no code of the firmware calls {name}")
    for entry in entries:
        for name in entry.names:
            if name not in spare:
                text = f"{name} needs no justification: it has a caller, or is not a public method"
                yield Finding(entry.place, "req-justified", text)


def _unneeded(model: Model) -> Iterator[Finding]:
    for item in model.justified:
        if (spare := _spare(item)) and not (item.kind == "line" and model.stale_on(HOST)):
            text = f"this justification of a {item.kind} is no longer needed for {', '.join(spare)}"
            yield Finding(item.place, "req-justified", text)


def _equivalents(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds entries of design/mutants.toml whose source line does not exist in the method. If all
    mutants were tried, also finds entries with a change that a test found, or that no mutant
    makes."""
    bodies: dict[tuple[str, str], list[BodyFact]] = {}
    for body in facts.syntax.bodies:
        bodies.setdefault((body.place.file, body.id), []).append(body)
    whole = model.mutation is not None and len(model.mutation.tried) == model.mutation.total
    missed = {
        (mutant.place.file, mutant.method, mutant.change)
        for mutant in (model.mutation.tried if model.mutation else [])
        if mutant.why
    }
    for entry in facts.declared.equivalents:
        lines = [
            line.strip()
            for body in bodies.get((entry.file, entry.method), [])
            for line in facts.lines_of(entry.file)[body.place.line - 1 : body.end]
        ]
        if entry.line not in lines:
            text = f"{entry.method} in {entry.file} does not contain the line: {entry.line}"
            yield Finding(entry.place, "req-justified", text)
        for change in entry.changes if whole else []:
            if (entry.file, entry.method, change) not in missed:
                found = f"a test finds this change of {entry.method}"
                text = f"{found}, or no mutant makes the change: {change}"
                yield Finding(entry.place, "req-justified", text)


def _spare(item: Justified) -> Sequence[str]:
    """Returns those names of a justification that are no longer necessary. If at least one name of
    an entry is necessary, each name with "/" (a file or a folder) is regarded as necessary too."""
    if not item.covers:
        return item.names
    return [name for name in item.names if "/" not in name and name not in item.covers]


def _stale(model: Model) -> Iterator[Finding]:
    for binding, made_from in model.results_hashes.items():
        if model.stale_on(binding):
            text = f"the test results of the {binding} are older than the sources"
            if made_from is None:
                text = f"there are no test results of the {binding}"
            place = _first_place(model, partial(_is_tested_on, model, binding))
            yield Finding(place, "req-stale", text)


def _is_tested_on(model: Model, binding: str, requirement: Requirement) -> bool:
    tests = (model.tests[name] for name in requirement.verified_by if name in model.tests)
    return any(binding in test.results for test in tests)


def _first_place(model: Model, concerns: Callable[[Requirement], bool]) -> Place:
    """Returns the place of the first requirement to which a finding applies. Findings about test
    results point to this place, because test results are not in a source file."""
    ordered = sorted(model.requirements.values(), key=lambda one: not concerns(one))
    return ordered[0].place if ordered else Place("requirements", 1)


def _old_image(model: Model, facts: Facts) -> list[Finding]:
    """Returns a finding if the firmware image is older than the sources. In this case, the checks
    of the image and of its stack do not run."""
    if not (facts.root / TOTALS).exists() or read_image(facts.root) is not None:
        return []
    text = "the firmware image is older than the sources, so no check compares its size and stack"
    place = _first_place(model, lambda one: bool(one.evidence))
    return [Finding(place, "req-stale", text, "run ./wr firmware")]


def _requirements(model: Model) -> Iterator[Finding]:
    for requirement in model.requirements.values():
        if requirement.by_calls and not requirement.satisfied_by:
            text = f"no method satisfies {requirement.id}"
            yield Finding(requirement.place, "req-satisfied", text)
        if not requirement.evidence and not requirement.verified_by:
            yield Finding(requirement.place, "req-verified", f"no test verifies {requirement.id}")


def unmet(
    model: Model, measured: Mapping[str, float | None], others: Sequence[Finding] = ()
) -> Iterator[Finding]:
    """Finds metrics of requirements (@evidence) that were not measured or do not meet their bound.

    ``others`` are the findings of the other checks. If one of these findings already shows the
    problem, the problem is not reported again. Examples are a metric that counts findings, and a
    metric that was not measured because the results are stale.
    """
    checks = {finding.check for finding in others}
    for requirement in model.requirements.values():
        for evidence in requirement.evidence:
            if not _is_reported(evidence, measured[evidence.figure], checks):
                for reason in reasons(evidence, measured[evidence.figure]):
                    text = f"{requirement.id} is not met: {reason}"
                    yield Finding(evidence.place, "req-evidence", text)


def _is_reported(evidence: Evidence, value: float | None, checks: set[str]) -> bool:
    """Returns whether the findings of the other checks already report that a metric does not meet
    its bound."""
    if value is None:
        known = bool(evidence.relation) and not evidence.figure.startswith(CHECKS)
        return known and "req-stale" in checks
    if evidence.figure == CONFORMING:
        return any(check.startswith("pattern-") for check in checks)
    return evidence.figure.startswith(CHECKS) and value > 0


def _results(model: Model) -> Iterator[Finding]:
    words = {"failed": "failed", "skipped": "was skipped", None: "did not run"}
    for test in model.tests.values():
        for binding, result in test.results.items():
            if result.result == "passed" or result.stale:
                continue
            text = f"{test.id} {words[result.result]} on the {binding}"
            if test.verifies:
                text += f", but it verifies {', '.join(test.verifies)}"
            if test.verifies or result.result is None:
                yield Finding(test.place, "req-passed", text)


def _unbuilt(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds folders whose tests are in no test program."""
    text = text_of(facts.root / TEST_BUILD)
    words = {word.strip("./") for word in re.findall(r"[\w./]+", text)}
    folders: dict[str, Place] = {}
    for test in model.tests.values():
        folders.setdefault(str(Path(test.place.file).parent), Place(test.place.file, 1))
    for folder, place in folders.items():
        if words and not _built(Path(folder), words):
            text = f"{TEST_BUILD} has no program with the tests of {folder}"
            yield Finding(place, "req-passed", text, "name the folder in this file")


def _built(folder: Path, words: set[str]) -> bool:
    """Returns whether the CMake file of the tests names the folder or one of its parent folders."""
    above = [folder, *folder.parents]
    return any(str(folder.relative_to("tests")) in words for folder in above if folder.parts[1:])


def _unknown(model: Model, facts: Facts) -> Iterator[Finding]:
    tagged: list[tuple[Place, str]] = []
    for machine in model.machines.values():
        for transition in machine.transitions:
            tagged += [(transition.place, name) for name in transition.requirements]
    for scenario in model.closed_loop:
        names = [figure.requirement for figure in scenario.figures if figure.requirement]
        tagged += [(facts.line_in(scenario.place, name), name) for name in names]
    for place, name in tagged:
        if name not in model.requirements:
            yield Finding(place, "req-unknown", f"there is no requirement {name}")


def _tagged(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds @satisfies and @verifies tags that name no existing requirement, or several
    requirements. Several ids in one tag are a fault, because Doxygen reads only the first id."""
    for comment in facts.comments.below(TAGGED):
        for tag in comment.tags:
            if tag.name in _VERBS.values():
                if tag.argument not in model.requirements:
                    text = f"there is no requirement {tag.argument}"
                    yield Finding(tag.place, "req-unknown", text)
                if tag.text:
                    text = f"this @{tag.name} names more than one requirement"
                    fix = "write a tag for each requirement"
                    yield Finding(tag.place, "req-unknown", text, fix)


def _twice(facts: Facts) -> Iterator[Finding]:
    """Finds ids that more than one requirement has."""
    seen: set[str] = set()
    for comment in facts.comments.below(("requirements",)):
        for tag in comment.of("requirement"):
            if tag.argument in seen:
                text = f"{tag.argument} is already the id of another requirement"
                yield Finding(tag.place, "req-text", text, "write a new id")
            seen.add(tag.argument)


def _tags(model: Model) -> Iterator[Finding]:
    """Finds tests whose name begins with the id of a requirement, although the tests have no
    @verifies for this requirement."""
    for test in model.tests.values():
        match = re.match(r"(N?FR)_?(\d+)_", test.name)
        name = f"{match[1]}-{match[2]}" if match else ""
        if name and name not in test.verifies:
            text = f"{test.id} is named after {name} but does not verify it"
            yield Finding(test.place, "req-name", text)


def _lines(model: Model) -> Iterator[Finding]:
    """Finds source lines of a method that need a justification, but have none in
    design/justified.toml. A line needs a justification if no test of the method's requirements
    executes the line."""
    if model.stale_on(HOST):
        return
    for gap in model.line_gaps:
        if not gap.reason:
            lines = f"line{'s' if len(gap.lines) > 1 else ''} {', '.join(map(str, gap.lines))}"
            tests = f"no test of {', '.join(gap.requirements) or 'any requirement'}"
            yield Finding(gap.place, "req-line", f"{tests} executes {lines} of {gap.method}")


def _suspects(model: Model) -> Iterator[Finding]:
    """Returns one finding for each text that changed since the baseline. The finding names all
    requirements that depend on this text."""
    asking: dict[Suspicion, list[str]] = {}
    for requirement in model.requirements.values():
        for suspicion in requirement.suspicions:
            asking.setdefault(suspicion, []).append(requirement.id)
    for suspicion, ids in asking.items():
        fix = (
            f"check the text, or let a person review it with ./wr review {ids[0]}; then record the "
            f"present text: ./wr review --baseline {' '.join(ids)}"
        )
        text = f"{', '.join(ids)}: {_changed(suspicion)}"
        yield Finding(suspicion.place, f"suspect-{_LINKS[suspicion.kind]}", text, fix)
    for suspicion in model.suspicions:
        yield Finding(suspicion.place, "suspect-design", _changed(suspicion))
    for name in model.reviews_of_nothing:
        text = f"{name} has a baseline or a review, but does not exist"
        yield Finding(Place(str(BASELINE), 1), "suspect-requirement", text, "remove its entry")


def _changed(suspicion: Suspicion) -> str:
    return f"{NAMES_OF_TEXTS[suspicion.kind].format(suspicion.name)} {suspicion.text}"


def _reviews(model: Model) -> Iterator[Finding]:
    """Finds recorded reviews that are not valid. The reviewer must be a person who wrote none of
    the reviewed texts. The record must have a remark, and an answer to each question of a
    review."""
    for requirement in model.requirements.values():
        for review in requirement.reviews:
            for objection in review.objections:
                text = f"the record for {requirement.id} is not a valid review: {objection}"
                yield Finding(review.place, "req-review", text)


def _macros(facts: Facts) -> Iterator[Finding]:
    """Finds test macros that gtest_cases.py cannot read. The tests that these macros define would
    be missing in the model. In the tests, also finds loops that never run, and loops that count
    away from their limit."""
    for file, code in texts_below(facts.root, ["tests"], (".cpp", ".hpp")):
        for line, head in empty_loops(code):
            text = f"the loop '{head}' never runs, or counts away from its limit"
            fix = "correct the limits of the loop, or remove it"
            yield Finding(Place(file, line), "req-test", text, fix)
        for line, name in unknown_macros(code):
            text = f"the reader of tests does not recognise the macro {name}"
            fix = "use TEST, TEST_F, TEST_P or TYPED_TEST, or add the macro to gtest_cases.py"
            yield Finding(Place(file, line), "req-test", text, fix)


def _switched_off(model: Model, facts: Facts) -> Iterator[Finding]:
    """Finds tests that are disabled. Also finds tests of requirements that skip themselves."""
    for file in sorted({test.place.file for test in model.tests.values()}):
        text = (facts.root / file).read_text(encoding="utf-8")
        if DISABLED not in text and SKIPS not in text:
            continue
        for case in read_tests(text):
            test = model.tests.get(case.id)
            if test is None or test.place.file != file:
                continue
            disabled = DISABLED in case.id
            if disabled or (SKIPS in case.code and test.verifies):
                said = "is disabled" if disabled else "skips itself"
                fix = "let the test run, or remove it"
                yield Finding(test.place, "req-test", f"{test.id} {said}", fix)
