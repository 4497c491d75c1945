"""Finds the texts that no check can compare with the code: sentences in the design files, facts in
the pages, and the whole text of pages about safety. After a change of such a text, a person must
review it."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from traceability.schema import Place

# A safety goal or a hazard is left out here, because it is reviewed with its requirements.
OF_REQUIREMENTS = ("design/safety_case.toml goal.", "design/safety_case.toml hazard.")
LABELS = ("id", "name", "pattern", "place", "ask", "register", "object", "kind", "method")
LISTS = ("names", "methods", "members", "modules", "classes", "paths")
PAGES = (("docs", "*.rst"), ("", "README.md"))
TITLE = re.compile(r"^(?:#+ (.+)|(.+)\n[=\-~]{3,})$", re.MULTILINE)
# A fact is a number, a pin, a name in a Sphinx role (such as :module:), words in backticks, or a
# number in words. "one", "first" and "second" are left out, because they often mean something else.
FACT = re.compile(
    r"(?<![\w.])-?\d[\w.]*|\bPT[A-E]\d+|:\w+:`[^`]+`|``[^`]+``|(?<!`)`[^`]+`(?!`)"
    r"|\b(?:two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|twenty|twice|half|third"
    r"|fourth|fifth|sixth|seventh|eighth|ninth|tenth)\b"
)
# A wrong instruction on these pages can endanger people. Each change of their words needs a review.
SAFETY_PAGES = ("docs/bring_up.rst", "docs/hazards.rst")
# A text with at most this number of words is regarded as a name and not as a sentence. It is left
# out here, because other checks compare names with the code.
WORDS = 3


def reasons(root: Path) -> Iterator[tuple[str, Place, str]]:
    """Returns each text with sentences in the TOML files below ``design`` and ``changes``. Each
    result consists of a name, the place of the text in its file, and the text."""
    files = [*(root / "design").glob("*.toml"), *(root / "changes").glob("*/change.toml")]
    for path in sorted(files):
        file = str(path.relative_to(root))
        source = path.read_text(encoding="utf-8")
        try:
            content = tomllib.loads(source)
        except tomllib.TOMLDecodeError:
            continue  # The check of the file reports this error.
        for name, text in _sentences(content):
            if not f"{file} {name}".startswith(OF_REQUIREMENTS):
                yield f"{file} {name}", Place(file, _line_of(text, source)), text


def _sentences(table: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, str]]:
    """Returns the texts with sentences in a TOML table and in the tables inside it. Each text has a
    path: the names of the tables that contain the text, and its key.

    The texts of a table often state the reasons for the numbers in the table. Each text therefore
    ends with these numbers, so that a change of a number also requires a review. If a table has
    numbers and no sentence, the numbers are a text of their own."""
    numbers = [f"{key} = {value}" for key, value in table.items() if type(value) in (int, float)]
    has_reason = False
    for key, value in table.items():
        path = f"{above}{key}"
        if isinstance(value, Mapping):
            yield from _sentences(value, f"{path}.")
        elif isinstance(value, list) and value and isinstance(value[0], Mapping):
            seen: Counter[str] = Counter()
            for item in value:
                label = _label(item)
                seen[label] += 1
                number = f" {seen[label]}" if seen[label] > 1 or not label else ""
                yield from _sentences(item, f"{path}.{label}{number}.")
        elif key not in LABELS:
            texts = value if isinstance(value, list) else [value]
            said = [text for text in texts if isinstance(text, str) and len(text.split()) > WORDS]
            if said:
                has_reason = True
                yield path, "\n".join((*said, *numbers))
    if numbers and not has_reason:
        yield f"{above}numbers", "\n".join(numbers)


def _label(item: Mapping[str, Any]) -> str:
    """Returns the label of an entry: the text of the first key in ``LABELS`` that the entry has.
    Without such a key, the label is the first element of a list whose key is in ``LISTS``. If there
    is no such list, the label is empty."""
    names = [item[key] for key in LABELS if isinstance(item.get(key), str)]
    lists = [item[key] for key in LISTS if isinstance(item.get(key), list)]
    names += [str(listed[0]) for listed in lists if listed]
    return names[0] if names else ""


def _line_of(text: str, source: str) -> int:
    """Returns the number of the line on which a text begins in the source of its file."""
    first = text.split("\n", maxsplit=1)[0].replace('"', '\\"')
    return source.count("\n", 0, max(source.find(first), 0)) + 1


def page_facts(root: Path) -> Iterator[tuple[str, Place, str]]:
    """Returns the facts (numbers, pins and names) in each section of the pages. Each result
    consists of a name, the place of the section, and the facts of the section in their order.

    A section without facts is left out. The pages in ``SAFETY_PAGES`` are left out too. A change of
    other words does not change the facts, and needs no review."""
    for name, place, text in _sections(root):
        facts = FACT.findall(text)
        if facts and place.file not in SAFETY_PAGES:
            yield name, place, "\n".join(facts)


def safety_sections(root: Path) -> Iterator[tuple[str, Place, str]]:
    """Returns each section of ``SAFETY_PAGES``: its name, its place and its text."""
    return (section for section in _sections(root) if section[1].file in SAFETY_PAGES)


def _sections(root: Path) -> Iterator[tuple[str, Place, str]]:
    for folder, names in PAGES:
        for path in sorted((root / folder).glob(names)):
            file = str(path.relative_to(root))
            source = path.read_text(encoding="utf-8")
            titles = [*TITLE.finditer(source)]
            ends = [*(title.start() for title in titles[1:]), len(source)]
            for title, end in zip(titles, ends, strict=False):
                line = source.count("\n", 0, title.start()) + 1
                text = source[title.end() : end].strip()
                if text:
                    yield f"{file} {title[1] or title[2]}", Place(file, line), text
