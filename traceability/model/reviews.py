"""The changes of the texts of each requirement since the baseline, and the reviews of each
requirement.

The baseline contains a hash of each text on which the verdict of a requirement depends. If the hash
of the present text is different, the text has changed. The texts themselves are in git. A review is
the judgement of a person who wrote none of these texts."""

from __future__ import annotations

import json
import re
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from traceability.grouping import grouped
from traceability.model.design_model import Model, requirement_key
from traceability.model.design_texts import page_facts, reasons, safety_sections
from traceability.model.trees import accepted
from traceability.reading.build_evidence import git
from traceability.reading.comments import code_of
from traceability.reading.link_texts import (
    FINDERS,
    TREE,
    code_with_bounds,
    hash_of,
    hash_of_text,
    specifications,
)
from traceability.reading.source_facts import Facts
from traceability.reading.support_files import SupportFiles
from traceability.reading.toml_reader import Entries, Problem
from traceability.reading.traces import nodes_of
from traceability.schema import (
    Baseline,
    Method,
    Place,
    Requirement,
    Review,
    StateMachine,
    Suspicion,
    Transition,
)
from traceability.sources import DESIGN as SOURCES
from traceability.sources import files_below
from traceability.whole_file import write_whole

BASELINE = Path("requirements/baseline.toml")
REVIEWS = Path("requirements/reviews.toml")
BASELINE_HEADING = """\
# The texts on which the verdict of each requirement depends, and the hash of each text.
# The hashes show which texts have changed. They are not a review.
# Written by ./wr review --baseline.
"""
REVIEWS_HEADING = """\
# Reviews by persons other than the authors of the texts. Written by ./wr review ID.
"""
# Kind of a text -> name of the text in messages.
NAMES_OF_TEXTS = {
    "requirement": "its text",
    "tree": "its tree",
    "goal": "goal {}",
    "method": "the specification of {}",
    "body": "the body of {}",
    "constants": "a constant of {}",
    "transition": "transition {}",
    "test": "test {}",
    "support": "file {}",
    "justification": "the justification of lines of {}",
    "reason": "the text {}",
    "facts": "the numbers and names in the section {}",
    "page": "the text of the section {}",
    "function": "{}",
}
KINDS = tuple(NAMES_OF_TEXTS)
DESIGN = "design"  # key for texts without a requirement; other keys are ids of requirements
OF_DESIGN = ("reason", "facts", "page", "function")
EVIDENCE = ("sim/plant", "sim/scenario")  # folders of code on which the results of tests depend
LINKS = "links"  # the table of the baseline with the texts of each requirement
TEXTS_OF_REVIEW = ("requirement", "reviewer", "email", "date", "commit", "state", "remark")
DATE = r"\d{4}-[01]\d-[0-3]\d"
QUESTIONS = {
    "text": "Is the requirement clear, complete and consistent with the other requirements?",
    "reasons": "Are the rationale, source, safety goals and hazards of the requirement right?",
    "methods": "Do the specifications and the bodies of its methods do what the requirement "
    "demands?",
    "tree": "Does the tree show the important calls in the right order?",
    "tests": "If the requirement were not met, would the tests fail? Do they test both sides of "
    "each limit?",
    "oracles": (
        "Are fixtures, expected values and scenarios right, according to a source outside the code?"
    ),
}
ANSWERS = ("yes", "no", "not applicable")
LEAST_REMARK = 20  # characters


@dataclass(frozen=True)
class LinkText:
    """A text on which the verdict of a requirement depends. If the last source line of the text is
    known, ``place.end`` is its number."""

    kind: str  # see NAMES_OF_TEXTS
    name: str
    place: Place
    text: str

    @property
    def key(self) -> str:
        return f"{self.kind} {self.name}"

    @property
    def hash(self) -> str:
        return hash_of(self.kind, self.text)


