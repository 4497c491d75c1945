"""Client of the PC protocol (docs/protocol.rst)."""
