"""The commands of ./wr."""
