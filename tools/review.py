"""./wr review: records a person's review of a requirement, or records the present texts as the
baseline."""

from __future__ import annotations

import argparse
import datetime
import difflib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from tools.steps import FailureError, MissingError, UsageError
from traceability.model.build import build
from traceability.model.design_model import Model
from traceability.model.reviews import (
    ANSWERS,
    DESIGN,
    LEAST_REMARK,
    NAMES_OF_TEXTS,
    QUESTIONS,
    REVIEWS,
    LinkText,
    LinkTexts,
    add_review,
    objections,
    read_baseline,
    state_of,
    write_baseline,
)
from traceability.reading import link_texts
from traceability.reading.build_evidence import git
from traceability.reading.link_texts import FINDERS, hash_of
from traceability.schema import Baseline, Place, Requirement, Review
from traceability.sources import files_below

# The text of the baseline is searched only in the newest versions of a file. At most this number of
# versions is searched.
MOST_VERSIONS = 200
MOST_TRIES = 3  # A question is asked at most this number of times.


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "review",
        description="Shows the texts on which the verdict of one requirement depends: its text, "
        "tree, safety goals, methods, tests, fixtures and scenarios. Also shows the "
        "changes of these texts since the baseline. Then asks the questions of the "
        "checklist, and records your answers in requirements/reviews.toml. The reviewer "
        "must not be an author of these texts: the command reads the authors from git. "
        "With --baseline, the command asks nothing, and records the hashes of the present "
        "texts in requirements/baseline.toml. The checks compare later texts with this baseline. "
        "A baseline is not a review.",
    )
    parser.add_argument("ids", nargs="*", metavar="ID", help="a requirement, such as FR-15")
    parser.add_argument(
        "--baseline",
        action="store_true",
        help="record the present texts of the given requirements, or of all requirements that "
        "changed. A text that several requirements share, such as a safety goal, is recorded for "
        "all of them. 'design' selects the reasons in design/ and the code without a requirement",
    )
    parser.add_argument(
        "--name", help="first and last name of the reviewer (default: the name in git)"
    )
    parser.add_argument("--email", help="address of the reviewer (default: the address in git)")
    parser.set_defaults(run=review)


def review(root: Path, options: argparse.Namespace) -> int:
    if not options.baseline and len(options.ids) != 1:
        raise UsageError("name one requirement to review, such as ./wr review FR-15")
    names = {*declared_ids(root), *([DESIGN] if options.baseline else [])}
    unknown = [name for name in options.ids if name not in names]
    if unknown:
        raise UsageError(
            f"there is no requirement {', '.join(unknown)}; the portal lists the requirements"
        )
    built = build(root)
    texts = LinkTexts(built.model, built.facts)
    if options.baseline:
        return record_baseline(root, built.model, texts, options.ids)
    requirement = built.model.requirements[options.ids[0]]
    return review_one(root, requirement, texts.of(requirement), options)


def declared_ids(root: Path) -> set[str]:
    """Returns the ids of all requirements. Reads only the requirements. This is much faster than
    building the model."""
    files = files_below(root, ("requirements",), (".dox",))
    texts = (file.read_text(encoding="utf-8") for file in files)
    return {name for text in texts for name, _ in link_texts.requirements(text)}


def record_baseline(root: Path, model: Model, texts: LinkTexts, ids: list[str]) -> int:
    """Prints the changed texts, and records their present hashes in the baseline."""
    requirements = model.requirements
    doubts = {name: requirement.suspicions for name, requirement in requirements.items()}
    doubts[DESIGN] = model.suspicions
    changed = [name for name in ids or doubts if doubts[name]]
    for name in changed:
        for suspicion in doubts[name]:
            said = NAMES_OF_TEXTS[suspicion.kind].format(suspicion.name)
            print(f"{name}: {said} {suspicion.text}")
    present = {name: texts.of(requirement) for name, requirement in requirements.items()}
    covered = {text.key for listed in present.values() for text in listed}
    recorded = {name: present[name] for name in changed if name != DESIGN}
    if DESIGN in changed:
        recorded[DESIGN] = texts.of_design(covered)
    write_baseline(root, recorded, requirements)
    print(f"Recorded the baseline of {counted(changed)}. This is not a review.")
    return 0


def counted(changed: list[str]) -> str:
    design = " and of the texts without a requirement" if DESIGN in changed else ""
    return f"{len(set(changed) - {DESIGN})} requirements{design}"


