"""The texts of requirements contain numbers, with or without a unit. These numbers are compared
with the constants of the code."""

from fractions import Fraction

from traceability.model.requirement_numbers import (
    Quantity,
    bare_numbers,
    is_same,
    quantity_of,
    stated_numbers,
    states,
)
from traceability.reading.ast_facts import ConstantFact
from traceability.schema import Place


def constant(number: int, unit: str = "") -> Quantity:
    return quantity_of(ConstantFact("kTime", number, unit, Place("src/A.hpp", 1)))


def test_digits_and_words_with_a_unit_are_read() -> None:
    text = "shall end after 200 ms, in five cycles, between 21 and 29 V, as in FR-12 at 3 places"
    assert list(stated_numbers(text)) == ["200 ms", "five cycles", "21 V", "29 V"]
    assert list(stated_numbers("seven times in a row")) == ["seven times"]
    assert stated_numbers("at 0.5 MHz, 9600 bit/s") == {
        "0.5 MHz": Quantity("frequency", Fraction(500_000)),
        "9600 bit/s": Quantity("bit rate", Fraction(9600)),
    }


def test_numbers_without_a_unit_are_read() -> None:
    text = "shall end at 25 or nine of FR-12, after 200 ms, at bit 0, and 2 or e^12 or the fifth"
    assert list(bare_numbers(text).items()) == [
        (number, Quantity("", Fraction(value)))
        for number, value in sorted([("25", 25), ("nine", 9), ("fifth", 5)])
    ]
    assert is_same(bare_numbers("25")["25"], constant(25, "edges"))
    assert not is_same(bare_numbers("25")["25"], constant(20))


def test_a_number_is_compared_in_the_unit_of_the_constant() -> None:
    time = stated_numbers("200 ms")["200 ms"]
    assert is_same(time, constant(200_000, "us"))
    assert is_same(time, constant(200))
    assert not is_same(time, constant(200, "us"))
    assert not is_same(time, constant(201))


def test_a_part_of_a_unit_is_exact() -> None:
    assert stated_numbers("0.05 degrees")["0.05 degrees"] == Quantity("angle", Fraction(5))


def test_a_limit_is_stated_in_any_unit_of_its_kind() -> None:
    text = "shall be within 1.5 m in 2 s, with at most 128 KiB and 133 modules, within 0.5 degrees"
    for number, unit in (("1500", "mm"), ("2000", "ms"), ("0.5", "degrees"), ("131072", "bytes")):
        assert states(text, Fraction(number), unit)
        assert not states(text, Fraction(number) + 1, unit)
    assert states(text, Fraction(133), "modules")
    assert not states(text, Fraction(133), "applications")
    assert not states(text, Fraction(5), "m")
