"""The mutation score: faults in the methods of the trees, and the tests that find them."""