class LinkTexts:
    """The finder of the texts on which the verdicts depend. It reads each file once."""

    def __init__(self, model: Model, facts: Facts) -> None:
        self.model = model
        self.facts = facts
        self.support = SupportFiles(facts.root)

    def of(self, requirement: Requirement) -> list[LinkText]:
        """Returns all texts on which the verdict of a requirement now depends."""
        return [
            *self._own(requirement),
            *(text for name in requirement.goals for text in self._goal(name)),
            *(self._method(requirement, name) for name in requirement.satisfied_by),
            *self._bodies(requirement),
            *self._transitions(requirement),
            *self._tests(requirement),
            *self._justifications(requirement),
        ]

    def of_design(self, covered: set[str]) -> list[LinkText]:
        """Returns the texts that belong to no requirement. These are the sentences in the design
        files, the facts in the pages, the whole text of pages about safety, the code in
        ``EVIDENCE``, and all functions, constants and specifications that are not in
        ``covered``."""
        texts: dict[str, LinkText] = {}
        for place, end, text in self._uncovered(covered):
            name = f"{text.splitlines()[0]} in {place.file}"
            before = texts.get(name)
            whole = f"{before.text}\n" if before else ""
            first = before.place if before else replace(place, end=end)
            texts[name] = LinkText("function", name, first, f"{whole}{text}")
        return [
            *(LinkText("reason", *reason) for reason in reasons(self.facts.root)),
            *(LinkText("facts", *fact) for fact in page_facts(self.facts.root)),
            *(LinkText("page", *section) for section in safety_sections(self.facts.root)),
            *texts.values(),
        ]

    def _uncovered(self, covered: set[str]) -> Iterator[tuple[Place, int, str]]:
        """Yields each function body, each specification, and the constants of each file, if they
        are not in ``covered``. Also yields the code of each file in ``EVIDENCE``. Each result
        consists of the place, the number of the last source line (0 if it is unknown), and a text
        whose first line is the name."""
        for body in self.facts.syntax.bodies:
            own = body.place.file.startswith(tuple(f"{top}/" for top in SOURCES))
            if own and f"body {body.id}" not in covered:
                yield body.place, body.end, f"{body.id}\n{self._slice(body.place, body.end)}"
        for path in files_below(self.facts.root, SOURCES, (".cpp", ".hpp")):
            file = str(path.relative_to(self.facts.root))
            text = next(FINDERS["constants"](self.support.text(file), file))
            if text and f"constants {file}" not in covered:
                yield Place(file, 1), 0, f"a constant\n{text}"
        for path in files_below(self.facts.root, EVIDENCE, (".cpp", ".hpp")):
            file = str(path.relative_to(self.facts.root))
            yield Place(file, 1), 0, f"the code\n{code_of(self.support.text(file))}"
        for method in self.model.methods:
            if f"method {method.id}" not in covered:
                place, text = self._specification(method)
                if text:
                    yield place, place.end or place.line, f"{method.id}\n{text}"

    def _own(self, requirement: Requirement) -> Iterator[LinkText]:
        name, place = requirement.id, requirement.place
        text = self.support.text(place.file)
        begin = sum(map(len, text.splitlines(keepends=True)[: place.line]))
        end = text.find("@requirement", begin)
        last = text.count("\n", 0, end) if end >= 0 else len(text.splitlines())
        for source in list(FINDERS["requirement"](text, name))[:1]:
            yield LinkText("requirement", name, replace(place, end=last), source)
        declared = self.facts.declared.trees.get(name)
        if declared is None:
            return
        trees = self.support.text(declared[0].file)
        match = next(match for match in TREE.finditer(trees) if match[1] == name)
        last = declared[0].line + match[0].rstrip().count("\n")
        for source in FINDERS["tree"](trees, name):
            yield LinkText("tree", name, replace(declared[0], end=last), source)

    def _goal(self, name: str) -> Iterator[LinkText]:
        case = self.model.safety
        if name in case.goals:
            goal = case.goals[name]
            hazards = (case.hazards[hazard] for hazard in goal.hazards)
            rows = (
                f"{h.id} {h.title} {h.situation} {h.harm} {h.severity} {h.exposure} {h.avoidance} "
                f"{h.answer}"
                for h in hazards
            )
            limits = (*goal.exceptions, *goal.open_points)
            parts = (goal.title, goal.text, goal.because, *goal.scenarios, *limits, *rows)
            text = "\n".join(parts)
            yield LinkText("goal", name, goal.place, text)

    def _method(self, requirement: Requirement, name: str) -> LinkText:
        methods = [
            method
            for method in self.model.modules[name.split("::", maxsplit=1)[0]].methods
            if method.id == name and requirement.id in method.satisfies
        ]
        specified = [self._specification(method) for method in methods]
        return LinkText("method", name, specified[0][0], "\n".join(text for _, text in specified))

    def _bodies(self, requirement: Requirement) -> Iterator[LinkText]:
        """Yields the bodies of the methods that satisfy a requirement or are in its invocation
        tree. Also yields the constants of the files that contain these bodies."""
        files: set[str] = set()
        for name in sorted(self._methods(requirement)):
            bodies = self.facts.bodies.get(name, [])
            if bodies:
                text = "\n".join(self._slice(body.place, body.end) for body in bodies)
                yield LinkText("body", name, bodies[0].place, text)
                files |= {body.place.file for body in bodies}
        for file in sorted(files):
            text = next(FINDERS["constants"](self.support.text(file), file))
            if text:
                yield LinkText("constants", file, Place(file, 1), text)

    def _justifications(self, requirement: Requirement) -> Iterator[LinkText]:
        """Yields the justifications for source lines in the methods of a requirement. No test of
        the requirement executes these source lines."""
        for item in self.facts.declared.justified:
            if item.kind == "line" and set(item.names) & self._methods(requirement):
                yield LinkText("justification", item.names[0], item.place, item.why)

    def _methods(self, requirement: Requirement) -> set[str]:
        """Returns the methods that satisfy a requirement or are in its invocation tree."""
        nodes = nodes_of(requirement.tree)
        accepted_names = {method for node in nodes for method in accepted(node, self.facts)}
        return accepted_names.union(requirement.satisfied_by)

    def _transitions(self, requirement: Requirement) -> Iterator[LinkText]:
        for machine in self.model.machines.values():
            steps = grouped(
                machine.transitions, lambda step: f"{step.source}, {step.event}, {step.target}"
            )
            for name, alike in steps.items():
                if any(requirement.id in step.requirements for step in alike):
                    text = "\n".join(_effect(machine, step) for step in alike)
                    yield LinkText("transition", f"{machine.id}: {name}", alike[0].place, text)

    def _specification(self, method: Method) -> tuple[Place, str]:
        for lines, _, whole in specifications(self.support.text(method.place.file)):
            if method.place.line in lines:
                return Place(method.place.file, lines.start, lines.stop - 1), whole
        return method.place, ""

    def _slice(self, place: Place, end: int) -> str:
        lines = self.support.text(place.file).splitlines()
        return code_with_bounds("\n".join(lines[place.line - 1 : end]))

    def _tests(self, requirement: Requirement) -> Iterator[LinkText]:
        files: dict[str, None] = {}
        for name in requirement.verified_by:
            place = self.model.tests[name].place
            text = self.support.text(place.file)
            for body in list(FINDERS["test"](text, name))[:1]:
                end = place.line + body.count("\n")
                yield LinkText("test", name, replace(place, end=end), body)
            files |= dict.fromkeys(self.support.of(place.file, name))
        for file in sorted(files):
            text = next(FINDERS["support"](self.support.text(file), file))
            yield LinkText("support", file, Place(file, 1), text)


