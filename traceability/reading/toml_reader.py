"""Reads the entries of the TOML files in ``design/``. Each entry has its place.

If an entry cannot be read, the reader skips this entry and reports a problem."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import MISSING, Field, dataclass, field, fields
from numbers import Real
from pathlib import Path
from typing import Any, ClassVar, Protocol, TypeVar, get_args, get_origin, get_type_hints

from traceability.reading.constant_texts import Constants, inserted
from traceability.schema import Place
from traceability.sources import text_of

MAY_BE_EMPTY = ("guard", "action")  # keys of a transition whose text may be empty
Keys = Mapping[str, type[Any]]
Entry = tuple[dict[str, Any], Place]


class DataclassInstance(Protocol):
    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


T = TypeVar("T", bound=DataclassInstance)


@dataclass
class Problem:
    place: Place
    text: str
    fix: str


@dataclass
class Entries:
    """The entries of the files. A text can insert a constant or a formula of ``constants``, with
    the role ``:constant:``."""

    root: Path
    constants: Constants = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)
    unreadable: list[str] = field(default_factory=list)  # paths of files that are not TOML
    _read: dict[Path, dict[str, Any]] = field(default_factory=dict)
    _asked: dict[Path, set[str]] = field(default_factory=dict)

    def whole(self, path: Path) -> dict[str, Any]:
        """Returns the content of a TOML file. Returns an empty content if the file does not exist
        or is not valid TOML."""
        if path not in self._read:
            text = inserted(text_of(path), self.constants)
            try:
                self._read[path] = tomllib.loads(text)
            except tomllib.TOMLDecodeError as error:
                self._read[path] = {}
                self._unreadable(path, text, str(error))
        return self._read[path]

    def _unreadable(self, path: Path, text: str, error: str) -> None:
        match = re.search(r" \(at line (\d+), column \d+\)$", error)
        line = int(match[1]) if match else len(text.splitlines())
        said = error[: match.start()] if match else error
        place = Place(str(path.relative_to(self.root)), line)
        self.unreadable.append(place.file)
        self.problems.append(
            Problem(place, f"{place.file} is not valid TOML: {said}", "correct the line")
        )

    def value(self, path: Path, name: str, missing: Any) -> Any:
        """Returns the value of a top-level name in a file, or a default value."""
        self._asked.setdefault(path, set()).add(name)
        return self.whole(path).get(name, missing)

    def tables(
        self, path: Path, name: str, needs: Keys, may: Keys | None = None, own: str = ""
    ) -> list[Entry]:
        """Returns the entries ``[[name]]`` of a file. If two entries have the same value of the key
        ``own``, the second entry is a problem."""
        listed = self.value(path, name, [])
        places = self._places(path, name, len(listed))
        entries: list[Entry] = []
        seen: dict[str, int] = {}
        for item, place in zip(listed, places, strict=True):
            if not self.fits(item, place, needs, may or {}):
                continue
            if own and item[own] in seen:
                text = f"line {seen[item[own]]} already has an entry with the {own} {item[own]}"
                self.problems.append(Problem(place, text, "remove one of the two entries"))
                continue
            if own:
                seen[item[own]] = place.line
            entries.append((item, place))
        return entries

    def records(
        self,
        path: Path,
        name: str,
        record: type[T],
        own: str = "",
        *,
        may: Sequence[str] = (),
        keys: Mapping[str, str] | None = None,
        **fixed: Any,
    ) -> list[T]:
        """Returns the entries ``[[name]]`` of a file as objects of a dataclass.

        An entry must contain a key for each field without a default value. A key for a field in
        ``may`` is optional. ``keys`` lists the fields whose key has another name. The field
        ``place`` receives the place of the entry."""
        types = {key: _type_of(hint) for key, hint in get_type_hints(record).items()}
        members = fields(record)
        key_of = {each.name: (keys or {}).get(each.name, each.name) for each in members}
        bare = {
            each.name
            for each in members
            if each.default is MISSING and each.default_factory is MISSING
        }
        needs = {key_of[each]: types[each] for each in bare - {"place", *may, *fixed}}
        others = {key_of[each]: types[each] for each in may}
        absent = {each: types[each]() for each in bare.intersection(may)}
        records = []
        for item, place in self.tables(path, name, needs, others, own):
            values = {each: item[key] for each, key in key_of.items() if key in item}
            records.append(record(**{**absent, **fixed, **values, "place": place}))
        return records

    def named(
        self, path: Path, name: str, record: type[T], own: str, **options: Any
    ) -> dict[str, T]:
        """Returns the same objects as ``records``, as a map from the value of the key ``own``."""
        entries = self.records(path, name, record, own, **options)
        return {getattr(entry, own): entry for entry in entries}

    def _places(self, path: Path, name: str, count: int) -> list[Place]:
        header = re.compile(rf"\s*\[\[\s*{re.escape(name)}\s*\]\]")
        lines = path.read_text(encoding="utf-8").splitlines() if count else []
        numbers = [number for number, line in enumerate(lines, 1) if header.match(line)]
        numbers += [1] * (count - len(numbers))
        return [Place(str(path.relative_to(self.root)), number) for number in numbers[:count]]

    def fits(self, item: dict[str, Any], place: Place, needs: Keys, may: Keys) -> bool:
        """Returns whether an entry has all keys that it needs. Reports a problem for each missing,
        empty or unknown key."""
        keys = {*needs, *may}
        missing = [key for key in needs if not isinstance(item.get(key), needs[key])]
        for key in missing:
            text = f"the key {key} is missing, or its value is not {_WORDS[needs[key]]}"
            self.problems.append(Problem(place, text, "add the key, or correct its name or value"))
        for key in [key for key, value in item.items() if _is_blank(key, value)]:
            text = f"{key} is empty"
            fix = "add the missing text, or remove the key"
            self.problems.append(Problem(self.line_in(place, key), text, fix))
        for key in [key for key in item if key not in keys]:
            text = f"the key {key} is unknown: no tool reads it"
            self.problems.append(Problem(self.line_in(place, key), text, "correct its name"))
            del item[key]
        return not missing

    def line_in(self, place: Place, words: str) -> Place:
        """Returns the place of a text in the entry that begins at ``place``. If the entry does not
        contain the text, returns ``place``."""
        lines = text_of(self.root / place.file).splitlines()
        pattern = re.compile(rf"(?<![\w-]){re.escape(words)}(?![\w-])")
        header = lines[place.line - 1] if place.line <= len(lines) else ""
        # Tables with this prefix, such as [[entry.part]], belong to the entry.
        below = header.strip().rstrip("]") + "."
        for number, line in enumerate(lines[place.line - 1 :], place.line):
            if number > place.line and line.startswith("[[") and not line.startswith(below):
                break
            if pattern.search(line.split(" #")[0]) and not line.startswith("#"):
                return Place(place.file, number)
        return place

    def others(self) -> None:
        """Reports a problem for each table and each top-level name that no tool reads."""
        for path, keys in self._asked.items():
            for name in self._read.get(path, {}).keys() - keys:
                text = f"the name {name} is unknown: no tool reads it"
                self.problems.append(Problem(self.place_of(path, name), text, "correct the name"))

    def absent(self, files: Iterable[Path]) -> None:
        """Reports a problem for each expected file that does not exist."""
        for path in [path for path in files if not path.exists()]:
            place = Place(str(path.relative_to(self.root)), 1)
            text, fix = "there is no such file", "create the file, or restore it with git"
            self.problems.append(Problem(place, text, fix))

    def place_of(self, path: Path, name: str) -> Place:
        """Returns the place where a name first occurs in a file."""
        begins = re.compile(rf"\s*(\[\[?\s*)?{re.escape(name)}\b")
        lines = text_of(path).splitlines()
        line = next((n for n, line in enumerate(lines, 1) if begins.match(line)), 1)
        return Place(str(path.relative_to(self.root)), line)


def _type_of(hint: Any) -> type[Any]:
    """Returns the type that the value of a dataclass field has in TOML."""
    origin = get_origin(hint)
    if origin is None:
        return Real if hint is float else hint
    if origin in (list, Sequence):
        return list
    return dict if origin in (dict, Mapping) else _type_of(get_args(hint)[0])


def _is_blank(key: str, value: object) -> bool:
    if value == "" and key in MAY_BE_EMPTY:
        return False
    return isinstance(value, str) and not value.strip()


_WORDS = {
    str: "a text",
    list: "a list",
    dict: "a table",
    int: "a number",
    Real: "a number",
    bool: "true or false",
}
