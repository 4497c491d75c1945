"""./wr drive and ./wr monitor: the client of the PC protocol."""

from __future__ import annotations

import argparse

from weeding_robot_client import drive, monitor


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    for module, name, text in (
        (drive, "drive", "drive the robot from the keyboard or from a file"),
        (monitor, "monitor", "show what the robot reports"),
    ):
        parser = commands.add_parser(
            name,
            help=text,
            description=module.DESCRIPTION,
            epilog=module.EPILOG,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_options(parser)
        parser.set_defaults(run=lambda _root, options, run=module.run: run(options))