def _effect(machine: StateMachine, step: Transition) -> str:
    """Returns a text with the guard and the action of a transition. For the guard, the text lists
    the conditions in the code. For the action, it lists the calls in the code."""
    conditions = machine.guards.get(step.guard or step.event, ())
    called = machine.actions.get(step.action, ())
    return f"{step.guard} = {', '.join(conditions)} / {step.action} = {', '.join(called)}"


def state_of(texts: Iterable[LinkText]) -> str:
    """Returns a hash of all texts. A review is valid until this hash changes."""
    return hash_of_text(" ".join(sorted(f"{text.kind} {text.name} {text.hash}" for text in texts)))


def read_baseline(root: Path, entries: Entries | None = None) -> Baseline:
    entries = entries or Entries(root)
    tables = {kind: entries.value(root / BASELINE, kind, {}) for kind in (LINKS, *KINDS)}
    links = tables.pop(LINKS)
    hashes = {f"{kind} {name}": tables[kind][name] for kind in KINDS for name in tables[kind]}
    links[DESIGN] = [f"{kind} {name}" for kind in OF_DESIGN for name in tables[kind]]
    return Baseline(links, hashes)


def write_baseline(root: Path, texts: Mapping[str, list[LinkText]], ids: Iterable[str]) -> None:
    """Writes the texts and hashes of the requirements in ``texts`` to the baseline. The other
    requirements in ``ids`` keep their lists of texts."""
    before = read_baseline(root)
    links = {name: before.links[name] for name in (*ids, DESIGN) if name in before.links}
    links |= {name: [text.key for text in listed] for name, listed in texts.items()}
    hashes = dict(before.hashes)
    hashes |= {text.key: text.hash for listed in texts.values() for text in listed}
    parts = [BASELINE_HEADING, f"\n[{LINKS}]\n"]
    named = sorted(links.keys() - {DESIGN}, key=requirement_key)
    parts += [f"{name} = {json.dumps(sorted(links[name]))}\n" for name in named]
    used = sorted({key for keys in links.values() for key in keys})
    for kind in KINDS:
        names = [key.removeprefix(f"{kind} ") for key in used if key.startswith(f"{kind} ")]
        parts += [f"\n[{kind}]\n"] if names else []
        parts += [f'{json.dumps(name)} = "{hashes[f"{kind} {name}"]}"\n' for name in names]
    write_whole(root / BASELINE, "".join(parts))


