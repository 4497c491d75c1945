"""The mutation test: faults in the firmware and its extensions, and the tests that find them."""
