"""Finds the numbers with a unit in requirements, and compares these numbers with the constants of
the code."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from traceability.reading.ast_facts import ConstantFact
from traceability.schema import Constant

_ELEVEN = "two three four five six seven eight nine ten eleven twelve"
_THIRD = "third fourth fifth sixth seventh eighth ninth tenth"
WORDS = {word: number for number, word in enumerate(_ELEVEN.split(" "), 2)}
_ORDINALS = {word: number for number, word in enumerate(_THIRD.split(" "), 3)}
_IN_WORDS = WORDS | _ORDINALS
# Unit -> the kind of its quantity, and the factor that converts a value to the smallest unit of
# this kind.
UNITS = {
    "us": ("time", Fraction(1)),
    "ms": ("time", Fraction(1000)),
    "s": ("time", Fraction(1_000_000)),
    "mV": ("voltage", Fraction(1)),
    "V": ("voltage", Fraction(1000)),
    "mA": ("current", Fraction(1)),
    "A": ("current", Fraction(1000)),
    "rpm": ("velocity", Fraction(10)),
    "0.1 rpm": ("velocity", Fraction(1)),
    "degree": ("angle", Fraction(100)),
    "0.01 degree": ("angle", Fraction(1)),
    "%": ("share", Fraction(100)),
    "0.01 %": ("share", Fraction(1)),
    "1/1000": ("share", Fraction(10)),
    "0.001": ("share", Fraction(10)),
    "Hz": ("frequency", Fraction(1)),
    "kHz": ("frequency", Fraction(1000)),
    "MHz": ("frequency", Fraction(1_000_000)),
    "steps/s": ("step rate", Fraction(1)),
    "cycle": ("cycle", Fraction(1)),
    "sample": ("sample", Fraction(1)),
    "tick": ("tick", Fraction(1)),
    "edge": ("edge", Fraction(1)),
    "byte": ("byte", Fraction(1)),
    "time": ("repetition", Fraction(1)),  # as in "seven times"
    "baud": ("bit rate", Fraction(1)),
    "bit/s": ("bit rate", Fraction(1)),
    "kbit/s": ("bit rate", Fraction(1000)),
}
# Units that occur only in limits. No constant of the firmware has such a unit.
_OF_LIMITS = {
    "mm": ("length", Fraction(1)),
    "m": ("length", Fraction(1000)),
    "KiB": ("byte", Fraction(1024)),
}
_UNIT = (
    r"(?:us|ms|s|mV|V|mA|A|rpm|degrees?|%|[kM]?Hz|k?bit/s|steps/s"
    r"|cycles?|samples?|ticks?|edges?|bytes?|times|baud)"
)
_NAMED = re.compile(r"\bN = (\d+)")  # the number of cycles that the paper calls N
_LIST = rf"(?=(?: to | and | or |, )[\d.]+ ?(?P<later>{_UNIT})(?![\w/]))"
_STATED = re.compile(
    rf"(?<![\w.^-])(?P<number>\d+(?:\.\d+)?|{'|'.join(_IN_WORDS)})"
    rf"(?:(?: successive)? ?(?P<unit>{_UNIT})(?![\w/])|{_LIST})"
)
# A number that may have no unit. Parts of names and exponents do not match. The numbers in _TRIVIAL
# are left out, because they are in many sentences that state no property of the firmware.
_BARE = re.compile(
    rf"(?<![\w.^/-])(?P<number>\d+(?:\.\d+)?|{'|'.join(_IN_WORDS)})(?![\w.]*\w|-\w|:)"
)
_TRIVIAL = {"0", "1", "2", "two"}
_IDENTIFIER = re.compile(r"\b(?:N?FR|SG|AU|HZ)-\d+(?: to (?:N?FR|SG)-\d+)?")
_RANGE = re.compile(r"\[([^\]]+)\][^.;]*?-?(\d+(?:\.\d+)?) to -?(\d+(?:\.\d+)?)")


@dataclass(frozen=True)
class Quantity:
    kind: str  # "" for a plain number
    amount: Fraction  # in the smallest unit of this kind


def stated_numbers(text: str) -> dict[str, Quantity]:
    """Returns the quantities of those numbers of a text that have a unit. The key is the number
    with its unit, such as ``200 ms``."""
    quantities: dict[str, Quantity] = {}
    for match in _STATED.finditer(re.sub(r"\s+", " ", text)):
        unit = match["unit"] or match["later"]
        kind, scale = UNITS[_singular(unit)]
        amount = number_in(match["number"])
        quantities[f"{match['number']} {unit}"] = Quantity(kind, amount * scale)
    for number in _NAMED.findall(text):
        quantities[f"N = {number}"] = Quantity("cycle", Fraction(number))
    return quantities


def bare_numbers(text: str) -> dict[str, Quantity]:
    """Returns those numbers of a text that have no unit. The numbers are in digits or are words."""
    rest = _NAMED.sub("", _STATED.sub("", _IDENTIFIER.sub("", re.sub(r"\s+", " ", text))))
    found = {match["number"] for match in _BARE.finditer(rest)} - _TRIVIAL
    return {number: Quantity("", number_in(number)) for number in sorted(found)}


def number_in(text: str) -> Fraction:
    """Returns the number at the beginning of a text. The number is in digits or is a word."""
    first = text.removeprefix("N = ").partition(" ")[0]
    return Fraction(_IN_WORDS.get(first) or first)


def limits_of_range(text: str) -> dict[str, Quantity]:
    """Returns the limits of each range whose unit is in square brackets before the range, such as
    ``[mV], 0 to 24000``. Omits 0, 1, and the limits of a number of 16 bits."""
    limits = {}
    for unit, *ends in _RANGE.findall(text):
        kind, scale = UNITS.get(_singular(unit.partition(",")[0]), ("", Fraction(1)))
        for end in ends:
            if Fraction(end) > 1 and end not in {"32767", "32768", "65535"}:
                limits[f"{end} {unit}"] = Quantity(kind, Fraction(end) * scale)
    return limits


def quantity_of(constant: Constant | ConstantFact) -> Quantity:
    unit = _singular(constant.unit.partition(" per ")[0])
    kind, scale = UNITS.get(unit, ("", Fraction(1)))
    return Quantity(kind, Fraction(str(constant.number)) * scale)


def is_same(stated: Quantity, constant: Quantity) -> bool:
    """Returns whether a quantity in a text equals a constant. If the constant has no unit, all
    units for this kind of quantity are tried, and one equal value is enough. A number without a
    unit equals a constant with the same number."""
    if not stated.kind:
        return stated.amount == constant.amount
    if constant.kind:
        return stated == constant
    scales = {scale for kind, scale in UNITS.values() if kind == stated.kind}
    return any(stated.amount == constant.amount * scale for scale in scales)


def constants_named(name: str, constants: Iterable[ConstantFact]) -> list[ConstantFact]:
    return [constant for constant in constants if constant.name == name]


def states(text: str, number: Fraction, unit: str) -> bool:
    """Returns whether a text states a number with its unit, or with another unit of the same
    kind. A unit that is not in the list of units, such as "modules", must be the same."""
    units = {**UNITS, **_OF_LIMITS}
    kind, scale = units.get(_singular(unit), ("", Fraction(1)))
    same = {name: factor for name, (other, factor) in units.items() if other == kind}
    for name, factor in (same or {_singular(unit): scale}).items():
        value = number * scale / factor
        written = re.escape(f"{float(value):.10g} {name}")
        if re.search(rf"(?<![\w.]){written}s?(?![\w/])", text):
            return True
    return False


def _singular(unit: str) -> str:
    return unit.removesuffix("s") if len(unit) > 2 and not unit.endswith("/s") else unit
