"""./wr sim: runs the firmware on this computer, or the firmware image on the virtual board."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from tools.closed_loop_runs import HOST_PROGRAM
from tools.cmake_build import board_words
from tools.firmware import add_product
from tools.lock import only_one
from tools.steps import FailureError, MissingError, UsageError, need_file
from tools.tasks import HOST_FIRMWARE, K64_FIRMWARE, RECORDED_IMAGES, VIRTUAL_BOARD, graph
from traceability.reading.products import DEFAULT, PAPER, image_of, recorded_image_of
from weeding_robot_client.exit_codes import FOUND
from weeding_robot_client.options import positive

LAST_PORT = 65535


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "sim",
        description="Builds the firmware for this computer and runs it in real time. Its PC link "
        "is a pseudo-terminal, to which ./wr drive and ./wr monitor connect. Ctrl-C ends "
        "the firmware. With --board, builds the firmware image for the K64 and runs "
        f"this image on the virtual K64. The exit code {FOUND} means that the virtual K64 found a "
        "fault.",
    )
    parser.add_argument(
        "--board", action="store_true", help="run the firmware image for the K64 on the virtual K64"
    )
    add_product(parser, f"the product to run; without --board only {DEFAULT} or {PAPER}")
    parser.add_argument(
        "--link",
        type=Path,
        help="name of the symbolic link to the pseudo-terminal (default: build/pc-link)",
    )
    parser.add_argument(
        "--control",
        type=Path,
        metavar="PATH",
        help="socket that accepts actions of a scenario (default: build/sim-control)",
    )
    parser.add_argument(
        "--cycles", type=positive, help="end after this number of control cycles of 100 ms"
    )
    parser.add_argument(
        "--fast",
        action="store_true",
        help="with --board and --cycles: run as fast as possible, without a PC link",
    )
    parser.add_argument(
        "--scenario", type=Path, metavar="FILE", help="play this scenario instead of a PC link"
    )
    parser.add_argument(
        "--reports", type=Path, metavar="FILE", help="with --scenario: write its reports as a table"
    )
    parser.add_argument(
        "--trace", type=Path, metavar="FILE", help="with --board: write the events with their times"
    )
    parser.add_argument(
        "--resets",
        action="store_true",
        help="with --board: continue after a reset that the program causes",
    )
    parser.add_argument(
        "--gdb",
        type=port_number,
        metavar="PORT",
        help="with --board: wait for GDB at this TCP port (0 means a free port)",
    )
    parser.set_defaults(run=sim)


def port_number(text: str) -> int:
    number = int(text)
    if not 0 <= number <= LAST_PORT:
        raise ValueError
    return number


def sim(root: Path, options: argparse.Namespace) -> int:
    """Builds the chosen program, and replaces this process with that program."""
    if options.product not in (DEFAULT, PAPER) and not options.board:
        raise UsageError(f"--product {options.product} needs --board")
    if options.trace and not options.board:
        raise UsageError(f"--trace {options.trace} needs --board")
    if options.resets and not options.board:
        raise UsageError("--resets needs --board")
    if options.gdb is not None and not options.board:
        raise UsageError(f"--gdb {options.gdb} needs --board")
    if options.gdb is not None and (options.trace or options.control):
        raise UsageError("--gdb cannot be combined with --trace or --control")
    if options.fast and not (options.board and options.cycles):
        raise UsageError("--fast needs --board and --cycles")
    if options.reports and not options.scenario:
        raise UsageError(f"--reports {options.reports} needs --scenario")
    need_files(options)
    with only_one(root, "sim"):
        images = K64_FIRMWARE if options.gdb is None else RECORDED_IMAGES
        needed = (images, VIRTUAL_BOARD) if options.board else (HOST_FIRMWARE,)
        if graph(root).run(needed).failed:
            return 1
    words = command(root, options)
    try:
        return os.execv(words[0], words)
    except OSError as error:
        raise FailureError(f"cannot run {words[0]}: {error.strerror}") from error


def need_files(options: argparse.Namespace) -> None:
    """Checks that the scenario exists, and that the folders of the written files exist."""
    if options.scenario:
        need_file(options.scenario, "name a scenario, such as a file of sim/scenario/examples")
    for file in (options.reports, options.trace):
        if file and not file.absolute().parent.is_dir():
            raise MissingError(f"cannot write {file}; make the folder {file.parent} first")


def command(root: Path, options: argparse.Namespace) -> list[str]:
    """Returns the program and its options. A scenario replaces the PC link."""
    stepped = options.fast or options.scenario is not None
    words = [str(root / "build/host/sim" / HOST_PROGRAM)]
    if options.board:
        of = image_of if options.gdb is None else recorded_image_of
        words = [*board_words(root, of(options.product, ".bin")), "--robot"]
    elif options.product == PAPER:
        words.append("--paper")
    link, control = options.link, options.control
    if not stepped:
        link = link or root / "build" / "pc-link"
        # To go backwards, the virtual board repeats the run from its start. It then repeats only
        # the bytes of the PC, and not the actions of the control socket.
        if options.gdb is None:
            control = control or root / "build" / "sim-control"
        (root / "build").mkdir(parents=True, exist_ok=True)
    for name, value in (
        ("--link", link),
        ("--control", control),
        ("--cycles", options.cycles),
        ("--scenario", options.scenario),
        ("--reports", options.reports),
        ("--trace", options.trace),
        ("--gdb", options.gdb),
    ):
        if value is not None:
            words += [name, str(value)]
    flags = {"--fast": options.fast, "--resets": options.resets}
    return words + [name for name, chosen in flags.items() if chosen]
