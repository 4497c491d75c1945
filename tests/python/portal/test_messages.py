"""The messages of the commands, as the portal reads them from the code."""

from __future__ import annotations

from pathlib import Path

import pytest

from portal.messages import Message, messages

pytestmark = pytest.mark.reads("client", "tools", "wr")

CODE = """
ADVICE = "Connect the board, and try again."


def check(port: int, parser: Parser) -> None:
    if not port:
        parser.error("name a port with --port")
    raise MissingError(f"port {port} has no board. {ADVICE}")


def other() -> None:
    raise FailError("no report came", "Check cable and power.")
    raise FailError(port, "Choose another port.")
    raise FailureError(f"{port}: {port}")
"""


def texts_of(folder: Path, code: str, name: str = "tools/flash.py") -> list[Message]:
    path = folder / name
    path.parent.mkdir(parents=True)
    path.write_text(code, encoding="utf-8")
    return messages(folder)


def test_a_message_has_its_text_its_exit_code_and_its_line(tmp_path: Path) -> None:
    found = {message.text: message for message in texts_of(tmp_path, CODE)}
    assert found["name a port with --port"].code == 2
    missing = found["port … has no board. Connect the board, and try again."]
    assert (missing.code, missing.file, missing.line) == (3, "tools/flash.py", 8)
    assert found["no report came. Check cable and power."].code == 1
    assert "Choose another port." in found


def test_a_message_of_values_alone_is_no_entry(tmp_path: Path) -> None:
    assert len(texts_of(tmp_path, CODE)) == 4


def test_the_reasons_in_reports_are_messages(tmp_path: Path) -> None:
    code = 'ACTIONS = {"no order": "Send orders: ./wr drive."}'
    (message,) = texts_of(tmp_path, code, "client/weeding_robot_client/reasons.py")
    assert (message.text, message.code) == ("Send orders: ./wr drive.", None)


CLIENT = """
def open_link(path: Path) -> int:
    try:
        return Link(path)
    except BusyError:
        print(f"{path} is in use.", file=sys.stderr)
        print("End that program, and try again.", file=sys.stderr)
        return BUSY


def watch(self) -> None:
    print(f"\\r\\x1b[Kno connection on {self.path}, trying", end="")
    print("not a message")
    return later
"""
ORDERS = """
def arm(reason: str) -> str:
    return reason or "The robot reads no order of the PC."
"""
SHELL = """
give_up "$root cannot be written" \\
    "Copy the project to a folder that you may write."
echo "wr: there is no command '$1'" >&2
usage >&2
exit 2
"""


def test_printed_and_returned_messages_of_the_client(tmp_path: Path) -> None:
    found = texts_of(tmp_path, CLIENT, "client/weeding_robot_client/options.py")
    assert [(message.text, message.code, message.line) for message in found] == [
        ("no connection on …, trying", None, 12),
        ("… is in use. End that program, and try again.", 5, 6),
    ]
    (message,) = texts_of(tmp_path / "more", ORDERS, "client/weeding_robot_client/orders.py")
    assert message.text == "The robot reads no order of the PC."


def test_messages_of_the_shell_script(tmp_path: Path) -> None:
    (tmp_path / "wr").write_text(SHELL, encoding="utf-8")
    assert [(message.text, message.code) for message in messages(tmp_path)] == [
        ("… cannot be written. Copy the project to a folder that you may write.", 3),
        ("there is no command '…'", 2),
    ]


def test_each_message_of_the_project_has_one_anchor() -> None:
    found = messages(Path(__file__).parents[3])
    assert len(found) > 100
    assert len({message.anchor for message in found}) == len(found)
