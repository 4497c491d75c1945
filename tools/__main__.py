"""Runs a command of ./wr."""

import sys

from tools.cli import heed_interrupts, main

heed_interrupts()
sys.exit(main(sys.argv[1:]))
