"""The documents list the exceptions of the static analysis."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
QUICK_START = ROOT / "docs/quick_start.rst"
QUESTIONS = ROOT / "design/questions.toml"


def exemptions(folder: str) -> int:
    sources = [path for path in (ROOT / folder).rglob("*.?pp") if path.is_file()]
    assert sources
    return sum(len(re.findall(r"NOLINT(?!END)", path.read_text("utf-8"))) for path in sources)


@pytest.mark.parametrize("document", [QUICK_START, QUESTIONS], ids=lambda path: path.name)
def test_the_documents_have_the_number_of_exempt_lines(document: Path) -> None:
    text = " ".join(document.read_text("utf-8").replace("`", "").split())
    assert f"In src, {NUMBERS[exemptions('src')]} comments NOLINT exempt single lines" in text
    assert exemptions("extensions") == 0


@pytest.mark.parametrize("document", [QUICK_START, QUESTIONS], ids=lambda path: path.name)
def test_the_documents_name_each_rule_of_cert_that_is_switched_off(document: Path) -> None:
    rules = re.findall(r"^  -(cert-[\w-]+)", (ROOT / ".clang-tidy").read_text("utf-8"), re.M)
    text = document.read_text("utf-8")
    assert f"{NUMBERS[len(rules)].capitalize()} rules of CERT are switched off" in text
    assert [rule for rule in rules if rule not in text] == []
