"""./wr firmware: the firmware for this machine, and its library for the K64."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

from traceability.commands.builds import build, firmware_sizes
from traceability.commands.steps import Steps


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "firmware",
        help="build the firmware for this machine and for the K64",
        description="Builds the firmware for this machine (run it with ./wr sim), and its library "
        "for the K64 with the size of each module.",
    )
    parser.set_defaults(run=lambda root, _options: firmware(root))


def firmware(root: Path) -> int:
    steps = Steps(root, 2)
    build_firmware(root, steps)
    if steps.failed:
        return 1
    print_sizes(firmware_sizes(root))
    print("For this machine: build/host/sim/weeding_robot_host (./wr sim)")
    return 0


def build_firmware(root: Path, steps: Steps) -> None:
    """Two steps: for this machine, and for the K64."""

    def host(log: TextIO) -> None:
        build(root, "host", log, "weeding_robot_host")

    def k64(log: TextIO) -> str:
        build(root, "k64", log, "firmware")
        return summary(firmware_sizes(root))

    steps.run("firmware (this machine)", host)
    steps.run("firmware (K64)", k64)


def summary(sizes: dict[str, dict[str, int]]) -> str:
    flash = sum(size["flash"] for size in sizes.values())
    ram = sum(size["ram"] for size in sizes.values())
    return f"library: {flash} bytes flash, {ram} bytes RAM in {len(sizes)} files"


def print_sizes(sizes: dict[str, dict[str, int]]) -> None:
    print(f"\n{'file':32} {'flash':>8} {'RAM':>8}   bytes")
    for name, size in sorted(sizes.items(), key=lambda item: -item[1]["flash"]):
        print(f"{name:32} {size['flash']:8} {size['ram']:8}")
    print(f"\n{summary(sizes)}, before linking")
