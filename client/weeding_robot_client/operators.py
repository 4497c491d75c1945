"""The operator of a bring-up: a person at a terminal, or the simulated operator."""

from __future__ import annotations

import os
import select
import socket
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

SKIP = "s"
REACTION_S = 0.5  # longest time until a person begins an announced action
REPLY_WITHIN_S = 2.0
REPLY_BYTES = 4096

Idle = Callable[[], None]


class OperatorError(RuntimeError):
    """The operator cannot execute an action."""


class Operator(Protocol):
    """An operator for manual actions. ``idle`` is called while the program waits for the
    operator."""

    reaction_s: float  # longest time from the announcement of an action to its start
    patience_s: float  # longest time from an action to its effect

    def perform(self, action: str, instruction: str, idle: Idle) -> None:
        """Asks for an action. Returns when the operator begins the action."""

    def skips(self) -> bool:
        """Returns whether the operator wants to skip the present step."""

    def confirm(self, question: str, idle: Idle) -> bool:
        """Asks a question. Returns true for yes."""

    def sees_forward(self, wheel: int, name: str, idle: Idle) -> bool | None:
        """Asks how a wheel turned. Returns true for forwards, false for backwards, None for no
        motion.
        """

    def number(self, question: str, idle: Idle) -> float | None:
        """Asks for a measured number. Returns None when the number was not measured."""


class Person:
    """A person at the terminal. Every question needs an answer. No question has a default."""

    reaction_s = REACTION_S
    patience_s = 60.0

    def __init__(self) -> None:
        self._pending = b""
        self._skips = False

    def perform(self, action: str, instruction: str, idle: Idle) -> None:
        del action
        text = f"   do: {instruction}\n   Enter when you begin, s and Enter to skip: "
        self._skips = self._ask(text, idle).lower() == SKIP

    def skips(self) -> bool:
        line = self._line(0.0)
        skips, self._skips = self._skips, False
        return skips or (line is not None and line.strip().lower() == SKIP)

    def confirm(self, question: str, idle: Idle) -> bool:
        while True:
            answer = self._ask(f"   {question} [yes/no]: ", idle).lower()
            if answer in ("y", "yes", "n", "no"):
                return answer.startswith("y")

    def sees_forward(self, wheel: int, name: str, idle: Idle) -> bool | None:
        del wheel
        answers = {"f": True, "b": False, "n": None}
        question = f"   How did the {name} wheel turn? f forwards, b backwards, n not at all: "
        while (answer := self._ask(question, idle).lower()) not in answers:
            pass
        return answers[answer]

    def number(self, question: str, idle: Idle) -> float | None:
        while True:
            answer = self._ask(f"   {question} (Enter: not measured): ", idle)
            if not answer:
                return None
            try:
                return float(answer)
            except ValueError:
                print(f"   '{answer}' is not a number")

    def _ask(self, text: str, idle: Idle) -> str:
        print(text, end="", flush=True)
        while (line := self._line(0.0)) is None:
            idle()
        return line.strip()

    def _line(self, timeout_s: float) -> str | None:
        keyboard = sys.stdin.fileno()
        if b"\n" not in self._pending and select.select([keyboard], [], [], timeout_s)[0]:
            data = os.read(keyboard, 1024)
            if not data:
                raise OperatorError("the terminal is gone")
            self._pending += data
        line, newline, rest = self._pending.partition(b"\n")
        if not newline:
            return None
        self._pending = rest
        return line.decode("utf-8", "replace")


class Control:
    """The control socket of the simulator. Each message is an action of a scenario."""

    def __init__(self, path: Path) -> None:
        self._folder = tempfile.TemporaryDirectory()
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(str(Path(self._folder.name) / "operator"))
        self._socket.settimeout(REPLY_WITHIN_S)
        try:
            self._socket.connect(str(path))
        except OSError as error:
            self.close()
            raise OperatorError(
                f"no simulator listens at {path}. Start it in another terminal: ./wr sim"
            ) from error

    def close(self) -> None:
        self._socket.close()
        self._folder.cleanup()

    def do(self, action: str) -> None:
        """Executes an action of a scenario. Raises OperatorError when the simulator rejects the
        action."""
        reply = self._request(action)
        if reply != "ok":
            raise OperatorError(f"the simulator rejected '{action}': {reply}")

    def holds(self, expectation: str) -> bool:
        """Returns whether an expectation about the simulated robot is met."""
        return self._request(f"expect {expectation}") == "ok"

    def _request(self, words: str) -> str:
        try:
            self._socket.send(words.encode())
            return self._socket.recv(REPLY_BYTES).decode().strip()
        except OSError as error:
            raise OperatorError(f"the simulator does not answer '{words}'") from error


# Actions of the bring-up. Each has the scenario actions that simulate this action.
ACTIONS = {
    "left end press": ("fault left-end",),
    "left end release": ("repair left-end",),
    "right end press": ("fault right-end",),
    "right end release": ("repair right-end",),
    "enable stop": ("rc velocity 0 steering 0", "rc enable stop"),
    "enable pc": ("rc enable pc",),
    "enable drive": ("rc enable drive",),
    "transmitter off": ("rc off",),
    "transmitter on": ("rc velocity 0 steering 0", "rc enable pc"),
    "estop press": ("estop press",),
    "estop release": ("estop release",),
    "lift": ("estop press", "grip 0"),
}
TURNS_LEAST = 5  # smallest velocity of a wheel that turns [0.1 rpm]
TURNS_MOST = 100_000


class SimulatedOperator:
    """A simulated operator for the simulated robot."""

    reaction_s = 0.0
    patience_s = 5.0

    def __init__(self, control: Control, supply_volts: float = 24.0) -> None:
        self._control = control
        self._supply_volts = supply_volts
        self._forward: dict[int, bool | None] = {}

    def perform(self, action: str, instruction: str, idle: Idle) -> None:
        del idle
        print(f"   simulated operator: {instruction}")
        for words in ACTIONS.get(action, ()):
            self._control.do(words)

    def skips(self) -> bool:
        return False

    def confirm(self, question: str, idle: Idle) -> bool:
        del idle
        print(f"   {question} [yes/no]: yes (simulated operator)")
        return True

    def watch(self, wheel: int) -> None:
        """Stores the present direction of rotation of a wheel."""
        field = f"true_velocity{wheel} between"
        self._forward[wheel] = None
        if self._control.holds(f"{field} {TURNS_LEAST} {TURNS_MOST}"):
            self._forward[wheel] = True
        elif self._control.holds(f"{field} {-TURNS_MOST} {-TURNS_LEAST}"):
            self._forward[wheel] = False

    def sees_forward(self, wheel: int, name: str, idle: Idle) -> bool | None:
        del name, idle
        return self._forward.get(wheel)

    def number(self, question: str, idle: Idle) -> float | None:
        del idle
        print(f"   {question}: {self._supply_volts} (simulated operator)")
        return self._supply_volts
