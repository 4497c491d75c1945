"""Reads sources, comments, declarations and results. No judgement is made here."""
