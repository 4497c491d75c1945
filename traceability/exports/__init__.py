"""Files for other programs: the model with its schema, the verification and the metrics."""
