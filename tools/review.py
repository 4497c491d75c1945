"""./wr review: a person looks at one requirement with its links, and says so."""

from __future__ import annotations

import argparse
import datetime
import difflib
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from tools.steps import FailureError

if TYPE_CHECKING:
    from traceability.model.reviews import LinkText
    from traceability.schema import Review

MOST_VERSIONS = 200  # of a file that are searched for the text that was reviewed


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "review",
        description="Shows what changed since the last review of one requirement: its text, the "
        "specifications of the methods that satisfy it, the bodies of the tests that verify it. "
        "Asks whether they still fit each other, and writes your answer with name, date and "
        "hashes into requirements/reviews.toml.",
    )
    parser.add_argument("id", help="one requirement, such as FR-15")
    parser.add_argument("--name", help="who reviews; without it the name that git knows")
    parser.add_argument(
        "--yes",
        action="store_true",
        help="do not ask; only with --name",
    )
    parser.set_defaults(run=review)


def review(root: Path, options: argparse.Namespace) -> int:
    from traceability.model.build import build
    from traceability.model.reviews import Sources, hashes, link_texts, write_review
    from traceability.schema import Review

    if options.yes and not options.name:
        raise FailureError("--yes is for use with --name")
    model = build(root).model
    requirement = model.requirements.get(options.id)
    if requirement is None:
        raise FailureError(f"there is no requirement {options.id}")
    texts = link_texts(model, requirement, Sources(root))
    known = requirement.review
    if known and not requirement.suspicions:
        print(f"Nothing changed since {known.reviewer} reviewed {options.id} on {known.date}.")
        return 0
    print("\n".join(shown(root, known, texts)))
    if not (options.yes or confirmed(options.id)):
        print("Nothing was recorded.")
        return 1
    name = options.name or git_name(root)
    today = datetime.date.today().isoformat()
    write_review(root, options.id, Review(name, today, hashes(texts)))
    print(f"Recorded: {options.id}, {name}, {today}.")
    return 0


def shown(root: Path, known: Review | None, texts: list[LinkText]) -> Iterator[str]:
    """What a reviewer has to look at."""
    for one in texts:
        yield f"== {one.kind} {one.name} ({one.place.file}:{one.place.line})"
        reviewed = known.hashes[one.kind].get(one.name) if known else None
        if reviewed is None:
            yield from ["new", one.text] if known else [one.text]
        elif reviewed == one.hash:
            yield "unchanged"
        else:
            yield from difference(root, one, reviewed)
    now = {(one.kind, one.name) for one in texts}
    for kind, names in (known.hashes if known else {}).items():
        for name in names:
            if (kind, name) not in now:
                yield f"== {kind} {name}\nremoved"


def difference(root: Path, now: LinkText, reviewed: str) -> Iterator[str]:
    before = text_reviewed(root, now, reviewed)
    if before is None:
        yield "changed; git here does not hold what was reviewed"
        yield now.text
        return
    yield from difflib.unified_diff(
        before.splitlines(), now.text.splitlines(), "reviewed", "now", lineterm=""
    )


def text_reviewed(root: Path, now: LinkText, reviewed: str) -> str | None:
    """The text with this hash, out of the versions of the file that git holds."""
    from traceability.reading.link_texts import (
        hash_of_text,
        texts_of_method,
        texts_of_requirement,
        texts_of_test,
    )

    finders = {
        "requirement": texts_of_requirement,
        "method": texts_of_method,
        "test": texts_of_test,
    }
    name = now.name.rsplit("::", 1)[-1]
    for version in versions(root, now.place.file):
        for text in finders[now.kind](version, name):
            if hash_of_text(text) == reviewed:
                return text
    return None


def versions(root: Path, file: str) -> Iterator[str]:
    """The content of a file in each commit that changed it, the newest first."""
    found = git(root, "log", f"--max-count={MOST_VERSIONS}", "--format=%H", "--", file)
    for commit in found.split():
        yield git(root, "show", f"{commit}:{file}")


def git(root: Path, *words: str) -> str:
    run = subprocess.run(
        ["git", "-C", str(root), *words], capture_output=True, text=True, check=False
    )
    return run.stdout if run.returncode == 0 else ""


def git_name(root: Path) -> str:
    name = git(root, "config", "user.name").strip()
    if not name:
        raise FailureError("git knows no name: set user.name, or give --name")
    return name


def confirmed(identifier: str) -> bool:
    if not sys.stdin.isatty():
        raise FailureError("no one can answer here: use a terminal, or --name NAME --yes")
    answer = input(f"Do text, specifications and tests of {identifier} fit each other? [y/N] ")
    return answer.strip().lower() in ("y", "yes")
