"""The drift test: faults seeded in copies of the project, and whether the checks find them."""
