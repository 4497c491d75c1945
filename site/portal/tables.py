"""Generates tables for hand-written pages from the files that the commands of ./wr read."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable
from pathlib import Path

from traceability.model.reviews import QUESTIONS
from traceability.reading.products import LIST, listed

COMMANDS = Path("wr")
DEBIAN = Path("setup/debian.txt")
PRODUCTS = LIST
ROOMS = Path("sim/CMakeLists.txt")
REVIEWS = Path("traceability/model/reviews.py")
COMMAND = re.compile(r"^  ([a-z-]+) +(.+)$", re.MULTILINE)
# A folder of the simulator: the comment above it, its name, and the libraries that it links.
ROOM = re.compile(r"((?:^ *#.*\n)+) *add_room\((\w+) (?:STATIC|OBJECT) ?([^)]*)\)", re.MULTILINE)
EACH_ROOM = re.compile(r"^ *add_room\(", re.MULTILINE)
ROOM_LIBRARY = "sim_"  # begin of the name of the library of a folder
PACKAGE = re.compile(r"^([\w.+-]+) +# (.+)$", re.MULTILINE)


def command_table(root: Path) -> str:
    """Returns the table of the commands of ./wr, each with its help text."""
    usage = (root / COMMANDS).read_text(encoding="utf-8").partition("\nTEXT\n")[0]
    rows = ((f"``./wr {name}``", does) for name, does in COMMAND.findall(usage))
    return comma_separated(("command", "effect"), rows)


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


def review_questions(_root: Path) -> str:
    """Returns the list of the questions of a review."""
    return "".join(f"* {question}\n" for question in QUESTIONS.values())


def room_table(root: Path) -> str:
    """Returns the table of the folders of the simulator, each with its content and with the
    libraries that it links."""
    text = (root / ROOMS).read_text(encoding="utf-8")
    rooms = [match.groups() for match in ROOM.finditer(text)]
    if len(rooms) != len(EACH_ROOM.findall(text)):
        raise ValueError(f"{ROOMS}: a folder has no comment directly above add_room")
    rows = (
        (f"``{name}``", first_sentence(comment), linked(links)) for comment, name, links in rooms
    )
    return list_table((18, 52, 30), ("folder", "content", "linked libraries"), rows)


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
