"""Exit codes of ./wr that more than one module needs; ./wr --help explains them."""

MISSING = 3
BUSY = 5
INTERRUPTED = 130
