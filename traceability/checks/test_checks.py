"""test-number: each number with a unit in the brief of a test is in the code that the test
executes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache

from traceability.model.design_model import Model
from traceability.model.requirement_numbers import Quantity, is_same, quantity_of, stated_numbers
from traceability.reading.comments import code_of
from traceability.reading.gtest_cases import read_tests
from traceability.reading.source_facts import Facts
from traceability.reading.support_files import SupportFiles
from traceability.schema import Finding

LITERAL = re.compile(r"(?<![\w.])(?:0x[\dA-Fa-f']+|\d[\d']*(?:\.\d+)?(?:e-?\d+)?)")
NANOSECONDS = re.compile(r"\bnanoseconds\(([\d']+)\)")
WORD = re.compile(r"\w+")
# Kinds of quantities that are compared. Counts, for example the number of steps of a test, are left
# out.
KINDS = ("time", "voltage", "current", "velocity", "angle", "share", "frequency", "bit rate")
WHOLE = 10_000  # the share 1, in the unit of Quantity


def check(model: Model, facts: Facts) -> Iterator[Finding]:
    support = SupportFiles(facts.root)
    constants: dict[str, list[Quantity]] = {}
    for constant in facts.syntax.values:
        name = constant.name.rpartition("::")[2]
        constants.setdefault(name, []).append(quantity_of(constant))

    @cache
    def outside_tests(file: str) -> str:
        text = support.text(file)
        for case in read_tests(text):
            text = text.replace(case.body, "", 1)
        return code_of(text)

    for test in model.tests.values():
        stated = {n: q for n, q in stated_numbers(test.brief).items() if q.kind in KINDS}
        if not stated:
            continue
        file = test.place.file
        body = next(case.code for case in read_tests(support.text(file)) if case.id == test.id)
        texts = [body, outside_tests(file)]
        texts += [support.text(each) for each in sorted(support.played(file, test.id))]
        texts += [outside_tests(each) for each in sorted(support.helpers(file))]
        code = "\n".join(texts)
        numbers = {_value(number) for number in LITERAL.findall(code)}
        known = [Quantity("", number) for number in numbers]
        known += [Quantity("share", number * WHOLE) for number in numbers]  # 0.05 is 5 %
        known += [Quantity("time", _value(time) / 1000) for time in NANOSECONDS.findall(code)]
        for word in set(WORD.findall(code)):
            known += constants.get(word, [])
        for number, quantity in stated.items():
            if not any(is_same(quantity, one) for one in known):
                text = f"the brief of {test.id} states {number}, but the test does not contain it"
                yield Finding(test.place, "test-number", text)


def _value(literal: str) -> Fraction:
    plain = literal.replace("'", "")
    return Fraction(int(plain, 16)) if plain.startswith("0x") else Fraction(plain)
