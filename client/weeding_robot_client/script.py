"""Scripts, which are files with orders and their times."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from weeding_robot_client.messages import (
    WHEELS,
    MessageError,
    Order,
    Quantity,
    WheelSetPoint,
)

ACKNOWLEDGE_S = 0.3  # three control cycles, so that the robot reads the order at least once
NEUTRAL_S = 0.5  # time with neutral orders that arms the robot
HELP = f"""\
A script has one line for each change. The times of the lines must not decrease:

  # comment
  at 0s velocity 0 rpm
  at 1.5s velocity 150 rpm steering 10 deg
  at 3s tension 12 V
  at 4s current -2.5 A steering -5 deg
  at 5s wheel 0 tension 1 V
  at 6s stop
  at 7s release
  at 8s acknowledge
  at 9s end

The time starts when the robot is armed. `velocity`, `tension` and `current` apply to all four
wheels. After 'wheel N', they apply only to wheel N: 0 front left, 1 front right, 2 rear left,
3 rear right. `tension` is the voltage of the motor. `velocity` is the velocity of the motor shaft.
Steering is positive to the left. A line changes only the values that it contains. 'stop' orders a
stop until 'release', also after the end of the script. 'acknowledge' releases a protective stop.
'release' and 'acknowledge' set all wheels to 0. To arm the robot again, keep all wheels at 0 for
{NEUTRAL_S} s. The last line is 'end'."""

WORDS = re.compile(
    r"\s*(?:(stop|release|acknowledge|end)\b|(?:wheel\s+(\S+)\s+)?(\w+)\s+(\S+)\s+(\w+))\s*"
)
UNITS = {"velocity": "rpm", "tension": "V", "current": "A", "steering": "deg"}

Points = tuple[WheelSetPoint, WheelSetPoint, WheelSetPoint, WheelSetPoint]
STILL: Points = (WheelSetPoint(Quantity.VELOCITY, 0.0),) * 4


class ScriptError(ValueError):
    """A line of a script has an error."""


@dataclass(frozen=True)
class Wish:
    """The values of the next order."""

    wheels: Points = STILL
    steering_degrees: float = 0.0
    stop: bool = False
    acknowledge: bool = False

    @classmethod
    def of(
        cls,
        quantity: Quantity,
        value: float,
        steering_degrees: float = 0.0,
        wheels: Iterable[int] | None = None,
    ) -> Wish:
        """Returns an order with a value for some wheels or for all wheels.

        The other wheels have velocity 0.
        """
        chosen = range(len(WHEELS)) if wheels is None else wheels
        wish = cls(steering_degrees=steering_degrees)
        for wheel in chosen:
            wish = wish.with_wheel(wheel, WheelSetPoint(quantity, value))
        return wish

    def with_wheel(self, wheel: int, point: WheelSetPoint) -> Wish:
        points = list(self.wheels)
        points[wheel] = point
        front_left, front_right, rear_left, rear_right = points
        return replace(self, wheels=(front_left, front_right, rear_left, rear_right))

    def neutral(self) -> Wish:
        """Returns these values with all wheels at 0 and without an acknowledgement."""
        return replace(self, wheels=STILL, acknowledge=False)

    def order(self, order_id: int) -> Order:
        return Order(order_id, self.steering_degrees, self.wheels, self.stop, self.acknowledge)


@dataclass(frozen=True)
class Script:
    """Orders, each with the time at which it begins to apply [s]. The script ends at ``end_s``."""

    wishes: tuple[tuple[float, Wish], ...]
    end_s: float

    def at(self, seconds: float) -> Wish | None:
        """Returns the order that is in force at a time.

        Returns None before the first line of the script.
        """
        earlier = [(start, wish) for start, wish in self.wishes if start <= seconds]
        if not earlier:
            return None
        start, wish = earlier[-1]
        return wish if seconds - start < ACKNOWLEDGE_S else replace(wish, acknowledge=False)


def load(path: Path) -> Script:
    """Returns the script in a file. Raises OSError if the file cannot be read."""
    try:
        return parse(path.read_text(encoding="utf-8"), str(path))
    except UnicodeDecodeError as error:
        raise ScriptError(f"{path}: the file is not UTF-8 text; save it as UTF-8") from error


def parse(text: str, name: str = "script") -> Script:
    wishes: list[tuple[float, Wish]] = []
    wish = Wish()
    time_s = 0.0
    ended = False
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.split("#", 1)[0].strip()
        if not content:
            continue
        try:
            if ended:
                raise ScriptError("nothing may follow 'end'")
            start, rest = _time(content)
            if start < time_s:
                raise ScriptError(f"{start:g} s is before the time of the previous line")
            time_s = start
            wish, ended = _change(wish, rest)
            wish.order(0)
        except (ScriptError, MessageError) as error:
            raise ScriptError(f"{name}:{number}: {error}") from error
        if not ended:
            wishes.append((start, wish))
    if not ended:
        raise ScriptError(f"{name}: the last line must be 'at TIME end'")
    return Script(tuple(wishes), time_s)


def _time(content: str) -> tuple[float, str]:
    match = re.match(r"at\s+(\d+(?:\.\d+)?)\s*s\s+", content + " ")
    if not match:
        raise ScriptError("a line begins with a time, such as 'at 1.5s'")
    return float(match[1]), content[match.end() :] if match.end() <= len(content) else ""


def _change(wish: Wish, rest: str) -> tuple[Wish, bool]:
    """Applies the words of one line. Returns the new order, and whether the script has ended."""
    if not rest:
        raise ScriptError("there are no values after the time")
    wish = replace(wish, acknowledge=False)
    position = 0
    while position < len(rest):
        match = WORDS.match(rest, position)
        if not match:
            raise ScriptError(f"'{rest[position:]}' is not valid here")
        position = match.end()
        if match[1] == "end":
            if position < len(rest) or match.start() > 0:
                raise ScriptError("'end' must be alone after its time")
            return wish, True
        wish = _command(wish, match[1]) if match[1] else _set(wish, match)
    return wish, False


def _command(wish: Wish, word: str) -> Wish:
    if word == "stop":
        return replace(wish, stop=True)
    if word == "release":
        return replace(wish.neutral(), stop=False)
    return replace(wish.neutral(), acknowledge=True)


def _set(wish: Wish, match: re.Match[str]) -> Wish:
    wheel, name, number, unit = match[2], match[3], match[4], match[5]
    if name not in UNITS:
        raise ScriptError(f"unknown word '{name}'")
    if unit != UNITS[name]:
        raise ScriptError(f"the unit of {name} is {UNITS[name]}, not {unit}")
    try:
        value = float(number)
    except ValueError as error:
        raise ScriptError(f"'{number}' is not a number") from error
    if name == "steering":
        if wheel is not None:
            raise ScriptError("steering cannot be ordered for a single wheel")
        return replace(wish, steering_degrees=value)
    point = WheelSetPoint(Quantity[name.upper()], value)
    for chosen in range(len(WHEELS)) if wheel is None else (wheel_number(wheel),):
        wish = wish.with_wheel(chosen, point)
    return wish


def wheel_number(text: str) -> int:
    """Returns the number of a wheel, 0 to 3. Raises ScriptError for another text."""
    if text not in map(str, range(len(WHEELS))):
        raise ScriptError(f"'{text}' is not a wheel from 0 to {len(WHEELS) - 1}")
    return int(text)
