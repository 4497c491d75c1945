"""Random texts for the tests of the readers. Each text is a valid text after some random edits. The
seed is the seed of the test run."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, settings
from hypothesis import seed as hypothesis_seed
from hypothesis import strategies as st

SEED = int(os.environ.get("WR_SEED", "1"))
CHARACTERS = "[]{}()=\"'#,.:-+*?<>@\\/ \n\tab01~é\0"
ODD = ("0", "-1", "[]", "{}", '""', "true", "1e999", "nan", "[[x]]", "a.b = 1", "FR-1", "  ", "'''")


def randomised(examples: int) -> Callable[[Any], Any]:
    """Returns the settings of a property test. The same seed gives the same examples, and a failure
    prints the seed."""

    def decorate(test: Any) -> Any:
        chosen = settings(
            max_examples=examples,
            deadline=None,
            database=None,
            print_blob=True,
            suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
        )
        return hypothesis_seed(SEED)(chosen(test))

    return decorate


def edited(sound: str) -> st.SearchStrategy[str]:
    """Returns a strategy that generates texts. Each text is the valid text ``sound`` after one to
    four random edits of lines or characters."""
    place = st.floats(0, 1, exclude_max=True)
    piece = st.one_of(st.sampled_from(ODD), st.text(CHARACTERS, max_size=6))
    edit = st.tuples(st.sampled_from(sorted(EDITS)), place, place, piece)
    return st.lists(edit, min_size=1, max_size=4).map(lambda edits: _apply(sound, edits))


def _apply(text: str, edits: list[tuple[str, float, float, str]]) -> str:
    for name, first, second, piece in edits:
        text = EDITS[name](text, first, second, piece)
    return text


def _insert(text: str, first: float, _second: float, piece: str) -> str:
    at = int(first * (len(text) + 1))
    return text[:at] + piece + text[at:]


def _remove(text: str, first: float, second: float, _piece: str) -> str:
    at = int(first * (len(text) + 1))
    return text[:at] + text[at + int(second * 10) :]


def _replace_value(text: str, first: float, _second: float, piece: str) -> str:
    lines = text.splitlines()
    places = [number for number, line in enumerate(lines) if " = " in line]
    if not places:
        return text + piece
    number = places[int(first * len(places))]
    lines[number] = lines[number].split(" = ")[0] + " = " + piece
    return "\n".join(lines) + "\n"


def _move_line(text: str, first: float, second: float, _piece: str) -> str:
    lines = text.splitlines() or [""]
    line = lines.pop(int(first * len(lines)))
    lines.insert(int(second * (len(lines) + 1)), line)
    return "\n".join(lines) + "\n"


def _double_line(text: str, first: float, second: float, _piece: str) -> str:
    lines = text.splitlines() or [""]
    lines.insert(int(second * (len(lines) + 1)), lines[int(first * len(lines))])
    return "\n".join(lines) + "\n"


EDITS: dict[str, Callable[[str, float, float, str], str]] = {
    "insert": _insert,
    "remove": _remove,
    "value": _replace_value,
    "move": _move_line,
    "double": _double_line,
}
