"""Runs a command of ./wr."""

import signal
import sys

from tools.exit_codes import INTERRUPTED
from tools.steps import heed_interrupts


def run() -> int:
    heed_interrupts()
    try:
        from tools.cli import main

        code = main(sys.argv[1:])
    except KeyboardInterrupt:
        code = INTERRUPTED
    for number in (signal.SIGINT, signal.SIGTERM):  # nothing is left to interrupt
        signal.signal(number, signal.SIG_IGN)
    return code


sys.exit(run())
