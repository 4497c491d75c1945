"""doc-scenario: docs/scenarios.rst names the words that the reader of scenarios accepts. A comment
of a scenario can contain numbers with a unit. Each of these numbers is also in a line of the
scenario, or in a requirement that the comment names. Each example scenario is named in a test."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

from traceability.model.design_model import Model
from traceability.model.requirement_numbers import WORDS
from traceability.model.safety_case import plays
from traceability.reading.products import LIST, listed
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below, texts_below
from traceability.schema import Finding, Place
from traceability.sources import files_below

PAGE = "docs/scenarios.rst"
FOLDER = "sim/scenario"
EXAMPLES = f"{FOLDER}/examples"
# The files that read the actions of a scenario, and the files that name fields and their values.
READERS = tuple(f"{FOLDER}/{name}.cpp" for name in ("Scenario", "WorldAction", "GroundTruth"))
NAMES = (
    *(f"{FOLDER}/{name}.cpp" for name in ("FrameFields", "ControlChannel")),
    *("design/frames.toml", "design/board_findings.toml"),
)
# A word that a reader compares, or the first member of a row in a table of words.
READ = re.compile(r'(?:== |takeIf\(|nextIs\(|skip\(|\{)"([a-z][\w-]*)"')
NAMED = re.compile(r'"([A-Za-z][\w-]*)"')
FAULT = re.compile(r'\{"([\w-]+)", \{plant::Fault::\w+, (true|false), (true|false)\}\}')
LITERAL = re.compile(r"``([^`]+)``")
LINE = re.compile(r"^ +((?:at|from) \d.*)")  # a line of a scenario in a literal block
WORD = re.compile(r"(?<![\w./-])[A-Za-z][a-z][\w-]*(?![\w./])")
BYTE = re.compile(r"[0-9a-f]{2}")
FAULTS = ".. list-table:: Faults"
FIRST_CELL = re.compile(r" +\* - (.*)")

# Unit in a comment -> the kind of its quantity, and the factor to the unit of the scenario.
UNITS = {
    **{"s": ("time", 1000), "second": ("time", 1000), "seconds": ("time", 1000)},
    **{"ms": ("time", 1), "minutes": ("time", 60_000)},
    **{"%": ("share", 1), "percent": ("share", 1)},
    **{"rpm": ("velocity", 10), "m/s": ("speed", 1000), "m": ("way", 1000), "mm": ("way", 1)},
    **{"V": ("voltage", 1000), "A": ("current", 1000)},
    **{"degree": ("angle", 100), "degrees": ("angle", 100), "electrical degrees": ("phase", 1)},
}
# A number that follows the word "about" is not compared.
STATED = re.compile(
    rf"(?<![\w.-])(?<!\babout )-?(\d+(?:\.\d+)?|one|{'|'.join(WORDS)}) ?"
    rf"({'|'.join(sorted(UNITS, key=len, reverse=True))})(?![\w^/])"
)
# The times before an action: at T, or from T to U every D.
WHEN = re.compile(r"(?:at|from|to|every) (\d+)")
INTEGER = re.compile(r"(?<![\w.])\d+(?![\w.])")
RANGE = re.compile(r"between (-?\d+) (-?\d+)")
CITED = re.compile(r"\bN?FR-\d+\b")
# A number is in the middle of an expected range if each end of the range differs from the number by
# at most this share of the number.
NARROW = Fraction(1, 8)
Amount = tuple[str, Fraction]  # the kind of a quantity, and its amount in the unit of the scenario


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    if (facts.root / PAGE).is_file():
        yield from wrong_words(facts.root)
        yield from _wrong_faults(facts.root)
    yield from unplayed_examples(facts.root)
    texts = {name: requirement.text for name, requirement in model.requirements.items()}
    for file, scenario in texts_below(facts.root, (FOLDER,), (".scenario",)):
        for line, number in missing_numbers(scenario, texts):
            said = f"the comment states {number}"
            text = f"{said}, but no line of the scenario and no named requirement has this value"
            yield Finding(Place(file, line), "doc-scenario", text)


def unplayed_examples(root: Path) -> Iterator[Finding]:
    """Finds example scenarios that are named in no test. Reads only files of tests that contain the
    name of the folder with the examples."""
    tests = texts_below(root, ("tests",), (".cpp",))
    playing = "".join(text for _, text in tests if EXAMPLES in text)
    for path in files_below(root, (EXAMPLES,), (".scenario",)):
        if not plays(path.stem, "", playing, ()):
            place = Place(str(path.relative_to(root)), 1)
            fix = "play it in tests/system/ExampleScenariosTest.cpp"
            yield Finding(
                place, "doc-scenario", f"the scenario {path.stem} is named in no test", fix
            )


# ---- words of the page -------------------------------------------------------


def wrong_words(root: Path) -> Iterator[Finding]:
    """Finds words on the page that a scenario cannot contain, and words of scenarios that the page
    does not name. Numbers of wheels at the ends of words are ignored."""
    read = [(place, READ.findall(line)) for place, line in lines_below(root, READERS, ())]
    known = {_stem(word) for _, words in read for word in words}
    known |= {
        _stem(word) for _, line in lines_below(root, NAMES, ()) for word in NAMED.findall(line)
    }
    known |= {_stem(path.stem) for path in files_below(root, (FOLDER,), (".scenario",))}
    known |= {product.name for product in listed(root)} if (root / LIST).exists() else set()
    named: set[str] = set()
    for place, line in lines_below(root, (PAGE,), ()):
        texts = [text for text in LITERAL.findall(line) if not text.startswith(("--", "./"))]
        words = {word for text in [*texts, *LINE.findall(line)] for word in WORD.findall(text)}
        named |= {_stem(word) for word in words}
        for word in sorted(words):
            if _stem(word) not in known and not (word.isupper() or BYTE.fullmatch(word)):
                text = f"this page names '{word}', but a scenario cannot contain this word"
                yield Finding(place, "doc-scenario", text)
    for place, words_read in read:
        for word in words_read:
            if _stem(word) not in named:
                text = f"{PAGE} does not name {word}"
                yield Finding(place, "doc-scenario", text, "describe the word on the page")


def _stem(word: str) -> str:
    return word.rstrip("0123")


def _wrong_faults(root: Path) -> Iterator[Finding]:
    """Finds names of faults in the table of the page, if a scenario cannot contain such a fault
    with this number of arguments."""
    faults = {
        name: [wheel, value].count("true")
        for _, line in lines_below(root, READERS, ())
        for name, wheel, value in FAULT.findall(line)
    }
    in_table = False
    for place, line in lines_below(root, (PAGE,), ()):
        in_table = line.startswith(FAULTS) or (in_table and not line[:1].strip())
        cell = FIRST_CELL.match(line) if in_table else None
        for literal in LITERAL.findall(cell[1]) if cell else ():
            name, *arguments = literal.split()
            if faults.get(name) != len(arguments):
                text = f"this page names the fault '{literal}', but a scenario cannot contain it"
                yield Finding(place, "doc-scenario", text)


# ---- numbers in comments -----------------------------------------------------


def missing_numbers(scenario: str, requirements: dict[str, str]) -> Iterator[tuple[int, str]]:
    """Yields each number with a unit that is in a comment of a scenario, but neither in a line of
    the scenario nor in a requirement that the comments name. Each result consists of the line and
    the number."""
    parts = [line.partition("#") for line in scenario.splitlines()]
    has_value = _Values([code for code, _, _ in parts])
    comment, starts = "", []
    for _, _, text in parts:
        starts.append(len(comment))
        comment += f"{text.strip()} " if text else ""
    cited = {
        _amount(match)
        for name in CITED.findall(comment)
        for match in STATED.finditer(requirements.get(name, ""))
    }
    for match in STATED.finditer(comment):
        amount = _amount(match)
        if amount not in cited and amount not in has_value:
            yield sum(start <= match.start() for start in starts), match[0]


def _amount(match: re.Match[str]) -> Amount:
    kind, factor = UNITS[match[2]]
    number = Fraction(1 if match[1] == "one" else WORDS.get(match[1]) or match[1])
    return kind, number * factor


class _Values:
    """The values in the lines of a scenario."""

    def __init__(self, lines: list[str]) -> None:
        actions = " ".join(WHEN.sub("", line) for line in lines)
        self._numbers = set(map(int, INTEGER.findall(actions)))
        self._times = {int(time) for line in lines for time in WHEN.findall(line)}
        ends = [sorted(abs(int(end)) for end in pair) for pair in RANGE.findall(actions)]
        self._ranges = [(low, high) for low, high in ends]

    def __contains__(self, amount: Amount) -> bool:
        """Returns whether a line has the value. Also returns true in three cases: the value is the
        difference of two times, a percentage by which two numbers differ, or the middle of an
        expected range."""
        kind, number = amount
        if number in self._numbers:
            return True
        if kind == "time":
            return any(time + number in {0, *self._times} for time in (0, *self._times))
        if kind == "share":
            ends = [
                n * (1 + share) for n in self._numbers for share in (number / 100, -number / 100)
            ]
            return any(end in self._numbers for end in ends if end)
        return any(
            low <= number <= high and max(number - low, high - number) <= number * NARROW
            for low, high in self._ranges
        )
