"""Files that say what to order when."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

from weeding_robot_client.messages import MessageError, Order, Quantity, all_wheels

HELP = """\
A script has one line for each change, with times that do not fall:

  # comment
  at 0s velocity 0 rpm
  at 1.5s velocity 150 rpm steering 10 deg
  at 3s tension 12 V
  at 4s current -2.5 A steering -5 deg
  at 5s stop
  at 6s release
  at 7s end

Time starts when the connection stands. 'velocity', 'tension' and 'current' go to all four wheels;
velocity is that of the motor shaft. Steering is positive to the left. What a line does not name
stays as it was. 'stop' halts the wheels, also after the script's end, until 'release'.
The last line is 'end'."""

WORDS = re.compile(r"\s*(?:(stop|release|end)|(\w+)\s+(\S+)\s+(\w+))\s*")
UNITS = {"velocity": "rpm", "tension": "V", "current": "A", "steering": "deg"}


class ScriptError(ValueError):
    """A line of a script that cannot be understood."""


@dataclass(frozen=True)
class Wish:
    """What to order now."""

    quantity: Quantity = Quantity.VELOCITY
    value: float = 0.0
    steering_degrees: float = 0.0
    stop: bool = False

    def order(self, order_id: int) -> Order:
        front_left, front_right, rear_left, rear_right = all_wheels(self.quantity, self.value)
        return Order(
            order_id,
            self.steering_degrees,
            (front_left, front_right, rear_left, rear_right),
            self.stop,
        )


@dataclass(frozen=True)
class Script:
    """Wishes with the time in seconds from which each holds; the last time ends the script."""

    wishes: tuple[tuple[float, Wish], ...]
    end_s: float

    def at(self, seconds: float) -> Wish | None:
        """The wish at a time: None before the first."""
        held = [wish for start, wish in self.wishes if start <= seconds]
        return held[-1] if held else None


def load(path: Path) -> Script:
    return parse(path.read_text(), str(path))


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
                raise ScriptError(f"{start:g} s is before the line above it")
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
    """The wish after the words of one line, and whether they end the script."""
    if not rest:
        raise ScriptError("nothing follows the time")
    position = 0
    while position < len(rest):
        match = WORDS.match(rest, position)
        if not match:
            raise ScriptError(f"cannot understand '{rest[position:]}'")
        position = match.end()
        if match[1] == "end":
            if position < len(rest) or match.start() > 0:
                raise ScriptError("'end' stands alone after its time")
            return wish, True
        wish = replace(wish, stop=match[1] == "stop") if match[1] else _set(wish, match)
    return wish, False


def _set(wish: Wish, match: re.Match[str]) -> Wish:
    what, number, unit = match[2], match[3], match[4]
    if what not in UNITS:
        raise ScriptError(f"unknown word '{what}'")
    if unit != UNITS[what]:
        raise ScriptError(f"{what} is given in {UNITS[what]}, not in {unit}")
    try:
        value = float(number)
    except ValueError as error:
        raise ScriptError(f"'{number}' is not a number") from error
    if what == "steering":
        return replace(wish, steering_degrees=value)
    return replace(wish, quantity=Quantity[what.upper()], value=value)
