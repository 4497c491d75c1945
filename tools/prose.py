"""The prose linter: finds words that the glossary replaces, in all texts that a person reads.

An entry of ``docs/glossary.rst`` may end with up to three lines:

* ``Not: heir, has heirs.`` lists words and phrases that are not written.
* ``Except: tension order.`` lists phrases in which such a word is right.
* ``Say: the noun.`` names the replacement, when it is not the term itself.

``^`` before a phrase limits it to the start of a sentence, ``#`` is any number. Identifiers and
quotations in backquotes are never findings. A question may use question words.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

from pygments.lexer import Lexer
from pygments.lexers import (
    BashLexer,
    CMakeLexer,
    CppLexer,
    CssLexer,
    JavascriptLexer,
    PythonLexer,
    TOMLLexer,
)
from pygments.token import Comment, String, is_token_subtype

from tools.steps import FailureError

GLOSSARY = Path("docs/glossary.rst")
RECORD = Path("build/results/prose.json")
PLACES = (
    *("docs", "requirements", "design", "extensions", "src", "sim", "client", "tests", "tools"),
    *("traceability", "site", "setup", "README.md", "CMakeLists.txt", "wr"),
)
VENDORED = ("minisearch.js",)  # written by others
LEXERS: dict[str, Callable[[], Lexer]] = {
    **dict.fromkeys((".hpp", ".cpp", ".c", ".dox"), CppLexer),
    **{".py": PythonLexer, ".toml": TOMLLexer, ".css": CssLexer, ".js": JavascriptLexer},
    **{".cmake": CMakeLexer, "CMakeLists.txt": CMakeLexer, "wr": BashLexer, ".sh": BashLexer},
}
SHORTEST_MESSAGE = 3  # words; a shorter literal is a name
CODE = "\0"  # stands in the place of each character that is no prose

TERM = re.compile(r"^   (\S.*)\n((?:\n? {6}.*\n)+)", re.MULTILINE)
HEADING = re.compile(r"^   \S.*(?=\n {6})", re.MULTILINE)
FIELD = re.compile(r"^ {6}(Not|Except|Say): (.*(?:\n {6}(?!\w+: ).+)*?)\.$", re.MULTILINE)
QUESTION = re.compile(r"\b(?:what|who)\b(?=[^.?!:;\0]*\?)", re.IGNORECASE)
QUOTED = re.compile(r"``.*?``|`[^`\n]*`|@\w+\{[^}]*\}|@param\s+\w+|'[\w-]+'", re.DOTALL)
NAME_ONLY = re.compile(r"/\*\s*\w+\s*\*/")  # of a parameter
MARKER = re.compile(r"^[ \t]*(?://[/!]?<?|/\*+|\*/|\*(?= )|#+:?)|\*/$", re.MULTILINE)
# Of pages: a literal block; a role without a text of its own; a directive; an option.
BLOCK = re.compile(
    r"^( *)(?:\.\. (?:code-block|uml|math|graphviz)::.*|(?!\.\. ).*::)\n(?:\1 +.*\n|\s*\n)+",
    re.MULTILINE,
)
ROLE = re.compile(
    r":[\w-]+:`[^`<]*`|<[^>`]*>`_{0,2}|^ *\.\. [\w-]+::.*|^ *:[\w-]+:.*", re.MULTILINE
)
# Of templates: an expression, a statement, a script, a tag; but not a literal of three words in it.
TAG = re.compile(
    r"\{\{.*?\}\}|\{%.*?%\}|<(script|style).*?</\1>|<(?!!--)[^>]*>",
    re.DOTALL,
)
SHOWN = re.compile(r'"([^"{}]*\w\s[^"{}]*\s\w[^"{}]*)"')


@dataclass(frozen=True)
class Word:
    """A phrase that is not written, and its replacement."""

    phrase: str
    say: str
    term: str


@dataclass
class Words:
    """The words that the glossary replaces, and the phrases in which they are right."""

    listed: list[Word] = field(default_factory=list)
    right: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.by_phrase = {word.phrase.lower(): word for word in self.listed}
        anywhere = [phrase for phrase in self.by_phrase if not phrase.startswith("^")]
        heads = [phrase[1:] for phrase in self.by_phrase if phrase.startswith("^")]
        self.wrong = [(pattern(anywhere), ""), (pattern(heads, at_head=True), "^")]
        self.exceptions = pattern(self.right)


@dataclass(frozen=True)
class Misuse:
    """A word in a text that the glossary replaces."""

    file: str
    line: int
    found: str
    word: Word

    def __str__(self) -> str:
        say, term = self.word.say, self.word.term
        return f'{self.file}:{self.line}: "{self.found}": say "{say}" (glossary: {term})'


def pattern(phrases: list[str], *, at_head: bool = False) -> re.Pattern[str]:
    """Returns a pattern of any of the phrases, as whole words that are no part of a name."""
    ordered = sorted(phrases, key=len, reverse=True)
    words = "|".join(r"\s+".join(map(re.escape, phrase.split())) for phrase in ordered)
    words = words.replace(r"\#", r"\d+")
    head = r"(?:\A|[.:;!?(\0]|\n\s*\n|@\w+)\s*" if at_head else r"(?<![\w@\\./&$<-])"
    return re.compile(rf"{head}({words or '(?!)'})(?![\w/(=\[-]|::|\.\w|\s=\s)", re.IGNORECASE)


def read_words(glossary: str) -> Words:
    """Reads the fields of all entries of the glossary."""
    words: list[Word] = []
    right: list[str] = []
    for term, text in TERM.findall(glossary):
        fields = {name: " ".join(value.split()) for name, value in FIELD.findall(text)}
        say = fields.get("Say", term)
        words += [Word(phrase, say, term) for phrase in phrases_of(fields.get("Not", ""))]
        right += phrases_of(fields.get("Except", ""))
    return Words(words, right)


def phrases_of(value: str) -> list[str]:
    return [phrase.strip() for phrase in value.split(",") if phrase.strip()]


def blank(text: str, mark: str = CODE) -> str:
    return re.sub(r"[^\n]", mark, text)


def prose_of(name: str, text: str) -> str:
    """Returns the text with each character that nobody reads as prose replaced by a mark."""
    path = Path(name)
    make_lexer = LEXERS.get(path.suffix) or LEXERS.get(path.name)
    if make_lexer is not None:
        text = prose_of_source(make_lexer(), text, toml=path.suffix == ".toml")
    elif path.suffix == ".html":
        text = TAG.sub(lambda tag: shown(tag[0]), text)
    else:
        for mask in (BLOCK, FIELD, ROLE, *([HEADING] if path.name == GLOSSARY.name else [])):
            text = mask.sub(lambda part: blank(part[0]), text)
    text = QUOTED.sub(lambda part: blank(part[0]), text)
    return QUESTION.sub(lambda part: blank(part[0]), text)


def shown(tag: str) -> str:
    """Blanks a tag of a template, except the messages in it."""
    result = blank(tag)
    for found in SHOWN.finditer(tag):
        result = result[: found.start(1)] + found[1] + result[found.end(1) :]
    return result


def prose_of_source(lexer: Lexer, text: str, *, toml: bool) -> str:
    """Keeps the comments, and the literals of at least three words. Neighbours stay together."""
    text += "\n"  # a lexer of C++ finds no comment in a line without its end
    parts = [CODE] * len(text)
    message: list[tuple[int, str]] = []

    def finish() -> None:
        if (
            len(re.findall(r"[A-Za-z]{2,}", " ".join(part for _, part in message)))
            >= SHORTEST_MESSAGE
        ):
            for at, part in message:
                parts[at : at + len(part)] = part
        message.clear()

    depth = 0
    for index, token, value in lexer.get_tokens_unprocessed(text):
        if is_token_subtype(token, String.Interpol) and value in ("{", "}"):
            depth += 1 if value == "{" else -1
        elif depth:
            continue
        elif is_comment(token) and not NAME_ONLY.fullmatch(value):
            finish()
            kept = MARKER.sub(lambda mark: " " * len(mark[0]), value)
            parts[index : index + len(value)] = kept
        elif is_token_subtype(token, String) and not (toml and token is String.Single):
            edge = token is String.Affix or not value.strip("\"'")
            message.append((index, " " * len(value) if edge else value))
        elif not value.strip():
            parts[index : index + len(value)] = value
        else:
            finish()
    finish()
    return "".join("\n" if one == "\n" else part for one, part in zip(text, parts, strict=True))


def is_comment(token: Any) -> bool:
    code = token in (Comment.Preproc, Comment.PreprocFile, Comment.Hashbang)
    return (is_token_subtype(token, Comment) and not code) or token is String.Doc


def check_text(words: Words, name: str, text: str) -> Iterator[Misuse]:
    """Yields each word of the text that the glossary replaces."""
    prose = prose_of(name, text)
    prose = words.exceptions.sub(lambda part: blank(part[0]), prose)
    for found_by, mark in words.wrong:
        for found in found_by.finditer(prose):
            phrase = " ".join(found[1].split())
            line = prose.count("\n", 0, found.start(1)) + 1
            yield Misuse(name, line, phrase, words.by_phrase[mark + phrase.lower()])


def texts(root: Path) -> Iterator[Path]:
    """Yields the files of the project that a person reads, without those of others."""
    suffixes = {*LEXERS, ".rst", ".md", ".html"}
    for place in PLACES:
        path = root / place
        for file in [path] if path.is_file() else sorted(path.rglob("*")):
            if {file.suffix, file.name} & suffixes and file.name not in VENDORED and file.is_file():
                yield file


def check_prose(root: Path, log: TextIO) -> str:
    """Checks all texts of the project, and records the number of findings."""
    words = read_words((root / GLOSSARY).read_text(encoding="utf-8"))
    count = files = 0
    for file in texts(root):
        files += 1
        name = str(file.relative_to(root))
        for misuse in check_text(words, name, file.read_text(encoding="utf-8")):
            count += 1
            log.write(f"{misuse}\n")
    record = root / RECORD
    record.parent.mkdir(parents=True, exist_ok=True)
    record.write_text(json.dumps({"findings": count}) + "\n", encoding="utf-8")
    if count:
        raise FailureError(f"{count} words that the glossary replaces")
    return f"{files} files, {len(words.listed)} words"
