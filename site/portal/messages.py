"""Collects the messages of the commands from the source code, with the source line of each."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from traceability.sources import files_below
from weeding_robot_client import exit_codes

FOLDERS = ("tools", "client/weeding_robot_client")
# The tables in reasons.py contain messages that the client shows for a report.
REASONS = Path("client/weeding_robot_client/reasons.py")
VALUE = "…"  # placeholder for a value that the command inserts
WORDS = 3  # minimum number of words; a shorter text is not listed as a message
# Class of an exception -> exit code of the command that raises it.
CODES = {
    "FailureError": exit_codes.FAILED,
    "FailError": exit_codes.FAILED,
    "OperatorError": exit_codes.FAILED,
    "MissingError": exit_codes.MISSING,
    "BusyError": exit_codes.BUSY,
    "KeyFileError": exit_codes.USAGE,
    "ScriptError": exit_codes.USAGE,
    "UsageError": exit_codes.USAGE,
    "error": exit_codes.USAGE,  # the method error() of an argument parser
}


@dataclass(frozen=True)
class Message:
    """A message of a command: its text, its exit code, and the source line that contains it."""

    text: str
    code: int | None  # None: the command continues
    file: str
    line: int

    @property
    def anchor(self) -> str:
        return re.sub(r"[^a-z0-9]+", "-", self.text.lower()).strip("-")[:60].rstrip("-")


def messages(root: Path) -> list[Message]:
    """Returns each message once, in the order of the files."""
    found: dict[str, Message] = {}
    for path in files_below(root, FOLDERS, (".py",)):
        for message in messages_of(root, path):
            found.setdefault(message.anchor, message)
    return list(found.values())


def messages_of(root: Path, path: Path) -> Iterator[Message]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    file = path.relative_to(root)
    texts = {
        name.id: text_of(node.value, {})
        for node in tree.body
        if isinstance(node, ast.Assign)
        for name in node.targets
        if isinstance(name, ast.Name)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and (name := called(node)) in CODES:
            parts = [text_of(argument, texts) for argument in node.args]
            text = " ".join(". ".join(part for part in parts if part not in ("", VALUE)).split())
            if worded(text):
                yield Message(text, CODES[name], str(file), node.lineno)
        elif isinstance(node, ast.Dict) and file == REASONS:
            for value in node.values:
                if worded(text := text_of(value, texts)):
                    yield Message(text, None, str(file), value.lineno)


def worded(text: str) -> bool:
    return sum(VALUE not in word for word in text.split()) >= WORDS


def called(call: ast.Call) -> str:
    match call.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
    return ""


def text_of(node: ast.expr, texts: dict[str, str]) -> str:
    """Returns the text of an expression. The placeholder VALUE replaces each part that is known
    only when the command runs.
    """
    match node:
        case ast.Constant(value=str(text)):
            return text
        case ast.Name(id=name):
            return texts.get(name, VALUE)
        case ast.FormattedValue(value=value):
            return text_of(value, texts)
        case ast.JoinedStr(values=values):
            return "".join(text_of(value, texts) for value in values)
        case ast.BinOp(left=left, right=right):
            return text_of(left, texts) + text_of(right, texts)
    return VALUE
