"""./wr drive, monitor, arm, acknowledge and bring-up: the client of the PC protocol."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from weeding_robot_client import bring_up, drive, monitor, procedures

Options = Callable[[argparse.ArgumentParser], None]
Run = Callable[[argparse.Namespace], int]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    arm, acknowledge = procedures.run_arm, procedures.run_acknowledge
    entries: dict[str, tuple[Options, Run, str, str]] = {
        "drive": (drive.add_options, drive.run, drive.DESCRIPTION, drive.EPILOG),
        "monitor": (monitor.add_options, monitor.run, monitor.DESCRIPTION, monitor.EPILOG),
        "arm": (procedures.add_options, arm, procedures.ARM, ""),
        "acknowledge": (procedures.add_options, acknowledge, procedures.ACKNOWLEDGE, ""),
        "bring-up": (bring_up.add_options, bring_up.run, bring_up.DESCRIPTION, ""),
    }
    for name, (add_options, run, description, epilog) in entries.items():
        parser = commands.add_parser(
            name,
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        add_options(parser)
        parser.set_defaults(run=lambda _root, options, run=run: run(options))
