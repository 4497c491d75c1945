"""What other programs read: the model with its schema, the verification, the metrics."""
