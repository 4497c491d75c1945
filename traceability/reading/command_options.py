"""Reads the commands of ./wr and the programs of the simulator, with their options and the values
of the options."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from traceability.reading.graphs import reached_from
from traceability.sources import files_below

FOLDERS = ("tools", "client")  # their Python files declare the options of ./wr
PROGRAMS = "sim/programs"
DECLARED = re.compile(r'add_(?:option|flag)\w*(?:<[\w:<>]*>)?\(\s*"(--[a-z][\w-]*)')
# The values that an option accepts, or the message about a wrong value.
ACCEPTED = re.compile(r"->check\(CLI::(?:IsMember|Validator)\((.*?)\)\)", re.DOTALL)
ADDED = re.compile(r'add_parser\(\s*"([a-z-]+)"')
FOR_ALL = {"--help"}  # option that each command and each program has
# Name of a function, with the name of its file if the function is in another file.
Name = tuple[str, str]


@dataclass
class _Function:
    """A function that can declare options: the options and the commands that it declares itself,
    and the functions that it calls."""

    options: set[str] = field(default_factory=set)
    commands: set[str] = field(default_factory=set)
    calls: set[Name] = field(default_factory=set)
    # Command -> functions that declare its options, if the function lists them in a table.
    table: dict[str, set[Name]] = field(default_factory=dict)
    adds: bool = False  # whether the function adds a command


def options_of_commands(root: Path) -> dict[str, set[str]]:
    functions = _functions(root)
    options: dict[str, set[str]] = {}
    for name, function in functions.items():
        for command in function.commands:
            options[command] = _declared(functions, {name}) | FOR_ALL
        # If the names of the added commands are not literals, they are in the table.
        for command, named in function.table.items() if function.adds else ():
            options[command] = _declared(functions, named) | FOR_ALL
    return options


def options_of_programs(root: Path) -> dict[str, set[str]]:
    """Returns the options of each program of the simulator. Headers declare options that several
    programs have."""
    texts = {path: path.read_text("utf-8") for path in files_below(root, (PROGRAMS,))}
    headers = {path.name: text for path, text in texts.items() if path.suffix == ".hpp"}
    options = {}
    for path, text in texts.items():
        if path.suffix == ".cpp":
            included = [text, *(headers[name] for name in headers if f'/{name}"' in text)]
            options[path.stem] = FOR_ALL.union(*map(DECLARED.findall, included))
    return options


def accepted_values(root: Path) -> dict[str, set[str]]:
    """Returns the accepted words of each option that has a list of values. If several commands or
    programs have the option, returns the words of all of them. If the first word of a command has
    such a list, the command is included, for example "./wr campaign"."""
    values: dict[str, set[str]] = {}
    for path in files_below(root, (PROGRAMS,), (".cpp", ".hpp")):
        for part in re.split(r"(?=\badd_(?:option|flag))", path.read_text(encoding="utf-8")):
            option, accepted = DECLARED.match(part), ACCEPTED.search(part)
            if option and accepted:
                words = " ".join(re.findall(r'"([^"]*)"', accepted[1])).replace(",", " ").split()
                values.setdefault(option[1], set()).update(words)
    for _, code in _python(root, "choices="):
        added = ADDED.search(code)
        for node in ast.walk(ast.parse(code)):
            if isinstance(node, ast.Call):
                choices = [word.value for word in node.keywords if word.arg == "choices"]
                if choices and isinstance(choices[0], ast.Tuple):
                    name, words = ast.literal_eval(node.args[0]), ast.literal_eval(choices[0])
                    if added and not name.startswith("-"):
                        name = f"./wr {added[1]}"  # The value is the first word of the command.
                    values.setdefault(name, set()).update(words)
    return values


def _functions(root: Path) -> dict[Name, _Function]:
    functions: dict[Name, _Function] = {}
    for path, code in _python(root, "add_"):
        tree = ast.parse(code)
        imported = _imported(tree)
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                functions[path.stem, node.name] = _read(path.stem, node, imported)
    return functions


def _python(root: Path, part: str) -> Iterator[tuple[Path, str]]:
    """Yields the Python files that contain a text, and their code. The other files are not parsed,
    because this takes time."""
    for path in files_below(root, FOLDERS, (".py",)):
        code = path.read_text(encoding="utf-8")
        if part in code:
            yield path, code


def _imported(tree: ast.Module) -> dict[str, str]:
    """Returns a map from each name that a file imports to the name of the file that defines it."""
    return {
        alias.asname or alias.name: (node.module or "").rpartition(".")[2]
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


def _read(file: str, function: ast.FunctionDef, imported: dict[str, str]) -> _Function:
    result = _Function()
    for node in ast.walk(function):
        if isinstance(node, ast.Call):
            _read_call(node, result)
            result.calls.update(_references(file, node.func, imported))
        elif isinstance(node, ast.Dict):
            for key, value in zip(node.keys, node.values, strict=True):
                if isinstance(key, ast.Constant) and isinstance(value, ast.Tuple):
                    result.table[str(key.value)] = {
                        name for each in value.elts for name in _references(file, each, imported)
                    }
    return result


def _read_call(call: ast.Call, result: _Function) -> None:
    method = call.func.attr if isinstance(call.func, ast.Attribute) else ""
    words = [each.value for each in call.args if isinstance(each, ast.Constant)]
    if method == "add_argument":
        result.options.update(str(word) for word in words if str(word).startswith("--"))
    elif method == "add_parser":
        result.adds = True
        result.commands.update(str(word) for word in words[:1])


def _references(file: str, node: ast.expr, imported: dict[str, str]) -> Iterator[Name]:
    if isinstance(node, ast.Name):
        yield imported.get(node.id, file), node.id
    elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        yield node.value.id, node.attr


def _declared(functions: dict[Name, _Function], names: set[Name]) -> set[str]:
    """Returns the options that are declared by the given functions or by functions that they
    call."""
    none = _Function()
    reached = reached_from(names, lambda name: functions.get(name, none).calls)
    return {option for name in reached for option in functions.get(name, none).options}


def texts_of_programs(root: Path) -> Iterator[tuple[str, int, str]]:
    """Yields the texts that the commands print, and the docstrings: the file, the line and the
    text. A text of one word is left out, because it is an argument of another program."""
    for path, code in _python(root, "--"):
        for node in ast.walk(ast.parse(code)):
            text = node.value if isinstance(node, ast.Constant) else None
            if isinstance(node, ast.Constant) and isinstance(text, str) and " " in text:
                yield str(path.relative_to(root)), node.lineno, text
