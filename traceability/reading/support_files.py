"""Finds the files on which the result of a test depends. The tested code is left out."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from traceability.reading.graphs import reached_from
from traceability.reading.gtest_cases import read_tests
from traceability.sources import files_below

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
SCENARIOS = ("sim/scenario", "tests")
LITERAL = re.compile(r'"([^"\n]+)"')


class SupportFiles:
    """A search for the fixtures, helpers and scenarios of tests. Each file is read only once."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.text = cache(self._text)
        self.helpers = cache(self._helpers)
        self.included = cache(self._included)
        self.played = cache(self._played)
        self.sources = {
            str(path.relative_to(root)) for path in files_below(root, ["tests"], (".hpp", ".cpp"))
        }
        self.scenarios = {
            path.stem: str(path.relative_to(root))
            for path in files_below(root, SCENARIOS, (".scenario",))
        }

    def of(self, file: str, test: str) -> set[str]:
        """Returns the file itself, the helpers that it includes, and the scenarios that the test
        executes."""
        return {file, *self.helpers(file), *self.played(file, test)}

    def _text(self, file: str) -> str:
        return (self.root / file).read_text(encoding="utf-8")

    def _helpers(self, file: str) -> frozenset[str]:
        """Returns the headers in tests/ that a file includes, directly or indirectly, and the
        source files of these headers."""

        def next_of(name: str) -> list[str]:
            return [*self.included(name), *(self._behind(name) if name.endswith(".hpp") else [])]

        return frozenset({*reached_from([file], next_of)} - {file})

    def _included(self, file: str) -> set[str]:
        named = INCLUDE.findall(self.text(file))
        places = {f"tests/{name}" for name in named} | {f"{Path(file).parent}/{n}" for n in named}
        return places & self.sources

    def _behind(self, header: str) -> list[str]:
        return [
            source
            for source in self.sources
            if source.endswith(".cpp")
            and not source.endswith("Test.cpp")
            and header in self.included(source)
        ]

    def _played(self, file: str, test: str) -> set[str]:
        """Returns the scenarios whose names are in the test or in its parameters. For the name of a
        folder, returns all scenarios in this folder."""
        suite = test.split(".", maxsplit=1)[0]
        bodies = [case.body for case in read_tests(self.text(file)) if case.id == test]
        lists = re.findall(
            rf"^INSTANTIATE_TEST_SUITE_P\(\s*\w+,\s*{suite},.*?;$",
            self.text(file),
            re.MULTILINE | re.DOTALL,
        )
        own = "\n".join([*bodies, *lists])
        named = {self.scenarios.get(Path(word).stem, "") for word in LITERAL.findall(own)} - {""}
        if named or "cenario" not in self.text(file) or "ValuesIn(" not in own:
            return named
        files = [file, *self.helpers(file)]
        words = {word for name in files for word in LITERAL.findall(self.text(name))}
        return {
            path
            for path in self.scenarios.values()
            if any(path.startswith(f"{word}/") for word in words)
        }
