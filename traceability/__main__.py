"""Runs a command of ./wr."""

import sys

from traceability.commands.cli import main

sys.exit(main(sys.argv[1:]))
