"""doc-figure: the figures of texts are those of the code, and the tables of offsets add up."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from traceability.model.declared import FigureText
from traceability.model.facts import Facts
from traceability.model.schema import Finding, Model, Place
from traceability.sources import files_below

FIGURE = r"(0x[\da-fA-F]+|\d+(?:\.\d+)?)"
RETURNED = re.compile(r"\breturn (?:(milliseconds)\(|\w+\()?(\d[\d']*)\)?;")
THOUSAND = 1000  # microseconds in a millisecond
# A row of a table that begins with an offset, and the widths of its fields.
ROW = re.compile(r"^   \* - ([^\n]*)\n     - ([^\n]*)$", re.MULTILINE)
WIDTH = re.compile(r"[ui](8|16|32)\b|(\d+) characters")
TIMES = re.compile(r"(\d+) times ")


def check(_model: Model, facts: Facts) -> list[Finding]:
    found = [finding for figure in facts.declared.figures for finding in _figure(figure, facts)]
    for path in files_below(facts.root, ("docs",), (".rst",)):
        found += _tables(str(path.relative_to(facts.root)), path.read_text(encoding="utf-8"))
    return found


def _figure(figure: FigureText, facts: Facts) -> Iterator[Finding]:
    path = facts.root / figure.text
    place = facts.declared.entries.line_in(figure.place, "of")
    value = value_of(figure.of, facts)
    if value is None:
        yield _finding(place, f"the code has no number {figure.of}", "name what gives the figure")
        return
    true = round(value * figure.times, 6)
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    matches = list(pattern_of(figure.says).finditer(text))
    if not matches:
        said = f"{figure.text} does not say '{figure.says}'"
        yield _finding(figure.place, said, "write the words that stand there now")
    wrong = {
        (text.count("\n", 0, match.start(number)) + 1, said)
        for match in matches
        for number, said in enumerate(match.groups(), 1)
        if _number(said) != true
    }
    for line, said in sorted(wrong):
        here = f"{int(true):#04x}" if said.startswith("0x") else f"{true:.15g}"
        words = f"the text says {said}, and {figure.of} is {here}"
        yield _finding(Place(figure.text, line), words, "correct the text, or the code")


def _finding(place: Place, text: str, mend: str) -> Finding:
    return Finding(place, "doc-figure", text, mend)


def pattern_of(says: str) -> re.Pattern[str]:
    """Words with figures, however they are laid out."""
    parts = [r"\s+".join(map(re.escape, re.split(r"\s+", part))) for part in says.split("{}")]
    return re.compile(r"(?<![\w.])" * (not parts[0]) + FIGURE.join(parts))


def _number(text: str) -> float:
    return float(int(text, 16)) if text.startswith("0x") else float(text)


def value_of(name: str, facts: Facts) -> float | None:
    """What an operation gives, a constant holds, or a value of an enumeration stands for."""
    owner, _, last = name.rpartition("::")
    for body in facts.bodies.get(name, []):
        lines = facts.lines_of(body.place.file)[body.place.line - 1 : body.end]
        returned = RETURNED.search("\n".join(lines))
        if returned:
            number = float(returned[2].replace("'", ""))
            return number * THOUSAND if returned[1] else number
    for known, constant in facts.syntax.constants.items():
        file, _, own = known.removeprefix("var ").partition(":")
        if own == last and (not owner or Path(file).stem == owner):
            return float(constant)
    return _written(owner, last, facts)


def _written(owner: str, name: str, facts: Facts) -> float | None:
    """The number behind a name in a class: of a value of an enumeration, or in braces."""
    fact = facts.classes.get(owner)
    lines = facts.lines_of(fact.place.file)[fact.place.line - 1 : fact.end] if fact else []
    found = re.search(rf"\b{name}(?: = |\{{){FIGURE}\b", "\n".join(lines))
    return _number(found[1]) if found else None


def _tables(file: str, text: str) -> Iterator[Finding]:
    """Each row begins where the one before ends."""
    end: int | None = None
    for row in ROW.finditer(text):
        offset, kind = row[1].strip(), row[2].strip()
        if not re.fullmatch(r"\d+(, \d+)*", offset) or not WIDTH.search(kind):
            end = None
            continue
        starts = [int(one) for one in offset.split(", ")]
        for start in starts:
            if end is not None and start not in (0, end):
                line = text.count("\n", 0, row.start()) + 1
                said = f"the row begins at {start}, and the one before ends at {end}"
                yield _finding(Place(file, line), said, "correct the offset, or the widths")
            end = start + _width(kind)


def _width(kind: str) -> int:
    times = TIMES.search(kind)
    bytes_ = sum(int(bits) // 8 if bits else int(count) for bits, count in WIDTH.findall(kind))
    return bytes_ * (int(times[1]) if times else 1)
