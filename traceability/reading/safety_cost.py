"""Counts the files and lines that were added or edited for the safety functions since a base
commit.

In edited files, only lines of code are counted. New files outside ``extensions/safety`` are not
counted."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable
from dataclasses import replace
from difflib import SequenceMatcher
from pathlib import Path

from traceability.reading.build_evidence import git
from traceability.reading.comments import code_of
from traceability.schema import Correction, SafetyCase, SafetyCost, TouchedFile
from traceability.sources import SRC

SAFETY = "extensions/safety"
CMAKE = (".cmake", "CMakeLists.txt")
CMAKE_COMMENT = re.compile(r'("(?:\\.|[^"\\])*")|#[^\n]*')


def read_cost(root: Path, case: SafetyCase) -> SafetyCost | None:
    """Returns the cost of the safety functions between the base commit and the present commit.
    Returns ``None`` if git does not contain the base commit."""
    base = git(root, "rev-parse", "--verify", f"{case.base}^{{commit}}").strip()
    head = git(root, "rev-parse", "--short=10", "HEAD").strip()
    if not (root / ".git").exists() or not case.base or not base or not head:
        return None
    before = set(git(root, "ls-tree", "-r", "--name-only", base, "--", SRC).splitlines())
    edited = git(root, "diff", "--name-only", "--no-renames", base, "HEAD", "--", SRC)
    added = git(root, "diff", "--numstat", "--no-renames", base, "HEAD", "--", SAFETY)
    files = [file for file in edited.splitlines() if file in before]
    texts = contents(root, [f"{commit}:{file}" for file in files for commit in (base, head)])
    edits = (edits_of_code(*file) for file in zip(files, texts[::2], texts[1::2], strict=True))
    touching = [edit for edit in edits if edit.touched]
    new = numstat(added)
    corrected = [correction_of(edit.file, case.corrections) for edit in touching]
    touched = [
        replace(edit, corrections=correction.why) if correction else edit
        for edit, correction in zip(touching, corrected, strict=True)
    ]
    own = sum(file.touched for file in touched if not file.corrections)
    shared = sum(
        correction.for_safety for correction in case.corrections if correction in corrected
    )
    lines = sum(edit.added for edit in new)
    return SafetyCost(case.base, head, [edit.file for edit in new], lines, touched, own + shared)


def contents(root: Path, names: list[str]) -> list[str]:
    """Returns the texts of files in the form "commit:path". The text of a missing file is empty."""
    words = ["git", "-C", str(root), "cat-file", "--batch"]
    requests = "".join(f"{name}\n" for name in names).encode()
    answer = subprocess.run(words, input=requests, capture_output=True, check=True).stdout
    texts, at = [], 0
    for _ in names:
        end = answer.index(b"\n", at)
        head, at = answer[at:end], end + 1
        if head.endswith(b" missing"):
            texts.append("")
            continue
        size = int(head.rpartition(b" ")[2])
        texts.append(answer[at : at + size].decode())
        at += size + 1
    return texts


def edits_of_code(file: str, before: str, after: str) -> TouchedFile:
    """Counts the lines of code that were added and removed between two versions of a file."""
    old, new = (lines_of_code(file, text.strip()) for text in (before, after))
    edits = SequenceMatcher(None, old, new, autojunk=False).get_opcodes()
    changed = [edit for edit in edits if edit[0] != "equal"]
    added = sum(to_end - to_begin for _, _, _, to_begin, to_end in changed)
    removed = sum(end - begin for _, begin, end, _, _ in changed)
    return TouchedFile(file, added, removed)


def lines_of_code(file: str, text: str) -> list[str]:
    """Returns the lines of a file without comments and empty lines."""
    if file.endswith(CMAKE):
        bare = CMAKE_COMMENT.sub(lambda match: match[1] or "", text)
        return [line.rstrip() for line in bare.splitlines() if line.strip()]
    return code_of(text).splitlines()


def numstat(text: str) -> list[TouchedFile]:
    """Returns the files and counts that ``git diff --numstat`` lists. For a binary file, both
    counts are 0."""
    rows = [line.split("\t") for line in text.splitlines()]
    return [
        TouchedFile(file, int(added) if added != "-" else 0, int(removed) if removed != "-" else 0)
        for added, removed, file in rows
    ]


def correction_of(file: str, corrections: Iterable[Correction]) -> Correction | None:
    """Returns the correction for the file. If there is none, returns the correction for the
    innermost folder above the file. If there is no such correction either, returns None."""
    matching = [
        (len(path), correction)
        for correction in corrections
        for path in correction.paths
        if file == path or (path.endswith("/") and file.startswith(path))
    ]
    return max(matching, key=lambda pair: pair[0])[1] if matching else None
