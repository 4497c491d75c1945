"""The command line of ./wr."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from tools import (
    bench,
    book,
    check,
    client_commands,
    debug,
    diff,
    firmware,
    flash,
    lint,
    make_portal,
    mutate,
    plot,
    prove,
    release,
    review,
    run_tests,
    serve,
    show_impact,
    sim,
    verify_build,
)
from tools.campaign import command as campaign
from tools.lock import BusyError
from tools.steps import FailureError, UsageError, cannot_write
from weeding_robot_client.exit_codes import BUSY, FAILED, INTERRUPTED, MISSING

ROOT = Path(__file__).resolve().parents[1]


def parser() -> argparse.ArgumentParser:
    """Returns the parser of the command line. The parsed options contain the parser of the chosen
    command, which prints the messages about wrong options.
    """
    top = argparse.ArgumentParser(prog="./wr")
    commands = top.add_subparsers(dest="command", required=True, metavar="<command>")
    for module in (
        make_portal,
        run_tests,
        check,
        bench,
        review,
        verify_build,
        release,
        book,
        show_impact,
        diff,
        debug,
        mutate,
        prove,
        campaign,
        lint,
        firmware,
        flash,
        sim,
        client_commands,
        plot,
        serve,
    ):
        module.add(commands)
    setup = commands.add_parser(
        "setup",
        description="Installs the packages of setup/debian.txt with apt-get and the packages of "
        "setup/python.lock into .venv. If no package is missing, the command does "
        "nothing.",
    )
    setup.set_defaults(run=lambda _root, _options: 0)
    for command in commands.choices.values():
        command.set_defaults(parser=command)
    return top


def main(arguments: list[str]) -> int:
    options, rest = parser().parse_known_args(arguments)
    if rest:
        options.parser.error(f"there is no option {' '.join(rest)}")
    try:
        code: int = options.run(ROOT, options)
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except BusyError as error:
        print(f"wr {options.command}: {error}.", file=sys.stderr)
        return BUSY
    except UsageError as error:
        options.parser.error(str(error))
    except FailureError as error:
        print(f"wr {options.command}: {error}", file=sys.stderr)
        return error.code
    except OSError as error:
        if (said := cannot_write(error)) is None or not is_of_project(error):
            raise
        print(f"wr {options.command}: {said}.", file=sys.stderr)
        return MISSING
    return code


def is_of_project(error: OSError) -> bool:
    """Returns whether the error concerns a file of the project, or concerns no file."""
    return error.filename is None or ROOT in Path(str(error.filename)).absolute().parents
