"""The model of the design: readers, model, checks and exports."""
