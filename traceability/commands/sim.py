"""./wr sim: runs the firmware on this machine."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from weeding_robot_client.options import positive

from traceability.commands.builds import build
from traceability.commands.steps import Steps

PROGRAM = "weeding_robot_host"


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "sim",
        help="run the firmware on this machine",
        description="Builds the firmware for this machine and runs it in real time. Its PC link is "
        "a pseudo-terminal, to which ./wr drive and ./wr monitor connect. Ctrl-C ends it.",
    )
    parser.add_argument(
        "--link",
        type=Path,
        help="name of the link made to the pseudo-terminal (default: build/pc-link)",
    )
    parser.add_argument(
        "--cycles", type=positive, help="end after this number of control cycles of 100 ms"
    )
    parser.set_defaults(run=sim)


def sim(root: Path, options: argparse.Namespace) -> int:
    steps = Steps(root, 1)
    if steps.run("firmware (this machine)", lambda log: build(root, "host", log, PROGRAM)):
        link = options.link or root / "build" / "pc-link"
        link.parent.mkdir(parents=True, exist_ok=True)
        program = root / "build" / "host" / "sim" / PROGRAM
        words = [str(program), "--link", str(link)]
        if options.cycles is not None:
            words += ["--cycles", str(options.cycles)]
        os.execv(program, words)
    return 1
