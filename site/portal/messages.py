"""Collects the messages of the commands from the source code, with the source line of each."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from traceability.sources import files_below
from weeding_robot_client import exit_codes

CLIENT = "client/weeding_robot_client"
FOLDERS = ("tools", CLIENT)
# The tables and lists in reasons.py contain messages that the client shows for a report.
REASONS = Path("client/weeding_robot_client/reasons.py")
# Functions of these files return messages.
RETURNING = {
    Path("client/weeding_robot_client/drive.py"),
    Path("client/weeding_robot_client/messages.py"),
    Path("client/weeding_robot_client/orders.py"),
    Path("tools/usb_drive.py"),
}
# The client never shows the text of this exception: options.py prints another message.
REPLACED = (Path("client/weeding_robot_client/link.py"), "BusyError")
COMMAND = Path("wr")  # the shell script; its function give_up prints a problem and the next action
GIVES_UP = re.compile(r'give_up "([^"]*)"\s*\\?\s*"([^"]*)"')
ENDS = re.compile(r'echo "wr: ([^"]*)" >&2(?:(?!\bexit ).)*?\bexit (\d)', re.DOTALL)
SHELL_VALUE = re.compile(r"\$\w+|\$\([^)]*\)")
LINE_BEGIN = "\r\x1b[K"  # clears the line of the terminal
VALUE = "…"  # placeholder for a value that the command inserts
WORDS = 2  # minimum number of words; a shorter text is not listed as a message
VALUES = 5  # greatest number of values; a text with more values shows the state of the robot
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


def codes_by_name() -> dict[str, int]:
    """Returns the exit codes of ./wr by their names."""
    return {name: code for name, code in vars(exit_codes).items() if name.isupper()}


@dataclass(frozen=True)
class Message:
    """A message of a command: its text, its exit code, and the source line that contains it."""

    text: str
    code: int | None  # None: the command continues, or another function determines the exit code
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
    for message in messages_of_command(root):
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
        if file.is_relative_to(CLIENT):
            yield from printed(node, texts, file)
        if isinstance(node, ast.Call) and (name := called(node)) in CODES:
            if (file, name) == REPLACED:
                continue
            parts = [text_of(argument, texts) for argument in node.args]
            text = " ".join(". ".join(part for part in parts if part not in ("", VALUE)).split())
            if worded(text):
                yield Message(text, CODES[name], str(file), node.lineno)
        elif isinstance(node, ast.Dict | ast.List) and file == REASONS:
            for value in node.values if isinstance(node, ast.Dict) else node.elts:
                if worded(text := text_of(value, texts)):
                    yield Message(text, None, str(file), value.lineno)
        elif isinstance(node, ast.Return) and node.value and file in RETURNING:
            either = node.value.values if isinstance(node.value, ast.BoolOp) else [node.value]
            for value in either:
                text = " ".join(text_of(value, texts).replace(VALUE + " A ", "A ").split())
                if worded(text):
                    yield Message(text, None, str(file), node.lineno)


def printed(node: ast.AST, texts: dict[str, str], file: Path) -> Iterator[Message]:
    """Yields the messages that a block prints. Successive calls of print are one message. If the
    next statement returns an exit code, this code is the exit code of the message."""
    for name in ("body", "orelse", "finalbody"):
        block = getattr(node, name, None)
        if not isinstance(block, list):
            continue
        parts: list[str] = []
        line = 0
        for statement in [*block, None]:
            part = printed_text(statement, texts)
            if statement and part:
                line = line or statement.lineno
                parts.append(part)
                continue
            if worded(text := " ".join(" ".join(parts).split())):
                yield Message(text, returned_code(statement), str(file), line)
            parts, line = [], 0


def printed_text(statement: ast.stmt | None, texts: dict[str, str]) -> str:
    """Returns the text that a statement prints, if it prints to the standard error or to the status
    line of the terminal. Otherwise, the result is empty."""
    match statement:
        case ast.Expr(
            value=ast.Call(func=ast.Name(id="print"), args=[argument], keywords=keywords)
        ):
            text = text_of(argument, texts)
            if any(keyword.arg == "file" for keyword in keywords) or text.startswith(LINE_BEGIN):
                return text.removeprefix(LINE_BEGIN)
    return ""


def returned_code(statement: ast.stmt | None) -> int | None:
    match statement:
        case ast.Return(value=ast.Name(id=name)):
            code = getattr(exit_codes, name, None)
            return code if isinstance(code, int) else None
    return None


def messages_of_command(root: Path) -> Iterator[Message]:
    """Yields the messages of the shell script. After each of these messages, the command ends."""
    if not (root / COMMAND).exists():
        return
    script = (root / COMMAND).read_text(encoding="utf-8")
    for pattern in (GIVES_UP, ENDS):
        for match in pattern.finditer(script):
            first, second = match.groups()
            text, code = (first, int(second)) if second.isdigit() else (f"{first}. {second}", 3)
            text = SHELL_VALUE.sub(VALUE, text)
            if worded(text):
                line = script.count("\n", 0, match.start()) + 1
                yield Message(text, code, str(COMMAND), line)


def worded(text: str) -> bool:
    return sum(VALUE not in word for word in text.split()) >= WORDS and text.count(VALUE) <= VALUES


def called(call: ast.Call) -> str:
    match call.func:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
    return ""


def text_of(node: ast.expr, texts: dict[str, str]) -> str:
    """Returns the text of an expression. The placeholder VALUE replaces each part that is known
    only when the command runs."""
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
