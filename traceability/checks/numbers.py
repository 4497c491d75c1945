"""doc-figure: the figures of texts are those of the code, and the tables of offsets add up."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from traceability.model.declared import FigureText
from traceability.model.facts import Facts
from traceability.model.schema import Finding, Model, Place, Requirement
from traceability.sources import files_below

FIGURE = r"(0x[\da-fA-F]+|\d+(?:\.\d+)?)"
CODED = r"(?:(milliseconds)\(|\w+[({])?(0x[\da-fA-F']+|\d[\d']*)\b"  # Angle(20), 0x82, 3'200
THOUSAND = 1000  # microseconds in a millisecond
WITH_UNIT = re.compile(
    r"(?<![\w.])\d[\d.]*\s*(?:[mu]?s|mm?|m?[VA]|%|rpm|cycles|degrees?|steps/s)(?!\w)"
)
# A row of a table that begins with an offset, and the widths of its fields.
ROW = re.compile(r"^   \* - ([^\n]*)\n     - ([^\n]*)$", re.MULTILINE)
WIDTH = re.compile(r"[ui](8|16|32)\b|(\d+) characters")
TIMES = re.compile(r"(\d+) times ")
OFFSETS = re.compile(r"\d+(, \d+)*")
SECTION = re.compile(r"^(\S.*)\n-{3,}$", re.MULTILINE)
WHOLE_ROW = re.compile(r"^   \* - .*(?:\n(?:     .*)?(?=\n))*", re.MULTILINE)
ASKED = re.compile(r":requirement:`([^`]+)`")
LINK = re.compile(r":[\w-]+:`[^`]*`")


def check(model: Model, facts: Facts) -> list[Finding]:
    found = [finding for figure in facts.declared.figures for finding in _figure(figure, facts)]
    for path in files_below(facts.root, ("docs",), (".rst",)):
        file, text = str(path.relative_to(facts.root)), path.read_text(encoding="utf-8")
        found += [*_offsets(file, text), *_sizes(file, text), *_asked(file, text, model)]
    return found


def not_asked(text: str, requirements: list[Requirement]) -> list[re.Match[str]]:
    """The figures with a unit in a text that none of the requirements has."""
    asked = {re.sub(r"\s+", " ", one) for r in requirements for one in WITH_UNIT.findall(r.text)}
    return [one for one in WITH_UNIT.finditer(text) if re.sub(r"\s+", " ", one[0]) not in asked]


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
        if (number := _coded(r"\breturn ", lines)) is not None:
            return number
    for known, constant in facts.syntax.constants.items():
        file, _, own = known.removeprefix("var ").partition(":")
        if own == last and (not owner or Path(file).stem == owner):
            return float(constant)
    return _coded(rf"\b{last}(?: = |[{{(])", _code_of(owner, facts))


def _coded(before: str, lines: list[str]) -> float | None:
    """The number that follows in the code; of a time, its microseconds."""
    found = re.search(before + CODED, "\n".join(lines))
    if found is None:
        return None
    return _number(found[2].replace("'", "")) * (THOUSAND if found[1] else 1)


def _code_of(owner: str, facts: Facts) -> list[str]:
    """The files of a module; of any other class, its own lines."""
    files = [file for file, name in facts.written_in.items() if name == owner]
    if files:
        return [
            line for one in files if (facts.root / one).exists() for line in facts.lines_of(one)
        ]
    fact = facts.classes.get(owner)
    return facts.lines_of(fact.place.file)[fact.place.line - 1 : fact.end] if fact else []


def _asked(file: str, text: str, model: Model) -> Iterator[Finding]:
    """A row of a table that names requirements has their figures."""
    for row in WHOLE_ROW.finditer(text):
        asked = [model.requirements[n] for n in ASKED.findall(row[0]) if n in model.requirements]
        words = LINK.sub(lambda link: " " * len(link[0]), row[0])
        for figure in not_asked(words, asked) if asked else []:
            line = text.count("\n", 0, row.start() + figure.start()) + 1
            said = f"the row says {figure[0]}, and none of its requirements does"
            mend = "write the figure of the requirement, or name the requirement that has it"
            yield _finding(Place(file, line), said, mend)


def _offsets(file: str, text: str) -> Iterator[Finding]:
    """Each row begins where the one before ends."""
    end: int | None = None
    for row in ROW.finditer(text):
        offset, kind = row[1].strip(), row[2].strip()
        if not OFFSETS.fullmatch(offset) or not WIDTH.search(kind):
            end = None
            continue
        starts = [int(one) for one in offset.split(", ")]
        for start in starts:
            if end is not None and start not in (0, end):
                line = text.count("\n", 0, row.start()) + 1
                said = f"the row begins at {start}, and the one before ends at {end}"
                yield _finding(Place(file, line), said, "correct the offset, or the widths")
            end = start + _width(kind)


def _sizes(file: str, text: str) -> Iterator[Finding]:
    """A row that names a section with a table of offsets says how many bytes that table has."""
    parts = SECTION.split(text)
    for title, section in zip(parts[1::2], parts[2::2], strict=True):
        rows = [row for row in ROW.finditer(section) if OFFSETS.fullmatch(row[1])]
        size = rf"^     - {re.escape(title)}\n(?:     - .*\n)*?     - (\d+) bytes$"
        told = re.search(size, text, re.MULTILINE)
        if not rows or told is None:
            continue
        end = int(rows[-1][1].split(", ")[-1]) + _width(rows[-1][2])
        if end != int(told[1]):
            place = Place(file, text.count("\n", 0, told.start(1)) + 1)
            said = f"{title} is said to have {told[1]} bytes, and its table has {end}"
            yield _finding(place, said, "correct the size, or the table")


def _width(kind: str) -> int:
    times = TIMES.search(kind)
    bytes_ = sum(int(bits) // 8 if bits else int(count) for bits, count in WIDTH.findall(kind))
    return bytes_ * (int(times[1]) if times else 1)
