"""Builds the model: combines the facts that the readers found, and computes invocation trees, state
machines, coverage and proofs from them."""
