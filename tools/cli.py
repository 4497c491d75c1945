"""The command line of ./wr."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterable
from importlib import import_module
from pathlib import Path

from tools.lock import BusyError
from tools.steps import FailureError, UsageError, cannot_write
from weeding_robot_client.exit_codes import BUSY, FAILED, INTERRUPTED, MISSING

ROOT = Path(__file__).resolve().parents[1]
# Each command, and the module that adds it.
MODULES = {
    "portal": "tools.make_portal",
    "test": "tools.run_tests",
    "check": "tools.check",
    "bench": "tools.bench",
    "review": "tools.review",
    "verify-build": "tools.verify_build",
    "release": "tools.release",
    "book": "tools.book",
    "impact": "tools.show_impact",
    "diff": "tools.diff",
    "debug": "tools.debug",
    "mutate": "tools.mutate",
    "prove": "tools.prove",
    "campaign": "tools.campaign.command",
    "lint": "tools.lint",
    "firmware": "tools.firmware",
    "flash": "tools.flash",
    "sim": "tools.sim",
    "drive": "tools.client_commands",
    "monitor": "tools.client_commands",
    "arm": "tools.client_commands",
    "acknowledge": "tools.client_commands",
    "bring-up": "tools.client_commands",
    "plot": "tools.plot",
    "serve": "tools.serve",
}


def parser(names: Iterable[str] = MODULES) -> argparse.ArgumentParser:
    """Returns the parser of the command line, with the named commands. Each command has its own
    parser. The parsed options contain the parser of the chosen command. This parser prints the
    messages about wrong options."""
    top = argparse.ArgumentParser(prog="./wr")
    commands = top.add_subparsers(dest="command", required=True, metavar="<command>")
    for module in dict.fromkeys(MODULES[name] for name in names):
        import_module(module).add(commands)
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
    # Only the module of the named command is imported, because the import of all modules takes
    # longer than most commands.
    named = [name for name in arguments[:1] if name in MODULES]
    options, rest = parser(named or MODULES).parse_known_args(arguments)
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
    """Returns true if the error concerns a file of the project, or if it concerns no file."""
    return error.filename is None or ROOT in Path(str(error.filename)).absolute().parents
