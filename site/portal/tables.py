"""Generates tables for hand-written pages. The commands of ./wr use the same files."""

from __future__ import annotations

import ast
import csv
import io
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from portal.answers import metric_text
from traceability.model.reviews import QUESTIONS
from traceability.reading.products import LIST, listed
from weeding_robot_client.keyboard import KEYS

COMMANDS = Path("wr")
COMMAND_LINE = Path("tools/cli.py")
DEBIAN = Path("setup/debian.txt")
ROOMS = Path("sim/CMakeLists.txt")
REVIEWS = Path("traceability/model/reviews.py")
COMMAND = re.compile(r"^  ([a-z-]+) +(.+)$", re.MULTILINE)
# A folder of the simulator: the comment above it, its name, and the libraries that it links.
ROOM = re.compile(r"((?:^ *#.*\n)+) *add_room\((\w+) (?:STATIC|OBJECT) ?([^)]*)\)", re.MULTILINE)
EACH_ROOM = re.compile(r"^ *add_room\(", re.MULTILINE)
VIRTUAL_BOARD = Path("sim/emulator/VirtualBoard.cpp")
BLOCK = re.compile(r'\{"(\w+)", &\w+_')  # name of a peripheral block, and the address of its model
ROOM_LIBRARY = "sim_"  # the library names of the folders begin with this text
CONNECTION = Path("design/fsm/pc_connection.toml")
KEYBOARD = Path("client/weeding_robot_client/keyboard.py")
NAMED = re.compile(r"\{(\w+)\}")  # name of a constant in the effect of a key
# The measures of the tools: the text, the metric, and its unit.
MEASURES = (
    ("Python code of the checks, the portal and the tools", "tools.python_lines", "lines"),
    ("Python tests of the tools and of the client", "tools.python_test_lines", "lines"),
    ("tables in ``design/*.toml``", "tools.design_lines", "lines"),
    ("``./wr check`` after an edit of one file", "build.edit_s", "s"),
    ("``./wr portal`` without an earlier build, until the first page", "build.first_page_s", "s"),
    ("``./wr portal`` without an earlier build, until the last page", "build.cold_s", "s"),
    ("``./wr test --ci`` without an earlier build", "build.ci_s", "s"),
)
PACKAGE = re.compile(r"^([\w.+-]+) +# (.+)$", re.MULTILINE)


def command_table(root: Path) -> str:
    """Returns the table of the commands of ./wr, each with its help text and its source file."""
    usage = (root / COMMANDS).read_text(encoding="utf-8").partition("\nTEXT\n")[0]
    files = command_files(root)
    rows = (
        (f"``./wr {name}``", does, f"``{files.get(name, COMMANDS)}``")
        for name, does in COMMAND.findall(usage)
    )
    return comma_separated(("command", "effect", "source file"), rows)


