"""Tables for hand-written pages, read from the files that the commands themselves read."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable
from pathlib import Path

COMMANDS = Path("wr")
PACKAGES = Path("setup/debian.txt")
COMMAND = re.compile(r"^  (\w+) +(.+)$", re.MULTILINE)
PACKAGE = re.compile(r"^([\w.+-]+) +# (.+)$", re.MULTILINE)


def command_table(root: Path) -> str:
    """Each command of ./wr, as its help has it."""
    usage = (root / COMMANDS).read_text(encoding="utf-8").partition("\nTEXT\n")[0]
    rows = ((f"``./wr {name}``", does) for name, does in COMMAND.findall(usage))
    return comma_separated(("command", "what it does"), rows)


def package_table(root: Path) -> str:
    """Each package of Debian that the commands need, and why."""
    rows = PACKAGE.findall((root / PACKAGES).read_text(encoding="utf-8"))
    return comma_separated(("package", "why"), rows)


def comma_separated(titles: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    table = io.StringIO()
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(titles)
    writer.writerows(rows)
    return table.getvalue()
