"""Command line of ./wr."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from traceability.commands import (
    bench,
    check,
    firmware,
    flash,
    impact,
    lint,
    mutate,
    portal,
    review,
    robot,
    serve,
    sim,
    test,
)
from traceability.commands.steps import FailureError, MissingError

ROOT = Path(__file__).resolve().parents[2]
MISSING = 3
INTERRUPTED = 130


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(prog="./wr")
    commands = top.add_subparsers(dest="command", required=True, metavar="<command>")
    for module in (
        portal,
        test,
        check,
        bench,
        review,
        impact,
        mutate,
        lint,
        firmware,
        flash,
        sim,
        robot,
        serve,
    ):
        module.add(commands)
    setup = commands.add_parser(
        "setup",
        help="install what is missing, and nothing else",
        description="Installs the packages of setup/debian.txt with apt-get and those of "
        "setup/python.lock into .venv. Does nothing when nothing is missing.",
    )
    setup.set_defaults(run=lambda _root, _options: 0)
    return top


def main(arguments: list[str]) -> int:
    options = parser().parse_args(arguments)
    try:
        code: int = options.run(ROOT, options)
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except FailureError as error:
        print(f"wr {options.command}: {error}", file=sys.stderr)
        return MISSING if isinstance(error, MissingError) else 1
    return code
