"""The commands that arm the robot and acknowledge its protective stop."""

from __future__ import annotations

import argparse
import sys

from weeding_robot_client import orders
from weeding_robot_client.exit_codes import DONE, FAILED
from weeding_robot_client.monitor import status
from weeding_robot_client.options import add_link, opened
from weeding_robot_client.orders import Orders, connect, not_connected
from weeding_robot_client.script import NEUTRAL_S, Wish

ARM = f"""\
Sends neutral orders (all wheels at 0) until the robot reports that it is armed. Shows the reason
while the robot is not armed. Releases an earlier stop that the PC ordered. The robot needs
neutral orders for {NEUTRAL_S} s.
Afterwards, another program must send orders, because the robot does not stay armed without orders.

Exit code {FAILED}: not armed, or no connection."""
ACKNOWLEDGE = f"""\
Acknowledges the latched protective stop. The robot stays at rest and releases its latched faults.
Remove the cause first, and release a stop of the remote control: while this stop is in force, an
acknowledgement has no effect. Afterwards, the program arms the robot, as ./wr arm does.

Exit code {FAILED}: not armed, or no connection."""


def run_arm(options: argparse.Namespace) -> int:
    return _run(options, acknowledges=False)


def run_acknowledge(options: argparse.Namespace) -> int:
    return _run(options, acknowledges=True)


def add_options(parser: argparse.ArgumentParser) -> None:
    add_link(parser)


def _run(options: argparse.Namespace, acknowledges: bool) -> int:
    with opened(options) as (link, recording):
        sender = Orders(link, recording.add)
        report = connect(sender)
        if report is None:
            print(not_connected(link), file=sys.stderr)
            return FAILED
        print(status(link), file=sys.stderr)
        if acknowledges:
            print("acknowledges ...")
            orders.acknowledge(sender)
        elif "PC" in report.stop_sources:
            print("releases the stop of the PC")
        reason = orders.arm(sender, progress=print)
        sender.end(Wish())
    print(f"not armed: {reason}" if reason else "armed")
    return FAILED if reason else DONE
