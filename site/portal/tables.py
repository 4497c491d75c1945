"""Generates tables for hand-written pages from the files that the commands of ./wr read."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable
from pathlib import Path

from traceability.reading.products import LIST, listed

COMMANDS = Path("wr")
DEBIAN = Path("setup/debian.txt")
PRODUCTS = LIST
COMMAND = re.compile(r"^  ([a-z-]+) +(.+)$", re.MULTILINE)
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
