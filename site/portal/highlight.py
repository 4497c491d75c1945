"""Converts source files to HTML lines with syntax highlighting. A file is highlighted again only if
its content has changed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path

import pygments
from pygments import highlight
from pygments.filter import Filter
from pygments.formatters import HtmlFormatter
from pygments.lexer import Lexer
from pygments.lexers import TextLexer, get_lexer_for_filename
from pygments.token import Name, Punctuation, Text, Whitespace, _TokenType
from pygments.util import ClassNotFound

from traceability.reading.result_cache import cached_result


class Plain(Filter):
    """A filter that removes the highlighting of names, punctuation and spaces."""

    def filter(
        self,
        lexer: Lexer | None,  # noqa: ARG002 - Pygments passes it by this name
        stream: Iterable[tuple[_TokenType, str]],
    ) -> Iterator[tuple[_TokenType, str]]:
        for token, value in stream:
            yield Text if token in (Whitespace, Name, Punctuation) else token, value


def lexer_for(path: str) -> Lexer:
    try:
        lexer: Lexer = get_lexer_for_filename(path, stripnl=False)
    except ClassNotFound:
        lexer = TextLexer(stripnl=False)
    lexer.add_filter(Plain())
    return lexer


def highlighted_lines(path: str, text: str) -> list[str]:
    """Returns an HTML fragment for each source line. Each tag is closed in the line in which it is
    opened."""
    return highlight(text, lexer_for(path), HtmlFormatter(nowrap=True)).split("\n")[:-1]


class Highlighter:
    """The highlighted files below the folder ``root``. The result of a file is stored in a cache,
    and computed again only if the content of the file or the version of Pygments has changed."""

    def __init__(self, root: Path, cache: Path) -> None:
        self.root = root
        self.cache = cache
        self.lines_of: dict[str, list[str]] = {}

    def lines(self, path: str) -> list[str]:
        if path not in self.lines_of:
            self.lines_of[path] = self._read(path)
        return self.lines_of[path]

    def _read(self, path: str) -> list[str]:
        source = self.root / path
        if not source.is_file():
            return []
        text = source.read_text(encoding="utf-8", errors="replace")
        parts = [pygments.__version__, text]
        return cached_result(
            self.cache / f"{path}.pickle", parts, partial(highlighted_lines, path, text)
        )
