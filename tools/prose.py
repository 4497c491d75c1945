"""The linter of prose. It finds words that the glossary replaces, in pages and templates, and in
the comments and messages of code."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from pygments.lexers import get_lexer_for_filename
from pygments.token import Comment, Literal, _TokenType, is_token_subtype
from pygments.util import ClassNotFound

from traceability.reading.lint_record import FOLDERS
from traceability.sources import files_below

GLOSSARY = Path("docs/glossary.rst")
PROSE = (".rst", ".md", ".dox", ".html")  # files with prose and markup
CODE = (".py", ".js", ".cpp", ".hpp", ".h", ".toml", ".tree", ".txt", ".cmake", "")
LITERALS = re.compile(
    r"\{%.*?%\}|\{\{.*?\}\}|\{#|#\}|<[^>]*>|``[^`]*``|`[^`\n]*`|:[\w-]+:(?=`)|\{\w[^}]*\}|[^\s<>]*[_/:]{1,2}\w[^\s<>]*",
    re.DOTALL,
)
TEMPLATE_CODE = re.compile(r"\{%.*?%\}|\{\{.*?\}\}", re.DOTALL)
STRING = re.compile(r"\"[^\"]*\"|'[^']*'")
ENTRY = re.compile(r"^   (\S.*)$")
NOT = re.compile(r"^      Not: (.*)\.$")
PLAIN = re.compile(r"^\* ((?:``[^`]+``(?:,\s+)?)+): (.*(?:\n  .*)*)", re.MULTILINE)
RIGHT = re.compile(r"\.\s+Right\s+in\s(.*)$", re.DOTALL)
IN_BACKQUOTES = re.compile(r"``([^`]+)``")
QUESTION = re.compile(r"\b(?:what|who)\b(?=[^.?!;]*\?)", re.IGNORECASE)
# Files that are not checked: the glossary contains the words, paper.toml quotes the paper,
# search.js lists words that readers type, and the last three files are vendored.
SKIPPED = (
    *("docs/glossary.rst", "design/paper.toml", "site/theme/static/search.js"),
    *("site/theme/static/minisearch.js", "site/theme/static/fzstd.js"),
    "tests/python/site/axe.min.js",
)
LEAST_WORDS = 2  # A string with fewer words is a name, and is not checked.


@dataclass(frozen=True)
class Term:
    """Words that are not used, and the words that replace them."""

    words: str
    better: str


@dataclass(frozen=True)
class ProseFinding:
    file: str
    line: int
    words: str
    better: str

    def __str__(self) -> str:
        return f'{self.file}:{self.line}: [prose] "{self.words}": write {self.better}'


def read_terms(text: str) -> Iterator[Term]:
    """Yields the words after "Not:" in each entry of the glossary, and the words of the list of
    plain words."""
    entry = ""
    for line in text.splitlines():
        if match := NOT.match(line):
            for words in match[1].split(", "):
                yield Term(words.strip("`"), f'"{entry}"')
        elif match := ENTRY.match(line):
            entry = match[1]
    for match in PLAIN.finditer(text):
        better = " ".join(RIGHT.sub("", match[2]).split())
        for words in IN_BACKQUOTES.findall(match[1]):
            yield Term(" ".join(words.split()), better)


def right_phrases(text: str) -> list[str]:
    """Returns the phrases in which a word of the list of plain words is allowed."""
    plain = (RIGHT.search(match[2]) for match in PLAIN.finditer(text))
    return [phrase for right in plain if right for phrase in IN_BACKQUOTES.findall(right[1])]


def pattern_of(phrases: Iterable[str]) -> re.Pattern[str]:
    """Returns a pattern that matches whole words. A blank matches any white space, and # matches
    any number. The pattern ignores case."""
    longest = sorted((" ".join(phrase.split()) for phrase in phrases), key=len, reverse=True)
    words = "|".join(map(re.escape, longest)).replace(r"\ ", r"\s+").replace(r"\#", r"\d+")
    return re.compile(rf"(?<![\w.-])(?:{words or '(?!)'})(?![\w-])", re.IGNORECASE)


def prose_of(path: Path) -> str:
    """Returns the prose of a file. Blanks replace all other text, so that the line numbers do not
    change."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".html":
        text = TEMPLATE_CODE.sub(lambda match: _strings(match[0]), text)
    elif path.suffix not in PROSE:
        text = _remarks(path, text)
    return _blank(LITERALS, text)


def _blank(pattern: re.Pattern[str], text: str) -> str:
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def _strings(code: str) -> str:
    """Returns the code of a template. Null characters replace everything except the strings that
    have several words."""
    texts = [match for match in STRING.finditer(code) if len(match[0].split()) >= LEAST_WORDS]
    kept = {place for match in texts for place in range(match.start() + 1, match.end() - 1)}
    return "".join(
        letter if letter == "\n" or place in kept else "\0" for place, letter in enumerate(code)
    )


def _remarks(path: Path, text: str) -> str:
    """Returns the comments of code, and its strings that have several words. Null characters
    replace all other text. Therefore no phrase can begin in one comment or string and end in the
    next."""
    name = {"": "wr.sh", ".tree": "a.sh", ".txt": "CMakeLists.txt"}.get(path.suffix, path.name)
    try:
        tokens = get_lexer_for_filename(name).get_tokens_unprocessed(text)
    except ClassNotFound:
        return ""
    return "".join(
        part if _is_prose(kind, part) else re.sub(r"[^\n]", "\0", part) for _, kind, part in tokens
    )


def _is_prose(kind: _TokenType, part: str) -> bool:
    if is_token_subtype(kind, Comment.Preproc) or is_token_subtype(kind, Comment.PreprocFile):
        return False
    if is_token_subtype(kind, Comment) or is_token_subtype(kind, Literal.String.Doc):
        return True
    return is_token_subtype(kind, Literal.String) and len(part.split()) >= LEAST_WORDS


def lint_prose(root: Path) -> list[ProseFinding]:
    """Returns all findings, sorted by file and line.

    Most files contain none of the words. Only the other files are separated into code and prose,
    because the separation takes most of the time."""
    glossary = (root / GLOSSARY).read_text(encoding="utf-8")
    better = {term.words.lower(): term.better for term in read_terms(glossary)}
    pattern = pattern_of(better)
    right = pattern_of(right_phrases(glossary))
    findings = [
        ProseFinding(str(GLOSSARY), number, "Not:", "it at the beginning of a line of its entry")
        for number, line in enumerate(glossary.splitlines(), 1)
        if " Not: " in line and not NOT.match(line)
    ]
    for path in files_below(root, FOLDERS):
        file = str(path.relative_to(root))
        if path.suffix not in (*PROSE, *CODE) or file in SKIPPED:
            continue
        if not pattern.search(path.read_text(encoding="utf-8")):
            continue
        prose = _blank(right, _blank(QUESTION, prose_of(path)))
        for match in pattern.finditer(prose):
            words = " ".join(match[0].split())
            line = prose.count("\n", 0, match.start()) + 1
            findings.append(ProseFinding(file, line, words, better[words.lower()]))
    return findings
