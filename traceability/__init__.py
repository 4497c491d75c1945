"""Reads the design from the source files, builds its model, checks the model, and exports it."""