def read_reviews(root: Path, entries: Entries | None = None) -> list[Review]:
    """Returns the reviews that have all keys. Records a problem for each review with a missing key
    or with a date in another form."""
    entries = entries or Entries(root)
    reviews = entries.records(root / REVIEWS, "review", Review)
    for review in reviews:
        if not re.fullmatch(DATE, review.date):
            text = "the date of the review must have the form 2026-01-31"
            entries.problems.append(Problem(review.place, text, "review the requirement again"))
    return reviews


def add_review(root: Path, review: Review) -> None:
    path = root / REVIEWS
    before = path.read_text(encoding="utf-8") if path.exists() else REVIEWS_HEADING
    lines = [
        f"{key} = {json.dumps(getattr(review, key), ensure_ascii=False)}\n"
        for key in TEXTS_OF_REVIEW
    ]
    answers = ", ".join(f'{key} = "{answer}"' for key, answer in review.answers.items())
    entry = f"\n[[review]]\n{''.join(lines)}answers = {{ {answers} }}\n"
    write_whole(path, before + entry)


def objections(root: Path, review: Review, texts: Iterable[LinkText]) -> Iterator[str]:
    """Yields the reasons why a review is not valid for these texts."""
    if len(review.reviewer.split()) < 2 or "@" not in review.email:
        yield "a review needs the first and last name of a person, and an e-mail address"
    if len(review.remark.strip()) < LEAST_REMARK:
        yield f"a review needs a remark of at least {LEAST_REMARK} characters"
    for question in QUESTIONS:
        if review.answers.get(question) not in ANSWERS:
            yield f"the question '{question}' needs an answer: {', '.join(ANSWERS)}"
    who = {review.reviewer.casefold(), review.email.casefold()}
    for text in texts:
        if who & authors(root, text.place):
            place = f"{text.place.file}:{text.place.line}"
            yield (
                f"{review.reviewer} wrote lines of {text.kind} {text.name} ({place}), and authors "
                "of a text cannot review it; let another person run ./wr review"
            )
            break


def authors(root: Path, place: Place) -> set[str]:
    """Returns the authors of the source lines of a place, according to git. The result contains
    their names and e-mail addresses in lower case."""
    lines = ["-L", f"{place.line},{place.end}"] if place.end else []
    blame = git(root, "blame", "-w", "--line-porcelain", *lines, "--", place.file)
    words = re.findall(r"^author(?:-mail)? (.*)$", blame, re.MULTILINE)
    return {word.strip("<>").casefold() for word in words}


