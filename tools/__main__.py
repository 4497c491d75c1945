"""Runs a command of ./wr."""

import signal
import sys

from tools.steps import heed_interrupts
from weeding_robot_client.exit_codes import INTERRUPTED


def run() -> int:
    heed_interrupts()
    try:
        from tools.cli import main

        code = main(sys.argv[1:])
    except KeyboardInterrupt:
        code = INTERRUPTED
    # The command has ended, and a further interrupt must have no effect.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    return code


sys.exit(run())
