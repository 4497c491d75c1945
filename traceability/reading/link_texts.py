"""Finds the texts on which the verdict of a requirement depends. Layout and comments inside code
are left out.

Each text is looked up in its file by its name and not by a line number. The same name therefore
also finds the earlier text in an earlier version of the file."""

from __future__ import annotations

import functools
import hashlib
import re
from collections.abc import Iterator

from traceability.reading.comments import code_of, read_comments
from traceability.reading.gtest_cases import read_tests

OF_LINKS = ("satisfies",)  # Tags that are left out of the specification of a method.
TOKENS = re.compile(r"""\d[\w.']*|"(?:\\.|[^"\\])*"|\w+|[^\s\w]""")
HASH_DIGITS = 16
STRING = re.compile(r'"(?:\\.|[^"\\\n])*"')
CONSTANT = re.compile(
    r"\b(?:constexpr|constinit)\s[^;(){}=]*[={(][^;{]*(?:\{[^;]*\}[^;]*)?;|\benum\s[^;{}]*\{[^}]*\};"
)
BOUND = re.compile(r"// (bound|passes): ([^\n;]*)")
CODE = ("body", "test", "function")  # kinds of texts that are code
# Matches the declaration of a variable or a parameter: a type and a name.
LOCAL = re.compile(
    r"(?<![\w.:])([A-Za-z_][\w:]*)(?:<[^;(){}]*>)?(?:\s+const)?(?:\s*[&*]+\s*|\s+)"
    r"([a-z]\w*)\s*(?=[={(\[;,)]|:(?!:))"
)
NO_TYPES = {
    *("return", "else", "case", "goto", "throw", "new", "delete", "typename", "using", "class"),
    *("namespace", "operator", "co_return", "co_await", "sizeof", "not", "and", "or", "struct"),
}
BUILT_IN = {
    *("int", "char", "bool", "float", "double", "short", "long", "unsigned", "signed", "auto"),
    *("const", "void", "this", "nullptr", "true", "false", "if", "for", "while", "switch"),
}
TREE = re.compile(r"^(N?FR-\d+)[^\n]*\n((?:[^\n]*\n)*?)(?=^N?FR-|\Z)", re.MULTILINE)


@functools.cache
def hash_of_text(text: str) -> str:
    """Returns a hash of the words and punctuation marks of a text. Blanks and line breaks do not
    change the hash."""
    words = " ".join(TOKENS.findall(text))
    return hashlib.sha256(words.encode()).hexdigest()[:HASH_DIGITS]


def hash_of(kind: str, text: str) -> str:
    """Returns the hash of a text. If the text is code, a change of the names of local variables
    does not change the hash."""
    return hash_of_text(numbered(text) if kind in CODE else text)


def numbered(code: str) -> str:
    """Returns the code. The name of each local variable and of each parameter is replaced by a
    number."""
    declared = [match[2] for match in LOCAL.finditer(code) if match[1] not in NO_TYPES]
    names = list(dict.fromkeys(name for name in declared if name not in BUILT_IN))
    if not names:
        return code
    numbers = {name: f"${number}" for number, name in enumerate(names)}
    used = re.compile(rf"(?<![\w.$>:])({'|'.join(map(re.escape, names))})(?!\w)")
    return used.sub(lambda match: numbers[match[1]], code)


@functools.cache
def requirements(text: str) -> list[tuple[str, str]]:
    """Returns the id and the complete text of each requirement in a file."""
    return [
        (part.tags[0].argument, part.source())
        for comment in read_comments("", text)
        for part in comment.parts("requirement")
    ]


@functools.cache
def specifications(text: str) -> list[tuple[range, str, str]]:
    """Returns each documentation comment with the declaration below it. Each result consists of the
    line numbers of both parts, the declaration, and one text that contains both parts."""
    lines = text.splitlines()
    found = []
    for comment in read_comments("", text):
        first = comment.place.end or 0
        last = next((n for n in range(first, len(lines)) if re.search(r"[;{]", lines[n])), first)
        declaration = " ".join(line.strip() for line in lines[first : last + 1])
        declaration = re.split(r"[;{]", declaration)[0].strip()
        whole = "\n".join(filter(None, (comment.source(without=OF_LINKS), declaration)))
        found.append((range(comment.place.line, last + 2), declaration, whole))
    return found


@functools.cache
def tests(text: str) -> list[tuple[str, str]]:
    """Returns the id and the body of each test in a file. Comments in the body are left out."""
    return [(case.id, case.code) for case in read_tests(text)]


@functools.cache
def support(text: str) -> str:
    """Returns the text of a test file outside its tests: fixtures, computed expected values,
    helpers and lists of parameters.

    If the file contains no tests, returns the whole text without comments."""
    rest = text
    for case in read_tests(text):
        rest = rest.replace(case.body, "", 1)
    return code_of(rest)


def without_remarks(text: str) -> str:
    """Returns the lines of an invocation tree or a scenario. Each line begins with the depth of its
    indentation. ``#`` comments are left out."""
    lines = (line.split("#")[0].rstrip() for line in text.splitlines())
    return "\n".join(
        f"{(len(line) - len(line.lstrip())) // 2} {line.strip()}" for line in lines if line
    )


def texts_of_requirement(text: str, name: str) -> Iterator[str]:
    return (source for identifier, source in requirements(text) if identifier == name)


def texts_of_tree(text: str, name: str) -> Iterator[str]:
    """Yields the nodes of the invocation tree of a requirement, as one text."""
    return (without_remarks(match[2]) for match in TREE.finditer(text) if match[1] == name)


def texts_of_method(text: str, name: str) -> Iterator[str]:
    """Yields the comment and the declaration of each method that has this name and a comment."""
    named = re.compile(rf"(?<![\w.:>]){re.escape(_last(name))}\(")
    return (whole for _, declaration, whole in specifications(text) if named.search(declaration))


def texts_of_body(text: str, name: str) -> Iterator[str]:
    """Yields the code of each function with this name, from its first line to its closing brace."""
    begins = re.compile(rf"^( *)[^\n/#]*?\b{re.escape(_last(name))}\(", re.MULTILINE)
    for match in begins.finditer(text):
        end = re.compile(rf"}}\s*$|^{match[1]}}}", re.MULTILINE).search(text, match.end())
        yield code_with_bounds(text[match.start() : end.end() if end else len(text)])


def code_with_bounds(text: str) -> str:
    """Returns code without comments. Comments that declare the bound of a loop remain, because they
    have an effect on a check."""
    return code_of(BOUND.sub(r"\1(\2);", text))


def texts_of_constants(text: str, _file: str) -> Iterator[str]:
    """Yields the constants, the tables, the constant-initialised objects and the enumerations of a
    file."""
    code = STRING.sub(lambda match: match[0].replace(";", ","), code_of(text))
    yield "\n".join(match[0] for match in CONSTANT.finditer(code))


def texts_of_test(text: str, name: str) -> Iterator[str]:
    """Yields the body of the test ``Suite.Name``, without comments."""
    return (code for test, code in tests(text) if test == name)


def texts_of_support(text: str, name: str) -> Iterator[str]:
    """Yields the text of a file outside its tests. For a scenario, yields all lines without
    comments."""
    yield without_remarks(text) if name.endswith(".scenario") else support(text)


def _last(name: str) -> str:
    return name.rsplit("::", 1)[-1]


FINDERS = {
    "requirement": texts_of_requirement,
    "tree": texts_of_tree,
    "method": texts_of_method,
    "body": texts_of_body,
    "constants": texts_of_constants,
    "test": texts_of_test,
    "support": texts_of_support,
}
