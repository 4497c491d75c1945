"""Reads sources, comments, declarations and results. It does not judge them."""