def review_one(
    root: Path, requirement: Requirement, texts: list[LinkText], options: argparse.Namespace
) -> int:
    """Shows the texts, asks the questions, and records the answers."""
    if not sys.stdin.isatty():
        raise UsageError(
            "the input is not a terminal, but a person must answer the questions of a review; "
            "run this command in a terminal"
        )
    reviewer = options.name or git_setting(root, "user.name", "--name")
    email = options.email or git_setting(root, "user.email", "--email")
    files = sorted({text.place.file for text in texts})
    if git(root, "status", "--porcelain", "--", *files):
        raise FailureError(
            f"some texts of {requirement.id} are not committed; commit them, and then review them"
        )
    print("\n".join(shown(root, read_baseline(root), requirement, texts)))
    answers, remark = asked()
    today = datetime.date.today().isoformat()
    commit = git(root, "rev-parse", "--short=10", "HEAD").strip()
    state = state_of(texts)
    words = (requirement.id, reviewer, email, today, commit, state, remark, answers)
    record = Review(*words, Place(str(REVIEWS), 1))
    refused = list(objections(root, record, texts))
    if refused:
        raise FailureError("nothing was recorded: " + "; ".join(refused))
    add_review(root, record)
    print(f"Recorded in {REVIEWS}: {requirement.id}, {reviewer}, {today}. Commit it.")
    return 0


def asked() -> tuple[dict[str, str], str]:
    """Returns the answer to each question of the checklist, and the remark."""
    choice = ", ".join(ANSWERS)
    answers = {
        key: answer_to(
            f"{question} [{choice}] ", f"Answer with one of: {choice}.", ANSWERS.__contains__
        )
        for key, question in QUESTIONS.items()
    }
    remark = answer_to(
        "Your remark: what did you read, and what did you find? ",
        f"Write at least {LEAST_REMARK} characters.",
        lambda text: len(text) >= LEAST_REMARK,
    )
    return answers, remark


def answer_to(question: str, advice: str, accepted: Callable[[str], bool]) -> str:
    for _ in range(MOST_TRIES):
        answer = input(question).strip()
        if accepted(answer):
            return answer
        print(advice)
    raise FailureError(
        "nothing was recorded, because a question has no answer; run the command again"
    )


def shown(
    root: Path, baseline: Baseline, requirement: Requirement, texts: list[LinkText]
) -> Iterator[str]:
    """Yields the texts that a reviewer reads, with their changes. For a file that supports a test,
    such as a fixture or a scenario, yields the path and the changes, but not the whole text."""
    for text in texts:
        yield f"== {text.kind} {text.name} ({text.place.file}:{text.place.line})"
        if text.kind != "support":
            yield text.text
        recorded = baseline.hashes.get(text.key)
        if recorded and recorded != text.hash:
            yield from difference(root, text, recorded)
    removed = set(baseline.links.get(requirement.id, [])) - {text.key for text in texts}
    yield from (f"== {key}\nremoved since the baseline" for key in sorted(removed))


def difference(root: Path, now: LinkText, recorded: str) -> Iterator[str]:
    before = text_recorded(root, now, recorded)
    if before is None:
        yield (
            "the text changed since the baseline; this git repository does not contain the text "
            "of the baseline"
        )
        return
    yield from difflib.unified_diff(
        before.splitlines(), now.text.splitlines(), "baseline", "now", lineterm=""
    )


def text_recorded(root: Path, now: LinkText, recorded: str) -> str | None:
    """Searches the versions of the file in git for the text with the recorded hash. Returns this
    text, or None if no version contains it."""
    if now.kind not in FINDERS:
        return None
    for version in versions(root, now.place.file):
        for text in FINDERS[now.kind](version, now.name):
            if hash_of(now.kind, text) == recorded:
                return text
    return None


def versions(root: Path, file: str) -> Iterator[str]:
    """Yields the content of a file in each commit that changed it. The newest content is first."""
    commits = git(root, "log", f"--max-count={MOST_VERSIONS}", "--format=%H", "--", file)
    for commit in commits.split():
        yield git(root, "show", f"{commit}:{file}")


def git_setting(root: Path, name: str, option: str) -> str:
    value = git(root, "config", name).strip()
    if not value:
        raise MissingError(f"git has no {name}; set it, or use {option}")
    return value
