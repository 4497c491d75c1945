"""The keys of a terminal, and the motions that they order.

A motion lasts only while the terminal repeats its key.
"""

from __future__ import annotations

import os
import select
import termios
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from weeding_robot_client.messages import Order, Quantity
from weeding_robot_client.script import ACKNOWLEDGE_S, Wish

DEAD_MAN_S = 0.3
SPEED_STEP_RPM = 10.0
SPEED_RPM = 50.0
STEERING_STEP_DEGREES = 1.0
FORWARD, BACKWARD, LEFT, RIGHT = b"w", b"s", b"j", b"l"
ESCAPES = {b"\x1b[A": FORWARD, b"\x1b[B": BACKWARD, b"\x1b[C": RIGHT, b"\x1b[D": LEFT}
ESCAPES |= {b"\x1bO" + code[-1:]: key for code, key in ESCAPES.items()}
# The keys, each with its effect. A name in braces is a constant of this file.
KEYS = {
    "up, w": "while pressed: drive forwards",
    "down, s": "while pressed: drive backwards",
    "left, j": "turn the steering by {STEERING_STEP_DEGREES} to the left",
    "right, l": "turn the steering by {STEERING_STEP_DEGREES} to the right",
    "+": "{SPEED_STEP_RPM} faster, at the motor shaft; {SPEED_RPM} at first",
    "-": "{SPEED_STEP_RPM} slower",
    "0": "turn the steering to 0",
    "space": "stop: halts the wheels and keeps the steering angle, in every mode",
    "r": "release the stop",
    "a": "acknowledge a protective stop, and arm",
    "q": "quit: orders velocity 0; a stop that is in force stays in force",
}
VALUES = {
    "STEERING_STEP_DEGREES": f"{STEERING_STEP_DEGREES:g} degree",
    "SPEED_STEP_RPM": f"{SPEED_STEP_RPM:g} rpm",
    "SPEED_RPM": f"{SPEED_RPM:g} rpm",
}
HELP = "\n".join(
    [
        "Keys (keep a motion key pressed: "
        f"all wheels go to 0 after {DEAD_MAN_S} s without a motion key):",
        *(f"  {key:10}{effect.format(**VALUES)}" for key, effect in KEYS.items()),
    ]
)


@contextmanager
def raw_keys(keyboard: int) -> Iterator[None]:
    """Delivers each key immediately and without echo. Ctrl-C still interrupts the program."""
    before = termios.tcgetattr(keyboard)
    try:
        tty.setcbreak(keyboard)
        yield
    finally:
        termios.tcsetattr(keyboard, termios.TCSADRAIN, before)


def read_keys(keyboard: int) -> list[bytes] | None:
    """Returns the keys that were pressed. Returns None when the terminal is closed."""
    if not select.select([keyboard], [], [], 0)[0]:
        return []
    try:
        data = os.read(keyboard, 256)
    except OSError:
        return None
    return list(keys(data)) if data else None


def keys(data: bytes) -> Iterator[bytes]:
    """Splits bytes into keys. Arrow keys become letters."""
    while data:
        if data[:3] in ESCAPES:
            yield ESCAPES[data[:3]]
            data = data[3:]
        else:
            yield data[:1].lower()
            data = data[1:]


@dataclass
class Hand:
    """State of the keys, which determines the order at a given time."""

    wheels: tuple[int, ...] | None = None  # None: all wheels
    speed_rpm: float = SPEED_RPM
    steering_degrees: float = 0.0
    stop: bool = False
    _direction: int = 0
    _moved_at: float = float("-inf")
    _acknowledged_at: float = float("-inf")

    def press(self, key: bytes, now: float) -> None:
        """Processes a key. A key without a meaning has no effect."""
        if key in (FORWARD, BACKWARD):
            self._direction = 1 if key == FORWARD else -1
            self._moved_at = now
        elif key in (LEFT, RIGHT):
            step = STEERING_STEP_DEGREES if key == LEFT else -STEERING_STEP_DEGREES
            limit = Order.steering_limit_degrees
            self.steering_degrees = min(limit, max(-limit, self.steering_degrees + step))
            if self._moves(now):  # a terminal repeats only the newest key
                self._moved_at = now
        else:
            self._command(key, now)

    def _command(self, key: bytes, now: float) -> None:
        if key in (b"+", b"-"):
            step = SPEED_STEP_RPM if key == b"+" else -SPEED_STEP_RPM
            limit = Quantity.VELOCITY.limit
            self.speed_rpm = min(limit, max(SPEED_STEP_RPM, self.speed_rpm + step))
        elif key == b"0":
            self.steering_degrees = 0.0
        elif key == b" ":
            self.stop = True
            self._moved_at = float("-inf")
        elif key == b"r":
            self.stop = False
            self._moved_at = float("-inf")
        elif key == b"a":
            self._acknowledged_at = now
            self._moved_at = float("-inf")

    def wish(self, now: float) -> Wish:
        """Returns the present order. The order is neutral if no motion key was repeated
        recently.
        """
        acknowledges = now - self._acknowledged_at < ACKNOWLEDGE_S
        moves = self._moves(now) and not self.stop and not acknowledges
        velocity = self._direction * self.speed_rpm if moves else 0.0
        wish = Wish.of(Quantity.VELOCITY, velocity, self.steering_degrees, self.wheels)
        return Wish(wish.wheels, wish.steering_degrees, self.stop, acknowledges)

    def _moves(self, now: float) -> bool:
        return now - self._moved_at < DEAD_MAN_S
