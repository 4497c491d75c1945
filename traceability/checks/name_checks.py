"""doc-name: if a text contains a name of the code, the name exists in the code or in the paper.

The check reads the comments of the code, the pages, and the texts of design/. In a page, it reads
only literals and names of the form Class::method. If a page or a text of design/ names a test, this
test exists. If a page names an attribute of a report, the code of the client has this attribute.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from traceability.checks.example_checks import wrong_examples
from traceability.model.design_model import Model
from traceability.reading.ast_facts import BodyFact, MethodFact
from traceability.reading.comments import code_of, comment_tokens
from traceability.reading.constant_texts import ROLE, formula_text
from traceability.reading.source_facts import Facts
from traceability.reading.source_lines import lines_below, place_at, texts_below
from traceability.schema import Finding, Place
from traceability.sources import DESIGN, text_of

# Forms of names in comments. No English word has one of these forms: HallCount, Wheel::stop,
# kPeriod.
IN_COMMENT = re.compile(
    r"`([A-Za-z_]\w*(?:::\w+)*)`|\b([A-Z]\w*(?:::\w+)+|[A-Z][a-z]+(?:[A-Z][a-z0-9]+)+"
    r"|k[A-Z][a-z]{2,}\w*)"
)
FUNCTION = re.compile(r"(?<![\w:])([a-z]\w*)\(\)")  # a function without a class in a comment
IN_PAGE = re.compile(
    r"(?<![\w:])(?:wr::)?([A-Z]\w*(?:::\w+)+)|``([A-Z][a-z]+(?:[A-Z][a-z0-9]+)+)``"
)
IN_DESIGN = re.compile(r"(?<!:constant:)`([A-Za-z_]\w*(?:::\w+)*)`")
PAGES = (".md", ".rst", ".toml")
IN_PAGES = ("README.md", "CONTRIBUTING.md", "docs", "design", "changes", "ports")
# A test is SUITE.TEST. A name in capitals, such as an enumerator of Python, is not a test.
TEST = re.compile(r"(?<![\w./:])([A-Z]\w*)\.([A-Z]\w*[a-z]\w*)(?![\w(/])")
OF_REQUIREMENT = re.compile(r"N?FR\d+_")
# "RC derives from Mode": both names can be literals or links.
DERIVES = re.compile(
    r"\b([A-Z]\w+)`{0,2}\s+derives\s+from\s+(?::module:)?`{0,2}([A-Z]\w+)(?![\w:])"
)
FILTER = re.compile(r"--gtest_filter='([^']+)'")
# Classes of the client that represent a report, and the title of the table with their attributes.
MESSAGES = "client/weeding_robot_client/messages.py"
OF_REPORT = ("Report", "WheelReport", "ReportedSetPoint")
ATTRIBUTES = ".. list-table:: Attributes of a report"
ROW = re.compile(r" +\* - (.*)")
IN_ROW = re.compile(r"(?:``|\.)([a-z]\w*)")
ATTRIBUTE = re.compile(r"(?<![\w./])report((?:\.[a-z]\w*\b(?:\[\d\])?(?!\())+)")
IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
FOR_A_TOOL = ("NOLINT", "clang-format")
FRAMES = "design/frames.toml"
FIELD = re.compile(r'\{ name = "(\w+)",( each = "wheel",)?')
PLACEHOLDER = "Class"  # In docs/, Class::method is an example that represents any method.
# File of design/ -> the check that reports wrong names in this file. For all other texts, this
# check is doc-name.
CHECKS = {"concordance": "paper-stale", "changes": "pattern-change"}


@dataclass
class Words:
    """All names that a text may contain: names of the code and names of the paper."""

    code: set[str]
    paper: set[str]
    facts: Facts

    def knows(self, name: str) -> bool:
        owner, _, member = name.rpartition("::")
        if not owner or name in self.code:
            return name in self.code or name in self.paper
        if owner == PLACEHOLDER:
            return True
        fact = self.facts.classes.get(owner)
        if fact is None:
            return all(part in self.code for part in name.split("::"))
        return member in self.members(owner)

    def members(self, owner: str) -> set[str]:
        """Returns the names of the members of a class: own members, inherited members and nested
        classes."""
        fact = self.facts.classes.get(owner)
        if fact is None:
            return set()
        names = {method.name for method in fact.methods} | {field.name for field in fact.fields}
        names |= {value.name for value in fact.values}
        inner = f"{owner}::"
        names |= {name.removeprefix(inner) for name in self.facts.classes if name.startswith(inner)}
        return names.union(*(self.members(base) for base in fact.bases))


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    words = _words(model, facts)
    comments = list(_comments(facts))
    named = [*_in_comments(comments), *_pages(facts.root), *_design(facts.root)]
    for place, name in named:
        if not words.knows(name):
            kind = CHECKS.get(Path(place.file).stem, "doc-name")
            text = f"the text names {name}, which the code does not have"
            yield Finding(place, kind, text, "write the name that the code has now")
    yield from _functions(model, words, comments)
    yield from _constants(facts)
    yield from _tests(model, facts.root)
    yield from _derivations(facts)
    yield from wrong_attributes(facts.root)
    yield from wrong_examples(facts.root)


def _constants(facts: Facts) -> Iterator[Finding]:
    """Finds constants and formulas that have no value although a text of design/ inserts them."""
    for place, line in lines_below(facts.root, ("design",), (".toml",)):
        for formula in ROLE.findall(line):
            if formula_text(formula, facts.declared.entries.constants) is None:
                text = f"the text inserts {formula}, which has no value"
                yield Finding(place, "doc-name", text, "write the name that the code has now")


def _tests(model: Model, root: Path) -> Iterator[Finding]:
    """Finds names of tests that do not exist, and filters that match no test."""
    suites = {test.suite for test in model.tests.values()}
    for place, line in lines_below(root, IN_PAGES, PAGES):
        if line.lstrip().startswith("+"):  # an added line of an example change
            continue
        names = [
            f"{suite}.{case}"
            for suite, case in TEST.findall(line)
            if suite in suites or suite.endswith("Test") or OF_REQUIREMENT.match(case)
        ]
        names += FILTER.findall(line)
        for name in names:
            if not any(fnmatchcase(test, name) for test in model.tests):
                text = f"the text names the test {name}, which does not exist"
                yield Finding(place, "doc-name", text, "write the name of a test")


def _derivations(facts: Facts) -> Iterator[Finding]:
    """Finds sentences in pages that state a wrong base class of a class."""
    for file, text in texts_below(facts.root, IN_PAGES, PAGES):
        for match in DERIVES.finditer(text):
            name, base = match.groups()
            if {name, base} <= facts.classes.keys() and base not in facts.bases_of(name):
                said = f"the text states that {name} derives from {base}, but {name} does not"
                place = place_at(file, text, match.start())
                yield Finding(place, "doc-name", said, "write the name of the base class")


def wrong_attributes(root: Path) -> Iterator[Finding]:
    """Finds names of attributes in pages, if the client's report has no such attribute. Also finds
    fields of this report that are not in the table of the attributes."""
    if not (root / MESSAGES).is_file():
        return
    fields, members = _of_report((root / MESSAGES).read_text(encoding="utf-8"))
    listed: set[str] = set()
    in_table = False
    for place, line in lines_below(root, IN_PAGES, PAGES):
        in_table = line.startswith(ATTRIBUTES) or (in_table and not line[:1].strip())
        row = ROW.match(line) if in_table else None
        names = set(IN_ROW.findall(row[1])) if row else set()
        listed |= names
        names = names.union(*map(IDENTIFIER.findall, ATTRIBUTE.findall(line)))
        for name in sorted(names - members):
            text = f"a report of the client has no attribute '{name}'"
            yield Finding(place, "doc-name", text, "write the name of an attribute")
    for name, number in fields.items() if listed else ():
        if name not in listed:
            text = f"the table of the attributes of a report does not list '{name}'"
            yield Finding(Place(MESSAGES, number), "doc-name", text, "add it to docs/client.rst")


def _of_report(code: str) -> tuple[dict[str, int], set[str]]:
    """Returns the fields and all members of the classes of a report. The line of each field is also
    returned."""
    fields: dict[str, int] = {}
    members: set[str] = set()
    classes = (node for node in ast.parse(code).body if isinstance(node, ast.ClassDef))
    for node in (node for owner in classes if owner.name in OF_REPORT for node in owner.body):
        if isinstance(node, ast.FunctionDef):
            members.add(node.name)
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            members.add(node.target.id)
            if not ast.unparse(node.annotation).startswith("ClassVar"):
                fields[node.target.id] = node.lineno
    return fields, members


def _words(model: Model, facts: Facts) -> Words:
    code: set[str] = set()
    read = (*DESIGN, "sim", "traceability/reading/products.py")
    for _, text in texts_below(facts.root, read, (".hpp", ".cpp", ".py")):
        code.update(IDENTIFIER.findall(code_of(text)))
    code |= _fields(facts.root) | {constant.name for constant in facts.syntax.values}
    code |= {name.partition(".")[0] for name in model.constants}
    paper = {word for entry in model.paper for word in re.findall(r"[\w:]+", entry.name)}
    return Words(code, paper, facts)


def _fields(root: Path) -> set[str]:
    """Returns the names of the fields and values of the frames. A field that exists for each wheel
    has a name for each wheel."""
    found = FIELD.findall(text_of(root / FRAMES))
    return {name for name, _ in found} | {
        f"{name}{wheel}" for name, each in found if each for wheel in range(4)
    }


def _functions(model: Model, words: Words, comments: list[tuple[Place, str]]) -> Iterator[Finding]:
    """Finds, in comments, names of functions that do not exist. If a comment of a module A names a
    function, the function must be in the files of A, or must be a method of a module that A
    uses."""
    syntax = words.facts.syntax
    functions: list[BodyFact | MethodFact] = [*syntax.bodies]
    functions += [method for each in syntax.classes for method in each.methods]
    by_file: dict[str, set[str]] = {}
    for fact in functions:
        by_file.setdefault(fact.place.file, set()).add(fact.id.rpartition("::")[2])
    every = set().union(*by_file.values())
    of_module = {
        name: set().union(
            *(by_file.get(file, set()) for file in (module.header, module.source) if file),
            *(words.members(each) for each in (name, *module.uses)),
        )
        for name, module in model.modules.items()
    }
    for place, text in comments:
        module = words.facts.written_in.get(place.file, "")
        for name in FUNCTION.findall(text):
            if name not in of_module.get(module, every):
                used = f"neither {module} nor a module that it uses"
                where = f"{used} has" if module in of_module else "the code does not have"
                says = f"the text names {name}(), which {where}"
                yield Finding(place, "doc-name", says, "write the name that the code has now")


def _in_comments(comments: list[tuple[Place, str]]) -> Iterator[tuple[Place, str]]:
    for place, text in comments:
        for match in IN_COMMENT.finditer(text):
            yield place, match[1] or match[2]


def _comments(facts: Facts) -> Iterator[tuple[Place, str]]:
    """Yields each line of the comments of the code."""
    for file, code in texts_below(facts.root, DESIGN, (".hpp", ".cpp")):
        for line, _, written in comment_tokens(code):
            for number, text in enumerate(written.split("\n"), line):
                if not any(mark in text for mark in FOR_A_TOOL):
                    yield Place(file, number), text


def _pages(root: Path) -> Iterator[tuple[Place, str]]:
    for place, line in lines_below(root, IN_PAGES, (".md", ".rst")):
        for match in IN_PAGE.finditer("" if line.lstrip().startswith("+") else line):
            yield place, match[1] or match[2]


def _design(root: Path) -> Iterator[tuple[Place, str]]:
    for place, line in lines_below(root, ("design",), (".toml",)):
        for match in IN_DESIGN.finditer("" if line.startswith("#") else line):
            yield place, match[1]
