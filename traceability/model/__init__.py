"""The model: it combines the results of the readers, and derives trees, states and coverage from
them."""
