"""Reads the documentation comments. A comment has tags. Each tag has arguments, a text and a source
line.

A comment is a block of ``///`` lines or a ``/** */``. It belongs to the declaration to which the
syntax tree assigns it, or to the test macro below it. In a ``.dox`` file, a tag of the comment
names the described element, such as a requirement. The texts are plain text. They may contain
lists, and `names` in backticks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path

from traceability.schema import Place
from traceability.sources import files_below

SUFFIXES = (".hpp", ".cpp", ".dox")
# After the name of a tag, the arguments follow in braces, as a single word, or as a text. The
# settings of Doxygen declare the tags that this project adds.
IN_BRACES = {"role": 2, "patternapp": 3, "isr": 1, "hides": 1}
WORD = ("param", "tparam", "throws", "satisfies", "verifies", "requirement", "dir", "page")
OF_CODE = ("brief", "return", "pre", "post", "errors", "function", "secret", "why", "changes")
OF_REQUIREMENTS = (
    *("rationale", "source", "level", "product", "method", "partly", "goal", "priority"),
    "evidence",
)
TAGS = {*IN_BRACES, *WORD, *OF_CODE, *OF_REQUIREMENTS, "datatype"}

# The pattern matches numbers first, because the ' in a number such as 1'000 does not begin a
# character literal.
TOKENS = re.compile(
    r"""\b\d[\w'.]*|R"(?P<mark>[^()\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+'"""
    r"""|(?P<comment>//[^\n]*|/\*.*?\*/)""",
    re.DOTALL,
)
SLASHES = re.compile(r"//[/!](?!/)(<?) ?(.*)")
STARRED = re.compile(r"/\*[*!](?![*/])<?(.*)\*/", re.DOTALL)
STAR = re.compile(r"^[ \t]*\*?[ \t]?")
TAG = re.compile(r"`[^`\n]*`|(?<![^\s(])[@\\]([A-Za-z]\w*)(?:\{((?:\\.|[^{}\\])*)\})?")
BLANK_LINE = re.compile(r"\n\s*\n")
NEXT_ARGUMENT = re.compile(r"(?<!\\),\s*")


@dataclass
class Tag:
    """A tag of a comment. ``text`` is the paragraph of the tag, ``more`` are the paragraphs after
    this paragraph, and ``source`` is the original text. The text before the first tag of a comment
    is regarded as a tag without a name."""

    name: str
    arguments: list[str]
    text: str
    more: list[str]
    place: Place
    source: str

    @property
    def argument(self) -> str:
        return next(iter(self.arguments), "")


@dataclass
class Comment:
    place: Place  # first and last line of the comment
    tags: list[Tag]

    def of(self, name: str) -> list[Tag]:
        return [tag for tag in self.tags if tag.name == name]

    def all(self, name: str) -> list[str]:
        """Returns the text of each tag with this name. For some tags, the text is in braces after
        the name."""
        return [tag.argument if name in IN_BRACES else tag.text for tag in self.of(name)]

    def one(self, name: str) -> str:
        return next(iter(self.all(name)), "")

    def words(self, name: str) -> list[str]:
        """Returns the first argument of each tag with this name, without duplicates."""
        return list(dict.fromkeys(tag.argument for tag in self.of(name)))

    def texts(self, name: str) -> dict[str, str]:
        """Returns the texts of tags such as ``@param``, by their first arguments."""
        return {tag.argument: tag.text for tag in self.of(name)}

    def parts(self, name: str) -> Iterator[Comment]:
        """Splits the comment before each tag with this name. Yields each part as a separate
        comment."""
        starts = [number for number, tag in enumerate(self.tags) if tag.name == name]
        for start, end in pairwise([*starts, len(self.tags)]):
            yield Comment(self.tags[start].place, self.tags[start:end])

    @cached_property
    def brief(self) -> str:
        """Returns the text of ``@brief``. If there is no brief, returns the first paragraph."""
        return self.one("brief") or self.one("")

    @cached_property
    def details(self) -> str:
        """Returns all paragraphs of the comment except the brief and the texts of the tags."""
        first = [self.one("")] if self.of("brief") else []
        return "\n\n".join(
            filter(None, [*first, *(text for tag in self.tags for text in tag.more)])
        )

    def source(self, without: tuple[str, ...] = ()) -> str:
        """Returns the original text of the comment without the named tags. Each paragraph becomes
        one text line."""
        written = (tag.source for tag in self.tags if tag.name not in without)
        paragraphs = (text for tag in written for text in BLANK_LINE.split(tag))
        return "\n".join(filter(None, (" ".join(text.split()) for text in paragraphs)))


NO_COMMENT = Comment(Place("", 0), [])


class Comments:
    """A reader that finds the comment at a place. When a comment of a file is requested for the
    first time, the reader reads this file."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.files: dict[str, list[Comment]] = {}
        self.lines: dict[str, dict[int, Comment]] = {}

    def of_file(self, file: str) -> list[Comment]:
        if file not in self.files:
            text = (self.root / file).read_text(encoding="utf-8")
            self.files[file] = list(read_comments(file, text))
        return self.files[file]

    def at(self, file: str, line: int) -> Comment:
        """Returns the comment that includes a source line. Returns an empty comment if there is
        none."""
        if not line:
            return NO_COMMENT
        if file not in self.lines:
            self.lines[file] = {
                number: comment
                for comment in self.of_file(file)
                for number in range(comment.place.line, (comment.place.end or 0) + 1)
            }
        return self.lines[file].get(line, NO_COMMENT)

    def below(self, names: Iterable[str]) -> Iterator[Comment]:
        """Yields all comments in the files below the given folders."""
        for path in files_below(self.root, names, SUFFIXES):
            yield from self.of_file(str(path.relative_to(self.root)))


def code_of(text: str) -> str:
    """Returns the code without comments and empty lines."""
    bare = TOKENS.sub(lambda match: " " if match["comment"] else match[0], text)
    return "\n".join(line.rstrip() for line in bare.splitlines() if line.strip())


def comment_blanked(text: str) -> str:
    """Returns the source text without its comments. The line breaks inside the comments remain, so
    the line numbers do not change."""
    return TOKENS.sub(
        lambda match: "\n" * match[0].count("\n") if match["comment"] else match[0], text
    )


def comment_tokens(text: str) -> Iterator[tuple[int, bool, str]]:
    """Yields three results for each ``//`` and ``/* */`` comment: the line number, true if there is
    code before the comment on this line, and the text."""
    line, at = 1, 0
    for token in TOKENS.finditer(text):
        written = token["comment"]
        if written:
            line, at = line + text.count("\n", at, token.start()), token.start()
            before = text[text.rfind("\n", 0, at) + 1 : at]
            yield line, bool(before.strip()), written


def read_comments(file: str, text: str) -> Iterator[Comment]:
    block: list[str] = []
    # first line number of the block; true if the block is after its declaration
    start, behind = 0, False
    for line, after_code, written in comment_tokens(text):
        slashes = SLASHES.fullmatch(written)
        follows = bool(block) and line == start + len(block) and not after_code
        if slashes and follows and bool(slashes[1]) == behind:
            block.append(slashes[2])
            continue
        if block:
            yield _comment(file, start, block)
        block = []
        if slashes:
            start, behind, block = line, bool(slashes[1]), [slashes[2]]
        elif starred := STARRED.fullmatch(written):
            yield _comment(file, line, [STAR.sub("", part) for part in starred[1].split("\n")])
    if block:
        yield _comment(file, start, block)


def _comment(file: str, line: int, lines: list[str]) -> Comment:
    text = "\n".join(lines)
    matches = [match for match in TAG.finditer(text) if match[1]]
    ends = [match.start() for match in matches] + [len(text)]
    tags = [
        _tag(file, line, text, match, end) for match, end in zip(matches, ends[1:], strict=True)
    ]
    if text[: ends[0]].strip():
        first, *more = _paragraphs(text[: ends[0]].strip())
        tags.insert(0, Tag("", [], first, more, Place(file, line), text[: ends[0]]))
    return Comment(Place(file, line, line + len(lines) - 1), tags)


def _tag(file: str, line: int, text: str, match: re.Match[str], end: int) -> Tag:
    name, inside, behind = match[1], match[2], text[match.end() : end]
    arguments: list[str] = []
    if inside is not None:
        count = IN_BRACES.get(name, 1)
        parts = NEXT_ARGUMENT.split(inside, maxsplit=count - 1) if count > 1 else [inside]
        arguments = [plain(part) for part in parts]
    elif name in WORD:
        word, *rest = re.split(r"(?<=\S)(?=\s)", behind.lstrip(" "), maxsplit=1)
        arguments, behind = [word.strip(" ,;")], "".join(rest)
    first, *more = _paragraphs(behind)
    place = Place(file, line + text.count("\n", 0, match.start()))
    return Tag(name, arguments, first, more, place, text[match.start() : end])


def _paragraphs(text: str) -> list[str]:
    """Splits a text into paragraphs at its blank lines. The first paragraph is empty if the text
    begins with a blank line."""
    first, *more = BLANK_LINE.split(text)
    return [plain(first), *filter(None, map(plain, more))]


def plain(text: str) -> str:
    """Returns a text without its line breaks. Only the line breaks before the items of a list
    remain."""
    parts = re.split(r"\n(?=\s*- )", text.replace("\\,", ","))
    return "\n".join(" ".join(part.split()) for part in parts).strip()
