"""A small command of ./wr. It is a graph of three tasks, and the programs of the tasks write their
files in several steps."""

from __future__ import annotations

import itertools
import os
import sys
from pathlib import Path
from typing import TextIO

from tools.lock import BusyError, only_one
from tools.steps import FailureError, cannot_write, run
from tools.task_graph import Graph, Outcome, Task
from weeding_robot_client.exit_codes import BUSY, INTERRUPTED, MISSING

SOURCES = ("src/a.txt", "src/b.txt")
OBJECTS = ("build/a.out", "build/b.out")
RESULT = "build/results/sum.txt"
_past = itertools.count(1)  # the modification times of the sources; no time is used twice
# Empties the output, and then writes it in pieces. A killed program therefore leaves an incomplete
# output.
COPY = """
: > "$2"
while read -r line; do sleep 0.01; echo "$line"; done < "$1" > "$2"
"""
SUM = 'for file in "$@"; do cat "$file"; sleep 0.01; done > build/results/sum.txt'


def tasks(root: Path) -> list[Task]:
    def copy(source: str, target: str) -> Task:
        def action(log: TextIO) -> None:
            run(log, ["sh", "-c", COPY, "sh", source, target], folder=root)

        return Task(f"copy {source}", action, (source,), (), (target,))

    def total(log: TextIO) -> Outcome:
        (root / RESULT).parent.mkdir(exist_ok=True)
        run(log, ["sh", "-c", SUM, "sh", *OBJECTS], folder=root)
        return Outcome(f"{(root / RESULT).stat().st_size} bytes")

    return [*map(copy, SOURCES, OBJECTS), Task("sum", total, OBJECTS, (RESULT,), after=names())]


def names() -> tuple[str, ...]:
    return tuple(f"copy {source}" for source in SOURCES)


def write_sources(root: Path, text: str, lines: int = 5) -> None:
    (root / "src").mkdir(parents=True, exist_ok=True)
    for name in SOURCES:
        (root / name).write_text(f"{text} of {name}\n" * lines)
        past = next(_past)
        os.utime(root / name, (past, past))


def expected(root: Path) -> str:
    return "".join((root / name).read_text() for name in SOURCES)


def main(root: Path) -> int:
    try:
        with only_one(root, "portal"):
            return 1 if Graph(root, tasks(root), workers=2).run(["sum"]).failed else 0
    except KeyboardInterrupt:
        return INTERRUPTED
    except (BusyError, FailureError) as error:
        print(error, file=sys.stderr)
        return BUSY if isinstance(error, BusyError) else 1
    except OSError as error:
        print(cannot_write(error), file=sys.stderr)
        return MISSING
