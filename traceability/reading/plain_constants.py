"""Reads the constants of the simulator (C++) and of the Python programs from their source texts. A
constant is read only if its value is one number, or a range of numbers."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from traceability.grouping import grouped
from traceability.reading.constants import unit_in
from traceability.reading.source_lines import place_at
from traceability.schema import Constant, Place
from traceability.sources import files_below

SIMULATOR = "sim"
PROGRAMS = ("client/weeding_robot_client", "tools")
_NUMBER = r"-?\d[\d']*(?:\.\d+)?(?:e[+-]?\d+)?"
# A constant such as `constexpr double kSwitch = 33.5;  ///< [degree] angle`, or the initial value
# of a public data member such as `double mass = 175.0;  ///< [kg]`.
_CPP = re.compile(
    r"^ *(?:(?:inline |static )*constexpr )?(?P<type>[\w:]+) (?P<name>\w*[A-Za-z0-9])"
    rf"(?: =\s+(?:(?P<made>[\w:]+)\()?|[{{(]\s*)(?P<number>{_NUMBER})[UF]?[)}}]?;"
    r"(?P<comment>[^\n]*)",
    re.MULTILINE,
)
# A range such as `constexpr Range kSupply{.low = 21.0, .high = 29.0};  // [V]`.
_RANGE = re.compile(
    rf"^constexpr \w+ (?P<name>\w+)\{{\.low = (?P<low>{_NUMBER}), \.high = (?P<high>{_NUMBER})\}};"
    r"(?P<comment>[^\n]*)",
    re.MULTILINE,
)
_CHRONO = {
    "nanoseconds": "ns",
    "microseconds": "us",
    "Microseconds": "us",
    "milliseconds": "ms",
    "seconds": "s",
}
# End of a Python name -> unit
_ENDS = {"S": "s", "RPM": "rpm", "DEGREES": "degree", "VOLTS": "V", "AMPERES": "A", "BYTES": "byte"}


def plain_constants(root: Path) -> dict[str, Constant]:
    """Returns the constants by their names: ``folder::File::name`` for a constant in a folder of
    the simulator, ``file.NAME`` for a constant of a Python program. A range has two names, with
    ``.low`` and ``.high`` at the end. A name is left out if it has more than one value."""
    return unambiguous(_constants(root))


def _constants(root: Path) -> Iterator[tuple[str, Constant]]:
    for path in files_below(root, (SIMULATOR, *PROGRAMS), (".hpp", ".cpp", ".py")):
        read = _of_python if path.suffix == ".py" else constants_of_cpp
        yield from read(path, str(path.relative_to(root)))


def unambiguous(constants: Iterable[tuple[str, Constant]]) -> dict[str, Constant]:
    """Returns the constants by their names. A name is left out if it has more than one value."""
    return {
        name: found[0][1]
        for name, found in grouped(constants, lambda pair: pair[0]).items()
        if len({(value.number, value.unit) for _, value in found}) == 1
    }


def constants_of_cpp(path: Path, file: str) -> Iterator[tuple[str, Constant]]:
    text = path.read_text(encoding="utf-8")
    folder = f"{path.parent.name}::{path.stem}::"

    def constant(match: re.Match[str], group: str, unit: str) -> Constant:
        number = float(match[group].replace("'", ""))
        return Constant(number, unit, place_at(file, text, match.start("name")))

    for match in _CPP.finditer(text):
        unit = unit_in(match["comment"]) or next(
            (_CHRONO[word] for word in _words(match) if word in _CHRONO), ""
        )
        yield folder + match["name"], constant(match, "number", unit)
    for match in _RANGE.finditer(text):
        for end in ("low", "high"):
            unit = unit_in(match["comment"])
            yield f"{folder}{match['name']}.{end}", constant(match, end, unit)


def _words(match: re.Match[str]) -> list[str]:
    return [(match[group] or "").rpartition("::")[2] for group in ("type", "made")]


def _of_python(path: Path, file: str) -> Iterator[tuple[str, Constant]]:
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    for node in ast.parse(text).body:
        if not (isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)):
            continue
        name, value = node.targets[0].id, node.value
        number = value.value if isinstance(value, ast.Constant) else None
        if isinstance(number, (int, float)) and not isinstance(number, bool):
            comment = lines[node.lineno - 1].partition("#")[2]
            unit = unit_in(comment) or _ENDS.get(name.rpartition("_")[2], "")
            constant = Constant(float(number), unit, Place(file, node.lineno))
            yield f"{path.stem}.{name}", constant
