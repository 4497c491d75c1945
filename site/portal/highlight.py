"""Source files as highlighted lines, kept between runs by their content."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from html import escape
from pathlib import Path

from pygments.lexer import Lexer
from pygments.lexers import get_lexer_by_name
from pygments.token import STANDARD_TYPES, _TokenType

PLAIN = {"", "w", "n", "p"}  # names, punctuation and space keep the colour of the text
CLASSES = dict(STANDARD_TYPES.items())
LEXERS = {
    ".hpp": "cpp",
    ".cpp": "cpp",
    ".h": "cpp",
    ".c": "c",
    ".py": "python",
    ".toml": "toml",
    ".txt": "text",
    ".json": "json",
    ".dox": "text",
    ".tree": "text",
    ".S": "gas",
    ".ld": "text",
}


def css_class(token: _TokenType) -> str | None:
    """The short class of a token; a token without one takes its parent's."""
    short = CLASSES.get(token)
    return short if short is not None or token.parent is None else css_class(token.parent)


def lexer_for(path: str) -> Lexer:
    name = "cmake" if path.endswith("CMakeLists.txt") else LEXERS.get(Path(path).suffix, "text")
    return get_lexer_by_name(name, stripnl=False, ensurenl=True)


def coloured_pieces(path: str, text: str) -> Iterator[tuple[str | None, str]]:
    for token, value in lexer_for(path).get_tokens(text):
        name = css_class(token)
        yield None if name in PLAIN else name, value


def highlighted_lines(path: str, text: str) -> list[str]:
    """One HTML fragment for each line; tags never cross the end of a line."""
    lines = [""]
    for name, value in coloured_pieces(path, text):
        for number, part in enumerate(value.split("\n")):
            if number:
                lines.append("")
            if part:
                safe = escape(part, quote=False)
                lines[-1] += f'<span class="{name}">{safe}</span>' if name else safe
    return lines[:-1] if lines[-1] == "" else lines


class Highlighter:
    """Highlights files below a root; the result of a file is cached by its content."""

    def __init__(self, root: Path, cache: Path) -> None:
        self.root = root
        self.cache = cache
        self.lines_of: dict[str, list[str]] = {}
        cache.mkdir(parents=True, exist_ok=True)

    def lines(self, path: str) -> list[str]:
        if path not in self.lines_of:
            self.lines_of[path] = self._read(path)
        return self.lines_of[path]

    def _read(self, path: str) -> list[str]:
        source = self.root / path
        if not source.is_file():
            return []
        text = source.read_text(encoding="utf-8", errors="replace")
        digest = hashlib.sha256(f"{Path(path).suffix}\0{text}".encode()).hexdigest()
        stored = self.cache / f"{digest}.json"
        if stored.exists():
            loaded: list[str] = json.loads(stored.read_text(encoding="utf-8"))
            return loaded
        lines = highlighted_lines(path, text)
        written = stored.with_suffix(f".{os.getpid()}")  # another process may read it meanwhile
        written.write_text(json.dumps(lines), encoding="utf-8")
        written.replace(stored)
        return lines
