"""Draws the layers of the Python packages. The contracts of import-linter declare these layers."""

from __future__ import annotations

import ast
import textwrap
import tomllib
from itertools import pairwise
from pathlib import Path

from portal.diagrams import MARKERS, Diagram, node, preamble

CONTRACTS = Path("pyproject.toml")
PACKAGES = "packages"  # id of the diagram
WIDTH = 60  # greatest number of letters in a line of a box


def package_diagrams(root: Path) -> list[Diagram]:
    """Returns a list that contains only the diagram. Returns an empty list if pyproject.toml does
    not exist."""
    if not (root / CONTRACTS).exists():
        return []
    tools = tomllib.loads((root / CONTRACTS).read_text(encoding="utf-8"))["tool"]
    contracts = tools["importlinter"]["contracts"]
    inside = {
        contract["containers"][0]: contract["layers"]
        for contract in contracts
        if "containers" in contract
    }
    (layers,) = (contract["layers"] for contract in contracts if contract["id"] == PACKAGES)
    lines = preamble()
    for layer in layers:
        lines.append(f"{box(root, layer)} {{" if layer in inside else box(root, layer))
        if layer in inside:
            lines += [box(root, f"{layer}.{part}") for part in inside[layer]]
            lines += [*arrows([f"{layer}.{part}" for part in inside[layer]]), "}"]
    lines += [*arrows(layers), "@enduml"]
    names = ", ".join([*layers, *(f"{name}: {', '.join(inside[name])}" for name in inside)])
    return [Diagram(PACKAGES, f"Packages, the highest layer first: {names}", "\n".join(lines))]


def arrows(layers: list[str]) -> list[str]:
    return [f"{node(a)} --> {node(b)}" for a, b in pairwise(layers)]


def box(root: Path, name: str) -> str:
    """Returns the PlantUML text of the box of a layer: the name of the package or module, and the
    first paragraph of its docstring."""
    file = name.replace(".", "/")
    folders = (root, root / "site", root / "client")
    paths = [folder / f"{file}{end}" for folder in folders for end in ("/__init__.py", ".py")]
    path = next(path for path in paths if path.exists())
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    first = "\\n".join(textwrap.wrap(text.partition("\n\n")[0], WIDTH))
    style = f"{MARKERS['role-concrete-fill']};line:{MARKERS['role-concrete'][1:]}"
    return f'rectangle "**{name.rpartition(".")[2]}**\\n{first}" as {node(name)} {style}'
