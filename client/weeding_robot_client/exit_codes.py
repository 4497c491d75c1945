"""The exit codes of ./wr. ``./wr --help`` shows the comments in this table."""

DONE = 0  # done
FAILED = 1  # findings, failed tests, differences, or a failed step
USAGE = 2  # wrong usage: an option, a name that does not exist, or an error in an input file
MISSING = 3  # missing: a package, an input file, a device, a setting, disk space, or a permission
FOUND = 4  # the virtual board found a fault
BUSY = 5  # another command runs in this folder, or uses the serial line to the robot
INTERRUPTED = 130  # interrupted
