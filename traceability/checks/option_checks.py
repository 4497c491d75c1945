"""link-doc: if a text names a command, an option or the value of an option, this command, option or
value exists. The build of the pages inserts the exit codes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from pathlib import Path

from traceability.reading.command_options import (
    accepted_values,
    options_of_commands,
    options_of_programs,
    texts_of_programs,
)
from traceability.reading.source_lines import lines_below
from traceability.schema import Finding, Place

PAGES = ("README.md", "CONTRIBUTING.md", "docs", "changes", "ports", "design", "site", "tools")
SUFFIXES = (".md", ".rst", ".toml", ".html", ".py")
COMMAND = re.compile(r"\./wr ([a-z][a-z-]*)((?: +(?:--?[a-z][a-z-]*|[A-Z.\d/_a-z]+))*)")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*")
# LITERAL: a literal that begins with an option. COMMENT: a comment after a command.
LITERAL = re.compile(r"(?<!`)(?:`{1,2}|<code>)(--[a-z][a-z0-9-]*[^`<]*)")
OTHER_PROGRAM = re.compile(r"``\w[^`]*``")  # a literal with a command of another program
COMMENT = re.compile(r"^\s*\./wr [^#]*# (.*)")
# an option or a command, and its value
VALUE = re.compile(r"(?<![\w-])(--[a-z][a-z0-9-]*|\./wr [a-z-]+)[ =]([a-z][\w:-]*)")
# The place and the text of a line.
Line = tuple[Place, str]
# An exit code that is written as a number. A text must contain the name of the exit code instead.
# For the name, the build of the pages inserts the number.
EXIT_CODE = re.compile(r"\b[Ee]xit code (?:is )?(?:then )?(\d+)\b")
EXIT_CODES = ".. list-table:: Exit codes"
ROW = re.compile(r"\s+\* - (\d+)$")  # a row of a table that begins with a number
INSERTED = {".rst": "write :exit:`NAME`", ".html": "write {{ codes.NAME }}", ".py": "write {NAME}"}
FIX = "name a command that ./wr --help lists"


@dataclass
class _Options:
    """The options of each command and of each program."""

    commands: dict[str, set[str]]
    programs: dict[str, set[str]]

    @cached_property
    def all(self) -> set[str]:
        return set().union(*self.commands.values(), *self.programs.values())

    def named_in(self, lines: list[str]) -> set[str]:
        """Returns the options of the commands and programs that the lines name."""
        text = "\n".join(lines)
        options: set[str] = set()
        for command, *_ in COMMAND.findall(text):
            options |= self.commands.get(command, set())
        for program, own in self.programs.items():
            options |= own if program in text else set()
        return options


def missing_options(root: Path) -> Iterator[Finding]:
    """Finds commands of ./wr that do not exist, and options that the named command does not have.
    An option without a command must be an option of a command or program that the same page
    names."""
    options = _Options(options_of_commands(root), options_of_programs(root))
    yield from _wrong_in_programs(root, options)
    lines = lines_below(root, PAGES, SUFFIXES) if options.commands else ()
    for file, group in groupby(lines, lambda each: each[0].file):
        for section in _sections(file, list(group)):
            yield from _wrong_in(section, options)


def _sections(file: str, lines: list[Line]) -> Iterator[list[Line]]:
    """Splits a file of design/ before each entry. Any other file is one section."""
    section: list[Line] = []
    for place, line in lines:
        if file.endswith(".toml") and line.startswith("[["):
            yield section
            section = []
        section.append((place, line))
    yield section


def _wrong_in(section: list[Line], options: _Options) -> Iterator[Finding]:
    of_section = options.named_in([line for _, line in section]) or options.all
    for place, line in section:
        for command, words in COMMAND.findall(line) if "./wr " in line else ():
            if own := options.commands.get(command):
                for word in [word for word in OPTION.findall(words) if word not in own]:
                    fix = f"name an option that ./wr {command} --help lists"
                    yield Finding(place, "link-doc", f"./wr {command} has no {word}", fix)
            elif not (place.file.endswith(".py") or _is_comment(place, line)):
                yield Finding(place, "link-doc", f"./wr has no {command}", FIX)
        for word in _alone(line) if "--" in line else ():
            if word not in of_section:
                text = f"the option {word} belongs to no command or program on this page"
                yield Finding(place, "link-doc", text, "name an option that exists")


def wrong_values(root: Path) -> Iterator[Finding]:
    """Finds wrong values of options in texts: the option does not accept the value."""
    values = accepted_values(root)
    for place, line in lines_below(root, PAGES, SUFFIXES) if values else ():
        for option, value in VALUE.findall(line) if "--" in line or "./wr " in line else ():
            accepted = {word.partition(":")[0] for word in values.get(option, {value})}
            if value.partition(":")[0] not in accepted:
                text = f"{option} does not accept {value}"
                yield Finding(place, "link-doc", text, "name a value that it accepts")


def _is_comment(place: Place, line: str) -> bool:
    return place.file.endswith(".toml") and line.startswith("#")


def _wrong_in_programs(root: Path, options: _Options) -> Iterator[Finding]:
    """Searches help texts, messages and docstrings for options that no command or program has."""
    for file, line, text in texts_of_programs(root):
        for word in OPTION.findall(OTHER_PROGRAM.sub("", text)):
            if word not in options.all:
                yield Finding(Place(file, line), "link-doc", f"no command has the option {word}")


def _alone(line: str) -> Iterator[str]:
    """Yields the options that do not follow a command."""
    for text in [*LITERAL.findall(line), *COMMENT.findall(line)]:
        yield from OPTION.findall(text)


def literal_exit_codes(root: Path) -> Iterator[Finding]:
    """Finds exit codes that a page or a help text does not insert from exit_codes.py."""
    in_table = False
    for place, line in lines_below(root, (*PAGES, "client"), tuple(INSERTED)):
        insert = INSERTED.get(Path(place.file).suffix)  # None: nothing is inserted in this file
        in_table = line.startswith(EXIT_CODES) or (in_table and not line[:1].strip())
        codes = EXIT_CODE.findall(line) + (ROW.findall(line) if in_table else [])
        for code in codes if insert else ():
            fix = f"{insert}, with a name of exit_codes.py"
            yield Finding(place, "link-doc", f"the exit code {code} is not inserted", fix)
