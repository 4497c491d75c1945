"""Writes the files for other programs: the model with its schema, the verification of the
requirements, and the metrics."""
