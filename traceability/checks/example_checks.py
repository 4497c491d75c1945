"""doc-name: the Python examples on the pages use only modules, names, methods and parameters that
the client has."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from textwrap import dedent

from traceability.schema import Finding, Place
from traceability.sources import files_below

PACKAGE = "weeding_robot_client"
PAGES = ("README.md", "docs", "changes", "ports")
BLOCK = re.compile(
    r"^ *\.\. code-block:: python\n((?:\n| .*\n)+)|^```python\n((?:(?!```).*\n)+)", re.MULTILINE
)
OF_ENUM = ("name", "value")  # attributes of each enumerator

Definitions = dict[str, ast.AST]


def wrong_examples(root: Path) -> Iterator[Finding]:
    """Finds names in the Python examples of the pages that the client does not have."""
    for path in files_below(root, PAGES, (".md", ".rst")):
        text = path.read_text(encoding="utf-8")
        for match in BLOCK.finditer(text):
            group = match.lastindex or 0
            first = text.count("\n", 0, match.start(group))
            for line, wrong in _wrong(dedent(match[group]), root / "client"):
                place = Place(str(path.relative_to(root)), first + line)
                fix = "write the name that the client has now"
                yield Finding(place, "doc-name", wrong, fix)


def _wrong(code: str, folder: Path) -> Iterator[tuple[int, str]]:
    """Yields the line and the text of each finding of an example."""
    try:
        nodes = list(ast.walk(ast.parse(code)))
    except SyntaxError as error:
        yield error.lineno or 1, f"the example is not valid Python: {error.msg}"
        return
    known: Definitions = {}
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == PACKAGE:
            for alias in node.names:
                found = _imported(folder, node.module or "", alias.name)
                if found is None:
                    yield node.lineno, f"{node.module} has no {alias.name}"
                else:
                    known[alias.asname or alias.name] = found
    known |= _objects(nodes, known)
    for node in nodes:
        if isinstance(node, ast.Attribute) and (owner := _resolve(node.value, known)):
            members = _members(owner)
            if members and node.attr not in members:
                yield node.lineno, f"{ast.unparse(node.value)} has no attribute {node.attr}"
        elif isinstance(node, ast.Call) and (function := _resolve(node.func, known)):
            parameters = _parameters(function)
            for keyword in node.keywords if parameters else ():
                if keyword.arg and keyword.arg not in parameters:
                    text = f"{ast.unparse(node.func)} has no parameter {keyword.arg}"
                    yield keyword.lineno, text


def _imported(folder: Path, module: str, name: str) -> ast.AST | None:
    """Returns the definition of a name that a module contains, or the module with this name."""
    tree = _module(folder, module)
    own = _members(tree).get(name) if tree else None
    return own or _module(folder, f"{module}.{name}")


def _objects(nodes: list[ast.AST], known: Definitions) -> Definitions:
    """Returns the classes of the variables that an example constructs."""
    objects: Definitions = {}
    for node in nodes:
        match node:
            case (
                ast.Assign(targets=[ast.Name(id=name)], value=ast.Call(func=called))
                | ast.withitem(optional_vars=ast.Name(id=name), context_expr=ast.Call(func=called))
            ) if isinstance(owner := _resolve(called, known), ast.ClassDef):
                objects[name] = owner
    return objects


def _module(folder: Path, name: str) -> ast.Module | None:
    path = folder.joinpath(*name.split("."))
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    return ast.parse(file.read_text(encoding="utf-8")) if file.is_file() else None


def _resolve(node: ast.expr, known: Definitions) -> ast.AST | None:
    """Returns the definition of an expression: a module, a class, or a function. The definition of
    an object is its class."""
    if isinstance(node, ast.Name):
        return known.get(node.id)
    if isinstance(node, ast.Attribute) and (owner := _resolve(node.value, known)):
        return _members(owner).get(node.attr)
    return None


def _members(owner: ast.AST) -> Definitions:
    """Returns the members of a module, or of a class and its objects. Returns nothing for other
    definitions, and for a class that inherits members."""
    if not isinstance(owner, ast.Module | ast.ClassDef):
        return {}
    members: Definitions = {}
    for node in owner.body if isinstance(owner, ast.Module) else ast.walk(owner):
        match node:
            case ast.ClassDef(name=name) | ast.FunctionDef(name=name):
                members[name] = node
            case ast.Assign(
                targets=[ast.Name(id=name) | ast.Attribute(value=ast.Name(id="self"), attr=name)]
            ):
                members[name] = node
            case ast.AnnAssign(target=ast.Name(id=name) | ast.Attribute(attr=name)):
                members[name] = node
            case ast.Import() | ast.ImportFrom():
                members |= {alias.asname or alias.name: node for alias in node.names}
    if isinstance(owner, ast.ClassDef) and owner.bases:
        if [ast.unparse(base) for base in owner.bases] != ["Enum"]:
            return {}
        members |= dict.fromkeys(OF_ENUM, owner)
    return members


def _parameters(called: ast.AST) -> set[str]:
    """Returns the names of the parameters of a function or of a constructor. Returns nothing if the
    function accepts any name."""
    if isinstance(called, ast.ClassDef):
        own = {node.name: node for node in called.body if isinstance(node, ast.FunctionDef)}
        if "__init__" not in own:
            fields = (node.target for node in called.body if isinstance(node, ast.AnnAssign))
            return {target.id for target in fields if isinstance(target, ast.Name)}
        called = own["__init__"]
    if not isinstance(called, ast.FunctionDef) or called.args.kwarg:
        return set()
    return {arg.arg for arg in (*called.args.args, *called.args.kwonlyargs)}
