"""Sentences of the design and facts of pages. No check can compare them with the code."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from traceability.schema import Place

# A goal or hazard belongs to the texts of the requirements that serve it.
OF_REQUIREMENTS = ("design/safety_case.toml goal.", "design/safety_case.toml hazard.")
LABELS = ("id", "name", "pattern", "place", "ask", "register", "object", "kind", "method")
LISTS = ("names", "methods", "members", "modules", "classes", "paths")
PAGES = (("docs", "*.rst"), ("", "README.md"))
TITLE = re.compile(r"^(?:#+ (.+)|(.+)\n[=\-~]{3,})$", re.MULTILINE)
# A number, a pin, a name in a role of Sphinx, or a word in backticks.
FACT = re.compile(r"(?<![\w.])-?\d[\w.]*|\bPT[A-E]\d+|:\w+:`[^`]+`|``[^`]+``|(?<!`)`[^`]+`(?!`)")
WORDS = 3  # A text with fewer words is a name. Other checks compare names with the code.


def reasons(root: Path) -> Iterator[tuple[str, Place, str]]:
    """Returns the name, the place and the text of each sentence in the files of the design and of
    the changes."""
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
    """Yields the texts below a table. Each text has the names of the tables that contain it.

    The numbers of an entry belong to its texts, because the texts state the reason for the numbers.
    """
    numbers = [f"{key} = {value}" for key, value in table.items() if _is_number(value)]
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
            said = [text for text in texts if isinstance(text, str) and _is_prose(text)]
            if said:
                yield path, "\n".join((*said, *numbers))


def _label(item: Mapping[str, Any]) -> str:
    """Returns the name of an entry. The name is the id of the entry, or the first of the names that
    the entry lists."""
    names = [item[key] for key in LABELS if isinstance(item.get(key), str)]
    lists = [item[key] for key in LISTS if isinstance(item.get(key), list)]
    names += [str(listed[0]) for listed in lists if listed]
    return names[0] if names else ""


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _is_prose(text: str) -> bool:
    return len(text.split()) > WORDS


def _line_of(text: str, source: str) -> int:
    """Returns the line of the file in which the text begins."""
    first = text.split("\n", maxsplit=1)[0].replace('"', '\\"')
    return source.count("\n", 0, max(source.find(first), 0)) + 1


def page_facts(root: Path) -> Iterator[tuple[str, Place, str]]:
    """Returns the name, the place and the facts of each section of a page. Facts are numbers, pins
    and names, in their order.

    Other words of a section may change freely.
    """
    for folder, names in PAGES:
        for path in sorted((root / folder).glob(names)):
            file = str(path.relative_to(root))
            source = path.read_text(encoding="utf-8")
            titles = [*TITLE.finditer(source)]
            ends = [*(title.start() for title in titles[1:]), len(source)]
            for title, end in zip(titles, ends, strict=False):
                facts = FACT.findall(source[title.end() : end])
                if facts:
                    line = source.count("\n", 0, title.start()) + 1
                    yield f"{file} {title[1] or title[2]}", Place(file, line), "\n".join(facts)