def with_reviews(model: Model, facts: Facts) -> Model:
    root, entries = facts.root, facts.declared.entries
    baseline = read_baseline(root, entries)
    finder = LinkTexts(model, facts)
    reviews = grouped(read_reviews(root, entries), lambda review: review.requirement)
    requirements: dict[str, Requirement] = {}
    covered: set[str] = set()
    for name, requirement in model.requirements.items():
        texts = finder.of(requirement)
        covered |= {text.key for text in texts}
        requirements[name] = replace(
            requirement,
            suspicions=list(suspicions(requirement, baseline, texts, model)),
            reviews=[judged(root, review, texts) for review in reviews.get(name, [])],
        )
    of_nothing = (baseline.links.keys() | reviews.keys()) - model.requirements.keys() - {DESIGN}
    return replace(
        model,
        requirements=requirements,
        reviews_of_nothing=sorted(of_nothing),
        suspicions=list(_of_design(baseline, finder.of_design(covered), covered)),
    )


def judged(root: Path, review: Review, texts: list[LinkText]) -> Review:
    """Returns the review with two results: whether the reviewed texts are still the present texts,
    and the reasons why the review is not valid."""
    current = review.state == state_of(texts)
    return replace(review, current=current, objections=list(objections(root, review, texts)))


def suspicions(
    requirement: Requirement, baseline: Baseline, texts: list[LinkText], model: Model
) -> Iterator[Suspicion]:
    """Yields the texts of a requirement that were changed, added or removed since the baseline."""
    linked = baseline.links.get(requirement.id)
    if linked is None:
        yield Suspicion("requirement", requirement.id, requirement.place, "has no baseline")
        return
    yield from _changed(baseline, texts, set(linked))
    for key in sorted(set(linked) - {text.key for text in texts}):
        kind, name = key.split(" ", maxsplit=1)
        place, text = _removed(kind, name, requirement, model)
        yield Suspicion(kind, name, place, text)


def _removed(kind: str, name: str, requirement: Requirement, model: Model) -> tuple[Place, str]:
    """Returns the place to report, and the reason why a requirement no longer depends on a text. If
    the method or the test still exists, its place is returned. Otherwise, the place of the
    requirement is returned."""
    module = model.modules.get(name.split("::", maxsplit=1)[0])
    methods = [text for text in module.methods if text.id == name] if module else []
    if kind == "method" and methods:
        return methods[0].place, f"has lost the tag @satisfies {requirement.id} since the baseline"
    if kind == "test" and name in model.tests:
        place = model.tests[name].place
        return place, f"has lost the tag @verifies {requirement.id} since the baseline"
    if kind == "body" and methods:
        return methods[0].place, "is no longer in the requirement's tree, and has no @satisfies"
    return requirement.place, "was removed since the baseline"


def _changed(
    baseline: Baseline, texts: Iterable[LinkText], linked: set[str]
) -> Iterator[Suspicion]:
    for text in texts:
        if text.key not in linked:
            yield Suspicion(text.kind, text.name, text.place, "was added since the baseline")
        elif baseline.hashes.get(text.key) != text.hash:
            yield Suspicion(text.kind, text.name, text.place, "changed since the baseline")


def _of_design(baseline: Baseline, texts: list[LinkText], covered: set[str]) -> Iterator[Suspicion]:
    """Yields the texts that belong to no requirement and differ from the baseline.

    Two kinds of texts are left out, because the comparison of a requirement reports them: the texts
    that belong to a requirement now, and the texts that belonged to a requirement in the baseline.
    """
    linked = set(baseline.links[DESIGN])
    if not linked and texts:
        text = "and the other texts without a requirement have no baseline"
        yield Suspicion(texts[0].kind, texts[0].name, Place(str(BASELINE), 1), text)
        return
    lost = [text for text in texts if text.key not in linked and _is_in(baseline.hashes, text.name)]
    yield from _changed(baseline, [text for text in texts if text not in lost], linked)
    for key in sorted(linked - {text.key for text in texts}):
        kind, name = key.split(" ", maxsplit=1)
        if kind == "function" and _is_in(covered, name):
            continue
        file = name.rpartition(" in ")[2] if kind == "function" else name.split(" ")[0]
        yield Suspicion(kind, name, Place(file, 1), "was removed since the baseline")


def _is_in(keys: Container[str], name: str) -> bool:
    """Returns true if ``keys`` contains the body or the specification of a function, or the
    constants of a file. ``name`` has the form ``function in file``."""
    code, _, file = name.rpartition(" in ")
    return any(key in keys for key in (f"body {code}", f"method {code}", f"constants {file}"))
