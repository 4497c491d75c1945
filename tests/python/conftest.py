"""What all tests of the tools share."""

import signal

# Programs that a test starts end with Ctrl-C, also where a shell started the tests with SIGINT
# ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