def command_files(root: Path) -> dict[str, str]:
    """Returns the source file of each command, from the table MODULES. A command that is not in
    this table is implemented in ``wr``."""
    for node in ast.parse((root / COMMAND_LINE).read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "MODULES":
            modules: dict[str, str] = ast.literal_eval(node.value)
            return {name: f"{module.replace('.', '/')}.py" for name, module in modules.items()}
    raise ValueError(f"{COMMAND_LINE}: there is no table MODULES")


def package_table(root: Path) -> str:
    """Returns the table of the Debian packages that the commands need, each with the reason."""
    rows = PACKAGE.findall((root / DEBIAN).read_text(encoding="utf-8"))
    return comma_separated(("package", "why"), rows)


def product_table(root: Path) -> str:
    """Returns the table of the products, each with its composition and its parts."""
    rows = (
        (f"``{product.name}``", f":source:`{product.composition}`", product.text)
        for product in listed(root)
    )
    return list_table((30, 34, 36), ("product", "its composition", "its parts"), rows)


def measures_table(metrics: Mapping[str, Any]) -> str:
    """Returns the table with the sizes of the tools and the times of the commands."""
    rows = (
        (text, metric_text(metrics, name, unit), f"``{name}``") for text, name, unit in MEASURES
    )
    return list_table((52, 24, 24), ("measure", "value", "metric"), rows)


def review_questions(_root: Path) -> str:
    """Returns the list of the questions of a review."""
    return "".join(f"* {question}\n" for question in QUESTIONS.values())


def room_table(root: Path) -> str:
    """Returns the table of the folders of the simulator. For each folder, the table contains the
    content and the linked libraries."""
    text = (root / ROOMS).read_text(encoding="utf-8")
    rooms = [match.groups() for match in ROOM.finditer(text)]
    if len(rooms) != len(EACH_ROOM.findall(text)):
        raise ValueError(f"{ROOMS}: a folder has no comment directly above add_room")
    rows = (
        (f"``{name}``", first_sentence(comment), linked(links)) for comment, name, links in rooms
    )
    return list_table((18, 52, 30), ("folder", "content", "linked libraries"), rows)


def modelled_blocks(root: Path) -> str:
    """Returns the names of the peripheral blocks that the virtual K64 models, as one sentence."""
    names = BLOCK.findall((root / VIRTUAL_BOARD).read_text(encoding="utf-8"))
    return f"{', '.join(sorted(names))}.\n"


def key_table(_root: Path) -> str:
    """Returns the table of the keys of ``./wr drive``, each with its effect. A constant of the
    module ``keyboard`` is linked."""
    rows = (
        (f"``{key}``", NAMED.sub(rf":constant:`{KEYBOARD.stem}.\1`", effect))
        for key, effect in KEYS.items()
    )
    return list_table((16, 84), ("key", "effect"), rows)


def connection_table(root: Path) -> str:
    """Returns the table of the states of the connection. It shows the reaction to each type of
    frame in each state."""
    machine = tomllib.loads((root / CONNECTION).read_text(encoding="utf-8"))
    frames = [event for event in machine["events"] if event.isalpha()]
    reactions = {(step["from"], step["on"]): reaction(step) for step in machine["transition"]}
    rows = (
        (state, *(reactions.get((state, frame), "unexpected") for frame in frames))
        for state in machine["states"]
    )
    return list_table((20, 20, 20, 20, 20), ("state", *frames), rows)


def reaction(step: dict[str, str]) -> str:
    """Returns the action, the next state and the guard of a transition as the text of a cell."""
    to = f"to {step['to']}" if step["to"] != step["from"] else ""
    done = ", ".join(part for part in (step["action"], to) if part) or "accepted"
    return f"{done}, if {step['guard']}" if step["guard"] else done


def first_sentence(comment: str) -> str:
    words = [word for word in comment.split() if word != "#"]
    return " ".join(words).partition(". ")[0].removesuffix(".")


def linked(libraries: str) -> str:
    """Returns the names of linked libraries. The name of a folder is marked as code."""
    names = (
        f"``{name.removeprefix(ROOM_LIBRARY)}``" if name.startswith(ROOM_LIBRARY) else name
        for name in libraries.replace("CLI11::", "").split()
    )
    return ", ".join(names) or "nothing"


def list_table(widths: Iterable[int], heads: Iterable[str], rows: Iterable[tuple[str, ...]]) -> str:
    """Returns a table as reStructuredText. Its cells may contain roles such as ``:source:``."""
    lines = [
        ".. list-table::",
        "   :header-rows: 1",
        f"   :widths: {' '.join(map(str, widths))}",
        "",
    ]
    for first, *others in (tuple(heads), *rows):
        lines += [f"   * - {first}", *(f"     - {cell}".rstrip() for cell in others)]
    return "\n".join(lines) + "\n"


def comma_separated(titles: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    table = io.StringIO()
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(titles)
    writer.writerows(rows)
    return table.getvalue()


# The source file, the name of the generated file, and the function that returns its text.
TABLES: tuple[tuple[Path, str, Callable[[Path], str]], ...] = (
    (COMMANDS, "commands.csv", command_table),
    (DEBIAN, "packages.csv", package_table),
    (LIST, "products.inc", product_table),
    (REVIEWS, "review_questions.inc", review_questions),
    (ROOMS, "rooms.inc", room_table),
    (VIRTUAL_BOARD, "modelled_blocks.inc", modelled_blocks),
    (KEYBOARD, "keys.inc", key_table),
    (CONNECTION, "connection.inc", connection_table),
)
