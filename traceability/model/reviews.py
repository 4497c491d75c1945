"""Who reviewed the links of a requirement, and what has changed since.

The file of reviews holds hashes of what was reviewed, and git the texts themselves.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.link_texts import (
    hash_of_text,
    specifications,
    texts_of_requirement,
    texts_of_test,
)
from traceability.reading.toml_reader import Entries, Keys, Problem
from traceability.schema import Method, Place, Requirement, Review, Suspicion

REVIEWS = Path("requirements/reviews.toml")
HEADING = """\
# Who reviewed the links of each requirement, and the hashes of what was reviewed: the text of the
# requirement, the specifications of the methods that satisfy it, the bodies of the tests that
# verify it. Written by ./wr review.
"""
NEEDS: Keys = {"reviewer": str, "date": str, "text": str}
MAY: Keys = {"methods": dict, "tests": dict}
KINDS = ("requirement", "method", "test")


@dataclass(frozen=True)
class LinkText:
    """A text that a link of a requirement depends on."""

    kind: str  # one of KINDS
    name: str
    place: Place
    text: str

    @property
    def hash(self) -> str:
        return hash_of_text(self.text)


@dataclass
class Sources:
    """Files, each read once."""

    root: Path
    texts: dict[str, str] = field(default_factory=dict)

    def text(self, file: str) -> str:
        if file not in self.texts:
            self.texts[file] = (self.root / file).read_text(encoding="utf-8")
        return self.texts[file]


def link_texts(model: Model, requirement: Requirement, sources: Sources) -> list[LinkText]:
    """What there is to review of a requirement, as it is now."""
    name, place = requirement.id, requirement.place
    found = [
        LinkText("requirement", name, place, text)
        for text in list(texts_of_requirement(sources.text(place.file), name))[:1]
    ]
    for method_id in requirement.satisfied_by:
        methods = _methods(model, method_id, name)
        specifications = [_specification(method, sources) for method in methods]
        found.append(LinkText("method", method_id, methods[0].place, "\n".join(specifications)))
    for test_id in requirement.verified_by:
        place = model.tests[test_id].place
        bodies = list(texts_of_test(sources.text(place.file), test_id))
        found += [LinkText("test", test_id, place, text) for text in bodies[:1]]
    return found


def _methods(model: Model, method_id: str, requirement: str) -> list[Method]:
    return [
        method
        for method in model.modules[method_id.split("::", maxsplit=1)[0]].methods
        if method.id == method_id and requirement in method.satisfies
    ]


def _specification(method: Method, sources: Sources) -> str:
    found = specifications(sources.text(method.place.file))
    return next((whole for lines, _, whole in found if method.place.line in lines), "")


def read_reviews(root: Path, entries: Entries | None = None) -> dict[str, Review]:
    """The reviews that have all that a review needs."""
    entries = entries or Entries(root)
    begin = Place(str(REVIEWS), 1)
    for name, entry in entries.whole(root / REVIEWS).items():
        if not re.fullmatch(r"\d{4}-[01]\d-[0-3]\d", str(entry.get("date", ""))):
            place = entries.line_in(begin, f"[{name}]")
            text = f"the review of {name} has no date of the form 2026-01-31"
            entries.problems.append(Problem(place, text, "review it again"))
    return {
        name: Review(
            entry["reviewer"],
            str(entry["date"]),
            {
                "requirement": {name: entry["text"]},
                "method": entry.get("methods", {}),
                "test": entry.get("tests", {}),
            },
        )
        for name, entry in entries.whole(root / REVIEWS).items()
        if entries.fits(entry, entries.line_in(begin, f"[{name}]"), NEEDS, MAY)
    }


def write_review(root: Path, name: str, review: Review) -> None:
    """Adds the review of one requirement, or puts it in the place of the one before."""
    reviews = {**read_reviews(root), name: review}
    parts = [HEADING]
    for key in sorted(reviews, key=_order):
        one = reviews[key]
        parts.append(f"\n[{key}]\nreviewer = {json.dumps(one.reviewer, ensure_ascii=False)}\n")
        parts.append(f'date = "{one.date}"\ntext = "{one.hashes["requirement"][key]}"\n')
        for kind in ("method", "test"):
            lines = [
                f'{kind}s."{item}" = "{value}"\n'
                for item, value in sorted(one.hashes[kind].items())
            ]
            parts += lines
    (root / REVIEWS).write_text("".join(parts), encoding="utf-8")


def _order(name: str) -> tuple[str, int]:
    kind, _, number = name.partition("-")
    return kind, int(number)


def hashes(texts: Iterable[LinkText]) -> dict[str, dict[str, str]]:
    found: dict[str, dict[str, str]] = {kind: {} for kind in KINDS}
    for one in texts:
        found[one.kind][one.name] = one.hash
    return found


def with_reviews(model: Model, root: Path, entries: Entries) -> Model:
    reviews = read_reviews(root, entries)
    sources = Sources(root)
    requirements: dict[str, Requirement] = {}
    for name, requirement in model.requirements.items():
        review = reviews.get(name)
        found = suspicions(requirement, review, link_texts(model, requirement, sources))
        requirements[name] = replace(requirement, review=review, suspicions=found)
    of_nothing = sorted(reviews.keys() - model.requirements.keys())
    return replace(model, requirements=requirements, reviews_of_nothing=of_nothing)


def suspicions(
    requirement: Requirement, review: Review | None, texts: list[LinkText]
) -> list[Suspicion]:
    """What is not as it was reviewed."""
    if review is None:
        return [Suspicion("requirement", requirement.id, requirement.place, "was never reviewed")]
    found: list[Suspicion] = []
    now = {(one.kind, one.name): one for one in texts}
    for (kind, name), one in now.items():
        known = review.hashes[kind].get(name)
        if known is None:
            found.append(Suspicion(kind, name, one.place, "was added since the review"))
        elif known != one.hash:
            found.append(Suspicion(kind, name, one.place, "changed since the review"))
    for kind in KINDS:
        for name in review.hashes[kind]:
            if (kind, name) not in now:
                text = "was removed since the review"
                found.append(Suspicion(kind, name, requirement.place, text))
    return found
